//! The smallest game: a box on a floor. What it takes is what the engine takes, with the effects that it is built for, at level
//! Grounded.

use core::hint::black_box;

use flat_physics::scalar::px;
use flat_physics::{BodyDef, Error, Fixed, Level, Only, Shape, Storage, step, vec2};

use crate::{EFFECTS, FAIL, MARK, call, end};

/// `FLAT_PROBE_EFFECTS`; a game without any otherwise.
const CHOSEN: u16 = match EFFECTS {
    Some(bits) => bits,
    None => 0,
};

static mut STORAGE: Storage<Fixed, 16, 32> = Storage::new();

/// Plays for ever, built for bodies of a [variety](flat_physics::Variety). To be called once.
pub fn run<const VARIETY: u8>() -> ! {
    match play::<VARIETY>() {
        Ok(()) => end(MARK, [0; 2]),
        Err(_) => end(FAIL, [0; 2]),
    }
}

fn play<const VARIETY: u8>() -> Result<(), Error<Fixed>> {
    // SAFETY: the only reference to this static, made once: there is one core, and the entry is entered once.
    let storage = unsafe { (&raw mut STORAGE).as_mut_unchecked() };
    let mut world = storage.world();
    // A game's figures come from its data: the compiler must not know them.
    let half = |x, y| Shape::Box { half: vec2(black_box(px(x)), black_box(px(y))) };
    world.spawn(&BodyDef::fixed(half(100, 8), vec2(px(0), px(108))))?;
    let body = world.spawn(&BodyDef::rigid(half(8, 8), vec2(px(0), px(0))))?;
    loop {
        step(&mut world, Only::<CHOSEN, { Level::Grounded as u8 }, VARIETY>);
        let at = world.body(body)?.position;
        call(MARK, [at.x.to_bits().cast_unsigned(), at.y.to_bits().cast_unsigned()]);
    }
}
