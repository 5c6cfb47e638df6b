//! Bodies that approach each other fast meet where they touch.

use fixed::types::I16F16;
use flat_physics::scalar::px;
use flat_physics::{BodyDef, Config, Effects, Fixed, Material, Shape, Storage, Vec2, step, vec2};

const DULL: Material<Fixed> = Material { bounce: false, ..Material::DEFAULT };
const BOX: Shape<Fixed> = Shape::Box { half: vec2(px(6), px(6)) };
const CIRCLE: Shape<Fixed> = Shape::Circle { radius: px(6) };
/// What solvers leave alone, and rounding.
const SLOP: f64 = 0.021;

fn moving(shape: Shape<Fixed>, position: Vec2<I16F16>, velocity: (i16, i16)) -> BodyDef<Fixed> {
    let velocity = vec2(px(velocity.0), px(velocity.1));
    BodyDef { material: DULL, velocity, ..BodyDef::rigid(shape, position) }
}

/// The deepest overlap in the first 20 steps of a world without gravity, px.
fn deepest(defs: &[BodyDef<Fixed>]) -> f64 {
    let mut storage = Storage::<Fixed, 4, 16>::new();
    let mut world = storage.world();
    world.configure(Config { gravity: Vec2::default(), ..Config::default() }).unwrap();
    for def in defs {
        world.spawn(def).unwrap();
    }
    let mut deepest = 0.0_f64;
    for _ in 0..20 {
        step(&mut world, Effects::NONE);
        // Whoever is found too late is in contact with an overlap one step later.
        let overlaps = world.contacts().map(|contact| contact.penetration.to_num::<f64>());
        deepest = overlaps.fold(deepest, f64::max);
    }
    deepest
}

/// Distances at which a step may begin, in 1/16 px: as far as a step leads.
fn distances() -> impl Iterator<Item = I16F16> {
    (0..160).map(|part| px(part) / 16)
}

#[test]
fn who_comes_along_a_diagonal_is_found_in_time() {
    for shape in [CIRCLE, BOX] {
        for distance in distances() {
            let place = px(20) + distance;
            // The second pair passes the corner, and meets the face beyond it.
            for aside in [px(0), px(5)] {
                let down = moving(CIRCLE, vec2(-place, -place + aside), (400, 400));
                let up = moving(shape, vec2(place, place), (-400, -400));
                let depth = deepest(&[down, up]);
                assert!(depth < SLOP, "{shape:?} {distance} px, {aside} aside: {depth} px deep");
            }
        }
    }
}
