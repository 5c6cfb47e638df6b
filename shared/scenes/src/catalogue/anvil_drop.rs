//! Something heavy falls on a stack.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed};

use super::{COMMON, STANDING, at, body, dull, floor, settled, square, usual};
use crate::parameters::Takes;
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const HALF: i16 = 6;
const FALL: i16 = 100;

pub(crate) const SCENE: Scene = Scene {
    name: "anvil_drop",
    purpose: "a box of mass 50 falls 100 px on a stack of five: nothing is thrown up, nothing sinks in",
    effects: Effects::GRAVITY.and(Effects::FRICTION),
    steps: 600,
    defaults: usual(6),
    bodies: 2..=20,
    takes: Takes::GRAVITIES,
    body: |parameters, number| {
        let friction = ratio(3, 10);
        let rests = at(0, HALF - 2 * HALF * number as i16);
        let last = number == parameters.bodies;
        let position = if last { rests + at(0, -FALL) } else { rests };
        let mass = if last { px(50) } else { px(1) };
        match number {
            0 => floor(friction),
            _ => BodyDef::<Fixed> { mass, ..body(square(px(HALF)), position, dull(friction)) },
        }
    },
    promises: |parameters| {
        let from = settled(parameters, SCENE.gravity, FALL as u32);
        Promises::from_iter([
            Promise::Down { at_most: px(1) },
            Promise::Penetration { from, at_most: STANDING },
            Promise::Still { from },
        ])
    },
    ..COMMON
};
