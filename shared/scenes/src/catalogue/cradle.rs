//! Rows of balls collide where nothing pulls.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, vec2};

use super::{COMMON, at, body, bouncy, circle, square, usual};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const RADIUS: i16 = 6;

pub(crate) const CRADLE: Scene = Scene {
    name: "cradle",
    purpose: "one ball hits four that touch: momentum and energy go on",
    effects: Effects::BOUNCE,
    steps: 300,
    defaults: usual(5),
    bodies: 2..=40,
    gravity: 0,
    takes: Takes { gap: true, mixes: &[Mix::Shapes], ..Takes::PLACES },
    total: |parameters| parameters.bodies,
    body: |parameters, number| match number {
        0 => member(parameters, -60, 100, number),
        _ => member(parameters, pitch(parameters) * (number as i16 - 1), 0, number),
    },
    promises: |_| {
        Promises::from_iter([
            Promise::Energy { from: 1, body: None, at_least: ratio(99, 100), at_most: ratio(101, 100) },
            Promise::Momentum,
        ])
    },
    ..COMMON
};

pub(crate) const CHAINS: Scene = Scene {
    name: "chains",
    purpose: "two rows of ten collide head on: the sum of momenta stays, and energy doesn't grow",
    defaults: usual(20),
    body: |parameters, number| {
        // From the middle to the left, then from the middle to the right.
        let half = parameters.bodies / 2;
        let (side, place) = if number < half { (-1, number) } else { (1, number - half) };
        let x = side * (30 + pitch(parameters) * place as i16);
        member(parameters, x, -50 * side, number)
    },
    promises: |_| {
        Promises::from_iter([
            Promise::Energy { from: 1, body: None, at_least: px(0), at_most: ratio(1001, 1000) },
            Promise::Momentum,
        ])
    },
    ..CRADLE
};

fn pitch(parameters: &Parameters) -> i16 {
    2 * RADIUS + i16::from(parameters.variant.gap)
}

fn member(parameters: &Parameters, x: i16, speed: i16, number: u16) -> BodyDef<Fixed> {
    let boxed = parameters.variant.mix == Mix::Shapes && number % 2 == 1;
    let shape = if boxed { square(px(RADIUS)) } else { circle(px(RADIUS)) };
    BodyDef { velocity: vec2(px(speed), px(0)), ..body(shape, at(x, 0), bouncy(px(1))) }
}
