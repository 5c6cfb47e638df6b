//! Columns of ten crates stand on a floor.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed};

use super::{COMMON, STANDING, at, body, dull, settled, square, usual, wall};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const SIDE: i16 = 16;
const HIGH: u16 = 10;
/// Distance between columns, px.
const PITCH: i16 = 40;

pub(crate) const SCENE: Scene = Scene {
    name: "crate_columns",
    purpose: "columns of ten crates that touch exactly stand on a floor",
    effects: Effects::GRAVITY.and(Effects::FRICTION),
    defaults: usual(100),
    bodies: 1..=1000,
    takes: Takes { mixes: &[Mix::Masses], ..Takes::ALL },
    body: member,
    promises,
    ..COMMON
};

/// When a crate is thrown up, and when all sleep again.
const THROW: u32 = 300;
const REST: u32 = 420;

pub(crate) const NAPS: Scene = Scene {
    name: "naps",
    purpose: "columns of crates fall asleep; a crate thrown up wakes its own column, until that sleeps again",
    effects: SCENE.effects.and(Effects::SLEEP),
    defaults: usual(50),
    bodies: HIGH..=1000,
    script: Some(|_, moment, control| {
        if moment.step == THROW {
            control.set_velocity(HIGH, at(0, -60)); // the top of the first column
        }
    }),
    promises: |parameters| {
        Promises::from_iter([
            inside(parameters),
            Promise::Penetration { from: REST, at_most: STANDING },
            Promise::Still { from: REST },
        ])
    },
    ..SCENE
};

/// Number 0 is the floor, its top at y = 0; then column by column, from the floor up.
fn member(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let material = dull(ratio(3, 10));
    if number == 0 {
        return wall((-PITCH, 0), (right(parameters), SIDE), material);
    }
    let (column, level) = (((number - 1) / HIGH) as i16, ((number - 1) % HIGH) as i16);
    let gap = i16::from(parameters.variant.gap);
    let position = at(PITCH * column, -gap - SIDE / 2 - (SIDE + gap) * level);
    let mass = match parameters.variant.mix {
        // 1 to 100.
        Mix::Masses => px(1 + (parameters.jitter(number.into()).unsigned_abs() % 100) as i16),
        _ => px(1),
    };
    BodyDef { mass, ..body(square(px(SIDE / 2)), position, material) }
}

fn right(parameters: &Parameters) -> i16 {
    PITCH * parameters.bodies.div_ceil(HIGH) as i16
}

/// A crate whose centre is past the middle of the floor would leave below.
fn inside(parameters: &Parameters) -> Promise {
    let gap = i16::from(parameters.variant.gap);
    let top = -(HIGH as i16) * (SIDE + gap);
    Promise::Within { min: at(-PITCH, top), max: at(right(parameters), 0), tolerance: px(SIDE) }
}

fn promises(parameters: &Parameters) -> Promises {
    let gap = u32::from(parameters.variant.gap);
    let from = settled(parameters, SCENE.gravity, u32::from(HIGH) * gap);
    Promises::from_iter([inside(parameters), Promise::Penetration { from, at_most: STANDING }, Promise::Still { from }])
}
