//! Heaps without friction: nothing but the floor touches them from outside, so they can't start to move sideways as a whole.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Fixed, Vec2, vec2};

use super::{COMMON, at, body, circle, dull, floor, usual};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const RADIUS: i16 = 6;

pub(crate) const HEAP: Scene = Scene {
    name: "heap",
    purpose: "a heap of balls without friction flows apart: its centre of mass doesn't move sideways",
    steps: 300,
    defaults: usual(45),
    bodies: 1..=200,
    takes: Takes { gravities: &[600], mixes: &[Mix::Masses], ..Takes::PLACES },
    body: |parameters, number| match number {
        0 => floor(px(0)),
        _ => heaped(parameters, number),
    },
    promises: |_| sideways(),
    ..COMMON
};

pub(crate) const ZIGZAG: Scene = Scene {
    name: "zigzag",
    purpose: "a zigzag column of balls without friction gives way: its centre of mass doesn't move sideways",
    defaults: usual(10),
    bodies: 2..=50,
    body: |parameters, number| match number {
        0 => floor(px(0)),
        _ => zigzag(parameters, number),
    },
    ..HEAP
};

/// Rows of nine, every other shifted by half a ball, none in line with another.
fn heaped(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let (row, column) = (((number - 1) / 9) as i16, ((number - 1) % 9) as i16);
    let x = px(13 * column + 6 * (row % 2)) + I16F16::from_bits(parameters.jitter(number.into())) / 4;
    ball(parameters, number, vec2(x, px(-RADIUS - 12 * row)))
}

/// Each up to 4 px left or right of the middle, and on the last.
fn zigzag(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let side = if number.is_multiple_of(2) { px(3) } else { px(-3) };
    let x = side + I16F16::from_bits(parameters.jitter(number.into()));
    ball(parameters, number, vec2(x, px(-RADIUS - 12 * (number as i16 - 1))))
}

fn ball(parameters: &Parameters, number: u16, position: Vec2<I16F16>) -> BodyDef<Fixed> {
    let mass = if parameters.variant.mix == Mix::Masses { px(1 + (number % 10) as i16) } else { px(1) };
    BodyDef { mass, ..body(circle(px(RADIUS)), position, dull(px(0))) }
}

fn sideways() -> Promises {
    Promises::from_iter([
        Promise::CentreOfMass { at_most: ratio(1, 100) },
        Promise::Within { min: at(-2000, -4000), max: at(2000, 0), tolerance: px(RADIUS) },
    ])
}
