//! Bodies that the game moves push, lift and crush others.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Vec2};

use super::{COMMON, at, body, dull, floor, settled, square, usual, wall};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const HALF: i16 = 6;
/// Speed of what pushes, px/s.
const SPEED: i16 = 60;

pub(crate) const PUSH: Scene = Scene {
    name: "push",
    purpose: "a kinematic box pushes a row of ten over a floor",
    effects: Effects::GRAVITY.and(Effects::FRICTION).and(Effects::KINEMATIC),
    steps: 300,
    defaults: usual(10),
    bodies: 1..=40,
    takes: Takes { mixes: &[Mix::Masses], ..Takes::ALL },
    total: |parameters| parameters.bodies + 2,
    body: |parameters, number| match number {
        0 => floor(ratio(3, 10)),
        1 => moved(at(0, -HALF), SPEED, 0),
        _ => {
            let pitch = 2 * HALF + i16::from(parameters.variant.gap);
            member(parameters, at(pitch * (number as i16 - 1), -HALF), number)
        }
    },
    promises: |parameters| {
        let end = SPEED * 5 + 20 * parameters.bodies as i16;
        Promises::from_iter([
            Promise::Penetration { from: 1, at_most: px(1) },
            Promise::Within { min: at(0, -2 * HALF), max: at(end, 0), tolerance: px(1) },
        ])
    },
    ..COMMON
};

pub(crate) const LIFT: Scene = Scene {
    name: "lift",
    purpose: "a kinematic platform lifts a stack of ten",
    gravity: 600,
    takes: Takes { gravities: &[200], mixes: &[Mix::Masses], ..Takes::ALL },
    total: |parameters| parameters.bodies + 1,
    body: |parameters, number| {
        if number == 0 {
            return moved(at(0, HALF), 0, -SPEED);
        }
        let pitch = 2 * HALF + i16::from(parameters.variant.gap);
        member(parameters, at(0, HALF - pitch * number as i16), number)
    },
    promises: |parameters| {
        let gap = u32::from(parameters.variant.gap);
        let from = if gap == 0 { 1 } else { settled(parameters, LIFT.gravity, gap * u32::from(parameters.bodies)) };
        Promises::from_iter([Promise::Penetration { from, at_most: ratio(1, 4) }])
    },
    ..PUSH
};

/// Steps until the wall that crushes turns back.
const CRUSHED: u32 = 26;

pub(crate) const CRUSH: Scene = Scene {
    name: "crush",
    purpose: "a kinematic wall crushes three boxes to half their width and lets go: they don't shoot out",
    steps: 300,
    defaults: usual(3),
    bodies: 1..=3,
    takes: Takes { mixes: &[Mix::Masses], ..Takes::GRAVITIES },
    total: |parameters| parameters.bodies + 3,
    body: |parameters, number| match number {
        0 => floor(ratio(3, 10)),
        1 => wall((0, -100), (16, 0), dull(ratio(3, 10))),
        // 10 px of air, and 16 px less than the boxes need once it turns back.
        2 => moved(at(-2 * HALF * parameters.bodies as i16 - 10 - HALF, -HALF), SPEED, 0),
        _ => member(parameters, at(HALF - 2 * HALF * (number as i16 - 2), -HALF), number),
    },
    script: Some(|_, cue, control| {
        if cue.step == CRUSHED + 1 {
            control.set_velocity(2, at(-SPEED, 0));
        }
    }),
    promises: |_| Promises::from_iter([Promise::Rest { from: CRUSHED + 1, body: None, at_most: px(48) }]),
    ..PUSH
};

fn moved(position: Vec2<I16F16>, x: i16, y: i16) -> BodyDef<Fixed> {
    let material = dull(ratio(3, 10));
    BodyDef { material, velocity: at(x, y), ..BodyDef::kinematic(square(px(HALF)), position) }
}

fn member(parameters: &Parameters, position: Vec2<I16F16>, number: u16) -> BodyDef<Fixed> {
    let mass = match parameters.variant.mix {
        // 1 to 100.
        Mix::Masses => px(1 + (parameters.jitter(number.into()).unsigned_abs() % 100) as i16),
        _ => px(1),
    };
    BodyDef { mass, ..body(square(px(HALF)), position, dull(ratio(3, 10))) }
}
