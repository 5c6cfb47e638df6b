//! A set of effects that is compiled in goes through the same states as that set at run time: for a hundred random sets, and for
//! that of every scene.
//!
//! Each set is a copy of the whole step, which is why this is a package of its own: compiled without optimisation, a copy takes a
//! tenth of the time.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::tiles::BehaviorLayer;
use flat_physics::world::Terrain;
use flat_physics::{BodyDef, Config, Effects, Fixed, Level, Material, Only, Shape, Storage, World, digest, step, vec2};
use flat_scenes::{Cue, Memory, SCENES};

/// Steps of the world that calls for everything: one body has fallen asleep by then.
const STEPS: u32 = 120;
/// Steps of each scene: its first second.
const STEPS_OF_SCENES: u32 = 60;

/// Numbers that stand for sets, drawn by chance but the same in every build (G. Marsaglia, "Xorshift RNGs", 2003).
const RANDOM: [u16; 100] = {
    let mut sets = [0; 100];
    let (mut state, mut place) = (0x9E37_79B9_u32, 0);
    while place < sets.len() {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        sets[place] = (state >> 16) as u16 & Effects::ALL.bits();
        place += 1;
    }
    sets
};

/// What each scene calls for.
const OF_SCENES: [u16; SCENES.len()] = {
    let mut sets = [0; SCENES.len()];
    let mut place = 0;
    while place < sets.len() {
        sets[place] = SCENES[place].effects.bits();
        place += 1;
    }
    sets
};

/// The set at a place; none beyond the end.
const fn at(sets: &[u16], place: usize) -> u16 {
    if place < sets.len() { sets[place] } else { 0 }
}

/// For each place, compares a run with the set compiled in with one where it is decided at run time: up to a hundred places.
macro_rules! compare {
    ($sets:ident, $run:expr) => {
        const { assert!($sets.len() <= 100) };
        compare!($sets, $run, 0 1 2 3 4 5 6 7 8 9);
    };
    ($sets:ident, $run:expr, $($tens:literal)*) => {$(
        compare!($sets, $run, $tens: 0 1 2 3 4 5 6 7 8 9);
    )*};
    ($sets:ident, $run:expr, $tens:literal: $($ones:literal)*) => {$(
        if let Some(&bits) = $sets.get($tens * 10 + $ones) {
            let set = Effects::from_bits(bits).unwrap();
            let compiled = $run($tens * 10 + $ones, &mut |world| step(world, Only::<{ at(&$sets, $tens * 10 + $ones) }>));
            let chosen = $run($tens * 10 + $ones, &mut |world| step(world, set));
            assert_eq!(parts(&compiled, &chosen), None, "step, place {}, {set}", $tens * 10 + $ones);
        }
    )*};
}

/// Steps a world.
type Step<'s> = &'s mut dyn FnMut(&mut World<'_, Fixed>);

/// A world's digest, how many events it tells and how many bodies sleep, after each step.
type Trace = Vec<(u64, usize, usize)>;

fn trace(world: &World<'_, Fixed>) -> (u64, usize, usize) {
    (digest(world), world.events().count(), world.bodies().filter(|body| body.asleep).count())
}

/// The first step after which two runs differ.
fn parts(one: &Trace, other: &Trace) -> Option<usize> {
    one.iter().zip(other).position(|(one, other)| one != other)
}

/// The beginning of a scene.
fn of_scene(place: usize, step: Step<'_>) -> Trace {
    let scene = &SCENES[place];
    let mut storage = Box::new(Storage::<Fixed, 512, 4096, 2048>::new());
    let (mut world, mut memory) = (storage.world(), Memory::default());
    scene.build(&scene.defaults, Level::Grounded, &mut world).unwrap();
    let steps = (1..=STEPS_OF_SCENES).map(|number| {
        scene.direct(&scene.defaults, Cue::unattended(number), &mut memory, &mut world).unwrap();
        step(&mut world);
        trace(&world)
    });
    steps.collect()
}

/// A world that calls for everything.
fn of_everything(_: usize, step: Step<'_>) -> Trace {
    let mut storage = Box::new(Storage::<Fixed, 32, 256, 64>::new());
    let mut world = storage.world();
    let config = Config { gravity: vec2(px(20), px(400)), speed_cap: px(300), ..Config::default() };
    world.configure(config).unwrap();
    let material = Material { restitution: ratio(1, 2), bounce: true, friction: ratio(1, 4) };
    let layer = BehaviorLayer::new(&[1; 16], 16, 1).unwrap();
    world.set_tiles(&layer, &Terrain { material, ..Terrain::DEFAULT }).unwrap();
    for n in 0..20 {
        let shape = if n % 3 == 0 { Shape::Box { half: vec2(px(5), px(4)) } } else { Shape::Circle { radius: px(5) } };
        let velocity = vec2(I16F16::from_bits(i32::from(n) * 99_991), px(n % 5 * 200));
        let at = vec2(px(30 + n % 7 * 20), px(-10 - n / 7 * 15));
        world.spawn(&BodyDef { velocity, material, sensor: n == 7, ..BodyDef::rigid(shape, at) }).unwrap();
    }
    let rests = BodyDef::rigid(Shape::Box { half: vec2(px(5), px(4)) }, vec2(px(240), px(-4)));
    world.spawn(&BodyDef { material, ..rests }).unwrap();
    let platform = BodyDef::fixed(Shape::Box { half: vec2(px(30), px(2)) }, vec2(px(60), px(-12)));
    world.spawn(&BodyDef { one_way: true, ..platform }).unwrap();
    let pusher = BodyDef::kinematic(Shape::Box { half: vec2(px(4), px(6)) }, vec2(px(20), px(-8)));
    world.spawn(&BodyDef { velocity: vec2(px(40), px(0)), ..pusher }).unwrap();
    let steps = (0..STEPS).map(|_| {
        step(&mut world);
        trace(&world)
    });
    steps.collect()
}

#[test]
fn a_hundred_random_sets_give_the_same_bits_compiled_in_and_at_run_time() {
    compare!(RANDOM, of_everything);
}

#[test]
fn every_scene_gives_the_same_bits_with_its_set_compiled_in() {
    compare!(OF_SCENES, of_scene);
}

#[test]
fn each_effect_is_at_work_where_random_sets_are_compared() {
    let run = |set| of_everything(0, &mut |world| step(world, set));
    let all = run(Effects::ALL);
    for bit in 0..Effects::ALL.bits().count_ones() {
        let effect = Effects::from_bits(1 << bit).unwrap();
        assert!(run(Effects::ALL.without(effect)) != all, "{effect}");
    }
}
