//! Bodies that start where they can't be.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, vec2};

use super::{COMMON, at, body, circle, dull, floor, square, usual};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const HALF: i16 = 6;

pub(crate) const COINCIDENT: Scene = Scene {
    name: "coincident",
    purpose: "nine bodies in one place come apart, and none is shot out",
    effects: Effects::NONE,
    steps: 300,
    defaults: usual(9),
    bodies: 2..=16,
    gravity: 0,
    takes: Takes { mixes: &[Mix::Sizes, Mix::Masses, Mix::Shapes], ..Takes::PLACES },
    total: |parameters| parameters.bodies,
    // All of them overlap with all.
    contacts: |parameters, _| parameters.bodies * parameters.bodies,
    body: |parameters, number| {
        let mix = parameters.variant.mix;
        let half = if mix == Mix::Sizes { px(4 + (number % 5) as i16) } else { px(HALF) };
        let mass = if mix == Mix::Masses { px(1 + number as i16) } else { px(1) };
        let shape = if mix == Mix::Shapes && number % 2 == 1 { square(half) } else { circle(half) };
        BodyDef { mass, ..body(shape, at(0, 0), dull(px(0))) }
    },
    promises: |_| apart(),
    ..COMMON
};

pub(crate) const OVERLAPPING: Scene = Scene {
    name: "overlapping",
    purpose: "boxes on a floor that start 25, 50, 75 and 100 % inside each other come apart, and none is shot out",
    effects: Effects::GRAVITY.and(Effects::FRICTION),
    defaults: usual(8),
    bodies: 2..=8,
    gravity: 200,
    takes: Takes { gravities: &[600], mixes: &[Mix::Masses, Mix::Shapes], ..Takes::PLACES },
    total: |parameters| parameters.bodies + 1,
    body: overlapping,
    ..COINCIDENT
};

/// Number 0 is the floor; then by pairs, each 40 px right of the last.
fn overlapping(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let friction = ratio(3, 10);
    if number == 0 {
        return floor(friction);
    }
    let (pair, second) = ((number as i16 - 1) / 2, number.is_multiple_of(2));
    // What is left of a side outside: 3/4, 1/2, 1/4, 0.
    let outside = px(2 * HALF) * i32::from(3 - pair) / 4;
    let x = px(40 * pair) + if second { outside } else { I16F16::ZERO };
    let mix = parameters.variant.mix;
    let shape = if mix == Mix::Shapes && second { circle(px(HALF)) } else { square(px(HALF)) };
    let mass = if mix == Mix::Masses && second { px(20) } else { px(1) };
    BodyDef { mass, ..body(shape, vec2(x, px(-HALF)), dull(friction)) }
}

fn apart() -> Promises {
    Promises::from_iter([
        // A little more than what solvers leave alone, 0.02 px.
        Promise::Penetration { from: 60, at_most: ratio(1, 40) },
        Promise::Rest { from: 1, body: None, at_most: px(200) },
    ])
}
