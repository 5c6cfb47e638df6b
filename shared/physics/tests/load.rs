//! Heavy bodies on light ones, for longer than the scenes run.

use flat_physics::scalar::{Scalar, px};
use flat_physics::{BodyDef, Effects, Material, Shape, Storage, step, vec2};

/// Steps until everything stands, and those that it then has to.
const SETTLED: u32 = 300;
const STANDS: u32 = 1200;

fn column_stands_under<S: Scalar>(mass: i16) {
    let mut storage = Storage::<S, 8, 32>::new();
    let mut world = storage.world();
    let at = |y: i16| vec2(S::real(px(0)), S::real(px(y)));
    let square = |half: i16| Shape::Box { half: vec2(S::real(px(half)), S::real(px(half))) };
    let material = Material { bounce: false, ..Material::DEFAULT };
    world.spawn(&BodyDef { material, ..BodyDef::fixed(square(100), at(100)) }).unwrap();
    for level in 0..3 {
        world.spawn(&BodyDef { material, ..BodyDef::rigid(square(6), at(-6 - 12 * level)) }).unwrap();
    }
    world.spawn(&BodyDef { mass: S::real(px(mass)), material, ..BodyDef::rigid(square(20), at(-56)) }).unwrap();
    let mut standing = None;
    for done in 1..=SETTLED + STANDS {
        step(&mut world, Effects::GRAVITY);
        if done >= SETTLED {
            let now = flat_physics::digest(&world);
            assert_eq!(*standing.get_or_insert(now), now, "{mass} to 1, step {done}");
        }
    }
}

#[test]
fn nothing_light_is_pumped_up_until_it_lifts_what_is_heavy() {
    for mass in [100, 1000, 10_000] {
        column_stands_under::<f32>(mass);
        column_stands_under::<f64>(mass);
        column_stands_under::<flat_physics::Fixed>(mass);
    }
}
