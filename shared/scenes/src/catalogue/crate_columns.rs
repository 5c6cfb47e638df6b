//! Columns of ten crates stand on a floor.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Level, Shape, vec2};

use super::{at, dull, wall};
use crate::parameters::{Order, Parameters};
use crate::promise::Promise;
use crate::scene::{Capacity, Promises, Scene};

const SIDE: i16 = 16;
const HIGH: u16 = 10;
/// Distance between columns, px.
const PITCH: i16 = 40;

pub(crate) const SCENE: Scene = Scene {
    name: "crate_columns",
    purpose: "columns of ten crates that touch exactly stand on a floor",
    effects: Effects::GRAVITY.and(Effects::FRICTION),
    steps: 600,
    defaults: Parameters { bodies: 100, seed: 1, order: Order::Forward },
    bodies: 1..=1000,
    capacity: |parameters| Capacity { bodies: parameters.bodies + 1, contacts: 3 * parameters.bodies + 16 },
    body,
    promises,
};

/// Number 0 is the floor, its top at y = 0; then column by column, from the floor up.
fn body(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let material = dull(ratio(3, 10));
    if number == 0 {
        return wall((-PITCH, 0), (right(parameters), SIDE), material);
    }
    let (column, level) = ((number - 1) / HIGH, (number - 1) % HIGH);
    let position = at(PITCH * column as i16, -SIDE / 2 - SIDE * level as i16);
    BodyDef { material, ..BodyDef::rigid(Shape::Box { half: vec2(px(SIDE / 2), px(SIDE / 2)) }, position) }
}

fn right(parameters: &Parameters) -> i16 {
    PITCH * parameters.bodies.div_ceil(HIGH) as i16
}

/// A crate whose centre is past the middle of the floor would leave below.
fn promises(parameters: &Parameters, _level: Level) -> Promises {
    let max = at(right(parameters), 0);
    Promises::from_iter([Promise::Within { min: at(-PITCH, -200), max, tolerance: px(SIDE) }])
}
