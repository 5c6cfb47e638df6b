//! Boxes fall on a floor and come to rest.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Level, Shape, vec2};

use super::{at, dull, wall};
use crate::parameters::{Order, Parameters};
use crate::promise::Promise;
use crate::scene::{Capacity, Promises, Scene};

/// Distance between neighbours, px; each box is 12 px wide.
const PITCH: i16 = 32;

pub(crate) const SCENE: Scene = Scene {
    name: "drop",
    purpose: "boxes fall 100 px on a floor and come to rest",
    effects: Effects::GRAVITY,
    steps: 300,
    defaults: Parameters { bodies: 1, seed: 1, order: Order::Forward },
    bodies: 1..=200,
    capacity: |parameters| Capacity { bodies: parameters.bodies + 1, contacts: 2 * parameters.bodies + 8 },
    body,
    promises,
};

/// Number 0 is the floor, its top at y = 0.
fn body(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let material = dull(px(0));
    if number == 0 {
        return wall((-PITCH, 0), (PITCH * parameters.bodies as i16, 16), material);
    }
    let mut position = at(PITCH * (number as i16 - 1), -106);
    position.x += fixed::types::I16F16::from_bits(parameters.jitter(u32::from(number)));
    BodyDef { material, ..BodyDef::rigid(Shape::Box { half: vec2(px(6), px(6)) }, position) }
}

fn promises(parameters: &Parameters, _level: Level) -> Promises {
    let right = PITCH * parameters.bodies as i16;
    Promises::from_iter([
        // The last step of the fall is 3.3 px long, and all of it may end below the floor's top.
        Promise::Within { min: at(-PITCH, -200), max: at(right, 0), tolerance: ratio(7, 2) },
        Promise::Rest { from: 120, at_most: ratio(1, 100) },
        Promise::Penetration { from: 120, at_most: ratio(3, 100) },
    ])
}
