//! Bodies change between steps: every property can be set, what is set is in effect at once, and wrong values change nothing.

mod anything;
mod forces;
#[path = "../meddling/mod.rs"]
mod meddling;
mod places;
mod values;

use flat_physics::scalar::px;
use flat_physics::{BodyDef, Effects, Fixed, Handle, Material, Scalar, Shape, Storage, Vec2, World, step, vec2};

const ON: Effects =
    Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::FRICTION).and(Effects::SENSORS).and(Effects::KINEMATIC);
const DULL: Material<Fixed> = Material { bounce: false, ..Material::DEFAULT };

fn rect(width: i16, height: i16) -> Shape<Fixed> {
    Shape::Box { half: vec2(px(width) / 2, px(height) / 2) }
}

fn crate_at(x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { material: DULL, ..BodyDef::rigid(rect(10, 10), vec2(px(x), px(y))) }
}

fn floor() -> BodyDef<Fixed> {
    BodyDef { material: DULL, ..BodyDef::fixed(rect(400, 10), vec2(px(0), px(5))) }
}

fn run(world: &mut World<'_, Fixed>, steps: usize) {
    for _ in 0..steps {
        step(world, ON);
    }
}

fn at(world: &World<'_, Fixed>, handle: Handle) -> Vec2<f64> {
    world.body(handle).unwrap().position.map(|c| c.to_num())
}

fn speed(world: &World<'_, Fixed>, handle: Handle) -> Vec2<f64> {
    world.body(handle).unwrap().velocity.map(|v| Fixed::px_per_second(v).to_num())
}

/// A crate has come to rest on a floor: its contact is in the pool and nothing moves. Then the world is changed.
fn at_rest(change: impl FnOnce(&mut World<'_, Fixed>, Handle, Handle)) {
    let mut storage = Storage::<Fixed, 8, 32>::new();
    let mut world = storage.world();
    let below = world.spawn(&floor()).unwrap();
    let above = world.spawn(&crate_at(0, -5)).unwrap();
    run(&mut world, 60);
    assert!((at(&world, above).y + 5.0).abs() < 0.03);
    change(&mut world, below, above);
}

fn falls(world: &mut World<'_, Fixed>, handle: Handle) -> bool {
    let before = at(world, handle).y;
    run(world, 30);
    at(world, handle).y > before + 20.0
}
