//! Boxes slide over a floor and stop.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Vec2, vec2};

use super::{COMMON, at, body, dull, floor, square, usual};
use crate::parameters::{Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const HALF: i16 = 6;
const FRICTION: I16F16 = ratio(3, 10);
/// Start speed of the first box, px/s.
const SPEED: i16 = 100;

pub(crate) const SLIDE: Scene = Scene {
    name: "slide",
    purpose: "boxes that slide at 100, 120, 140 and 160 px/s stop where Coulomb's friction says",
    effects: Effects::GRAVITY.and(Effects::FRICTION),
    steps: 300,
    defaults: usual(4),
    bodies: 1..=4,
    gravity: 600,
    takes: Takes { gravities: &[200], ..Takes::GRAVITIES },
    body: |_, number| match number {
        0 => floor(FRICTION),
        _ => sliding(at(300 * number as i16, -HALF), speed(number)),
    },
    promises: |parameters| {
        (1..=parameters.bodies)
            .map(|body| Promise::StopDistance {
                body,
                distance: distance(parameters, SLIDE.gravity, speed(body)),
                tolerance: ratio(1, 100),
            })
            .collect()
    },
    ..COMMON
};

pub(crate) const PIGGYBACK: Scene = Scene {
    name: "piggyback",
    purpose: "boxes slide on a floor as one, each on the other's back",
    defaults: usual(2),
    bodies: 2..=4,
    gravity: 200,
    takes: Takes::GRAVITIES,
    body: |_, number| match number {
        0 => floor(FRICTION),
        _ => sliding(at(0, HALF - 2 * HALF * number as i16), SPEED),
    },
    promises: |parameters| {
        let mut promises = Promises::from_iter([Promise::StopDistance {
            body: 1,
            distance: distance(parameters, PIGGYBACK.gravity, SPEED),
            tolerance: ratio(2, 100),
        }]);
        for body in 2..=parameters.bodies {
            // There is room for the three pairs.
            let _ = promises.push(Promise::Slip { bodies: [body - 1, body], at_most: ratio(1, 10) });
        }
        promises
    },
    ..SLIDE
};

fn speed(number: u16) -> i16 {
    SPEED + 20 * (number as i16 - 1)
}

fn sliding(position: Vec2<I16F16>, speed: i16) -> BodyDef<Fixed> {
    BodyDef { velocity: vec2(px(speed), px(0)), ..body(square(px(HALF)), position, dull(FRICTION)) }
}

/// `v^2 / (2 mu g)` (Coulomb).
fn distance(parameters: &Parameters, gravity: i16, speed: i16) -> I16F16 {
    let gravity = i64::from(parameters.variant.gravity.unwrap_or(gravity));
    let squared = i64::from(speed) * i64::from(speed);
    // mu = 3/10, in units of 2^-16.
    I16F16::from_bits(((squared << 16) * 10 / (2 * 3 * gravity.max(1))) as i32)
}
