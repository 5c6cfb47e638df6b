//! Boxes fall on a floor and come to rest.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Fixed};

use super::{COMMON, at, body, circle, dull, settled, square, wall};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

/// Distance between neighbours, px; each box is 12 px wide.
const PITCH: i16 = 32;

pub(crate) const SCENE: Scene = Scene {
    name: "drop",
    purpose: "boxes fall 100 px on a floor and come to rest",
    steps: 300,
    bodies: 1..=200,
    takes: Takes { mixes: &[Mix::Shapes], ..Takes::GRAVITIES },
    body: member,
    promises,
    ..COMMON
};

/// Number 0 is the floor, its top at y = 0.
fn member(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let material = dull(px(0));
    if number == 0 {
        return wall((-PITCH, 0), (PITCH * parameters.bodies as i16, 16), material);
    }
    let mut position = at(PITCH * (number as i16 - 1), -106);
    position.x += I16F16::from_bits(parameters.jitter(u32::from(number)));
    let shape = if parameters.variant.mix == Mix::Shapes { circle(px(6)) } else { square(px(6)) };
    body(shape, position, material)
}

fn promises(parameters: &Parameters) -> Promises {
    let right = PITCH * parameters.bodies as i16;
    let from = settled(parameters, SCENE.gravity, 100);
    Promises::from_iter([
        // The last step of the fall is up to 5.8 px long, at gravity 600, and all of it may end below the floor's top.
        Promise::Within { min: at(-PITCH, -200), max: at(right, 0), tolerance: px(6) },
        Promise::Rest { from, body: None, at_most: ratio(1, 100) },
        Promise::Penetration { from, at_most: ratio(3, 100) },
    ])
}
