//! Balls of different restitution bounce side by side.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Material};

use super::{COMMON, at, body, bouncy, circle, square, usual, wall};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const PITCH: i16 = 32;
const RADIUS: i16 = 6;
const HEIGHT: i16 = 100;
/// The one with restitution 1.
const ELASTIC: u16 = 1;
/// The one with restitution 1/2.
const HALF: u16 = 3;

pub(crate) const SCENE: Scene = Scene {
    name: "bounce",
    purpose: "balls of restitution 1, .75, .5, .25, 0 drop 100 px and bounce for a minute",
    effects: Effects::GRAVITY.and(Effects::BOUNCE),
    // A little more than a minute, so that the apex nearest to it is over.
    steps: 3720,
    defaults: usual(5),
    bodies: 1..=200,
    takes: Takes { mixes: &[Mix::Masses, Mix::Shapes], ..Takes::GRAVITIES },
    body: member,
    promises,
    ..COMMON
};

/// Number 0 is the floor, its top at y = 0.
fn member(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    if number == 0 {
        return wall((-PITCH, 0), (PITCH * parameters.bodies as i16, 16), Material::DEFAULT);
    }
    let mut position = at(PITCH * (number as i16 - 1), -HEIGHT - RADIUS);
    position.x += I16F16::from_bits(parameters.jitter(u32::from(number)));
    let boxed = parameters.variant.mix == Mix::Shapes;
    let shape = if boxed { square(px(RADIUS)) } else { circle(px(RADIUS)) };
    let mass = if parameters.variant.mix == Mix::Masses { px(number as i16) } else { px(1) };
    BodyDef { mass, ..body(shape, position, bouncy(restitution(number))) }
}

fn restitution(number: u16) -> I16F16 {
    px(1) - ratio((number as i16 - 1) % 5, 4)
}

/// A ball rises to `restitution^2` of the height that it fell from, after each bounce.
fn promises(parameters: &Parameters) -> Promises {
    let right = PITCH * parameters.bodies as i16;
    let mut promises = Promises::from_iter([Promise::Within {
        min: at(-PITCH, -HEIGHT - 2 * RADIUS - 1),
        max: at(right, 0),
        tolerance: ratio(7, 2),
    }]);
    let apex = |body, bounce, height: I16F16, percent: i16| Promise::Apex {
        body,
        bounce,
        y: -px(RADIUS) - height,
        tolerance: height * i32::from(percent) / 100,
    };
    // The last before a minute is over: one up and down takes 2 sqrt(2 h / g), in steps.
    let gravity = u32::from(parameters.variant.gravity.unwrap_or(SCENE.gravity).unsigned_abs().max(1));
    let period = (14_400 * 2 * HEIGHT.unsigned_abs() as u32 / gravity).isqrt();
    let last = (3600 / period) as u16;
    let mut promise = |made| {
        // There is room for all of them.
        let _ = promises.push(made);
    };
    for bounce in [1, 5, 10, last] {
        promise(apex(ELASTIC, bounce, px(HEIGHT), 1));
    }
    promise(Promise::Energy { from: 1, body: Some(ELASTIC), at_least: px(0), at_most: ratio(10_001, 10_000) });
    if parameters.bodies >= HALF {
        promise(apex(HALF, 1, px(HEIGHT) / 4, 2));
        promise(apex(HALF, 2, px(HEIGHT) / 16, 2));
        // Falls for half a period, then for 1/2, 1/4, ... of one.
        promise(Promise::Rest { from: 2 * period, body: Some(HALF), at_most: ratio(1, 100) });
    }
    promises
}
