//! Runs a scene and marks its steps: each stage where effects are decided at run time, each whole step where they are
//! decided here and now, as in a shipped game.
#![no_std]
#![no_main]
#![deny(clippy::undocumented_unsafe_blocks)]

use flat_physics::{Effects, Fixed, Level, Only, Scalar, Stage, Storage, World, digest, step};
use flat_probe::{EFFECTS, END, FAIL, MARK, call, end};
use flat_scenes::{Cue, Memory, Order, SCENES};

const BODIES: usize = 1024;
const CONTACTS: usize = 8192;
const TILES: usize = 4096;

static mut FIXED: Storage<Fixed, BODIES, CONTACTS, TILES> = Storage::new();
static mut F32: Storage<f32, BODIES, CONTACTS, TILES> = Storage::new();
static mut F64: Storage<f64, BODIES, CONTACTS, TILES> = Storage::new();

/// What to run, as rig passes it.
#[derive(Clone, Copy)]
struct Request {
    scene: u32,
    bodies: u32,
    seed: u32,
    level: u32,
    /// 0 = the level's.
    iterations: u32,
    effects: u32,
    steps: u32,
}

/// The entry: arguments as the calling convention passes them; the eighth is the number format.
// SAFETY: the only symbol of that name; the linker script enters here.
#[unsafe(no_mangle)]
extern "C" fn probe(
    scene: u32,
    bodies: u32,
    seed: u32,
    level: u32,
    iterations: u32,
    effects: u32,
    steps: u32,
    scalar: u32,
) -> ! {
    let request = Request { scene, bodies, seed, level, iterations, effects, steps };
    match (EFFECTS, scalar) {
        // SAFETY: the only reference to this static, made once: there is one core, and the entry is entered once.
        (_, 0) => run(unsafe { (&raw mut FIXED).as_mut_unchecked() }.world(), &request),
        // SAFETY: as above.
        (None, 1) => run(unsafe { (&raw mut F32).as_mut_unchecked() }.world(), &request),
        // SAFETY: as above.
        (None, _) => run(unsafe { (&raw mut F64).as_mut_unchecked() }.world(), &request),
        (Some(_), _) => end(FAIL, [0; 2]),
    }
}

fn run<S: Scalar>(mut world: World<'_, S>, request: &Request) -> ! {
    let Some(scene) = SCENES.get(request.scene as usize) else { end(FAIL, [1, 0]) };
    let parameters = scene.parameters(Some(request.bodies as u16), Some(request.seed), Order::Forward);
    let Ok(parameters) = parameters else { end(FAIL, [2, 0]) };
    let level = [Level::Flat, Level::Grounded, Level::Exact][request.level as usize % 3];
    if scene.build(&parameters, level, &mut world).is_err() {
        end(FAIL, [3, 0]);
    }
    let mut config = *world.config();
    if request.iterations > 0 {
        config.velocity_iterations = request.iterations as u8;
    }
    if world.configure(config).is_err() {
        end(FAIL, [4, 0]);
    }
    let effects = Effects::from_bits(request.effects as u16).unwrap_or(Effects::NONE);
    let mut memory = Memory::default();
    for number in 1..=request.steps {
        if scene.direct(&parameters, Cue::unattended(number), &mut memory, &mut world).is_err() {
            end(FAIL, [5, number]);
        }
        if EFFECTS.is_some() {
            call(MARK, [0, number]);
            step(&mut world, Only::<{ chosen() }>);
        } else {
            for stage in Stage::ALL {
                call(MARK, [stage.index() as u32, number]);
                stage.run(&mut world, effects);
            }
        }
        call(MARK, [Stage::ALL.len() as u32, number]);
    }
    let digest = digest(&world);
    end(END, [digest as u32, (digest >> 32) as u32])
}

/// The effects of this build, for a type that is only used where there are any.
const fn chosen() -> u16 {
    match EFFECTS {
        Some(bits) => bits,
        None => 0,
    }
}
