//! Light bodies between heavy ones that close in.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects};

use super::{COMMON, STANDING, at, body, dull, square, usual, wall};
use crate::parameters::Takes;
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const HALF: i16 = 6;
/// Speed of those that close in, px/s.
const SPEED: i16 = 30;
/// Distance between crosses, and between clamps, px.
const PITCH: i16 = 100;

/// Masses in the middle and around it, cross by cross.
const CROSSES: [(I16F16, I16F16); 3] = [(px(1), px(100)), (px(100), px(1)), (ratio(1, 100), px(10_000))];

pub(crate) const VICE: Scene = Scene {
    name: "vice",
    purpose: "four close in on one from all sides: 100 times its mass, a hundredth, a million times",
    effects: Effects::NONE,
    steps: 600,
    defaults: usual(15),
    bodies: 5..=15,
    gravity: 0,
    takes: Takes::PLACES,
    total: |parameters| parameters.bodies,
    body: |_, number| {
        let (cross, place) = (usize::from(number / 5), usize::from(number % 5));
        let (x, y) = [(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)][place];
        let (middle, around) = CROSSES[cross];
        let mass = if place == 0 { middle } else { around };
        let position = at(PITCH * cross as i16 + 20 * x, 20 * y);
        BodyDef { velocity: at(-SPEED * x, -SPEED * y), mass, ..body(square(px(HALF)), position, dull(px(0))) }
    },
    promises: |_| {
        Promises::from_iter([
            Promise::Penetration { from: 120, at_most: STANDING },
            // Nobody leaves faster than the four came.
            Promise::Rest { from: 1, body: None, at_most: px(SPEED) + ratio(1, 100) },
        ])
    },
    ..COMMON
};

/// Masses of those that are clamped and of those that clamp them, side by side.
const CLAMPS: [(I16F16, I16F16); 3] = [(px(1), px(1)), (px(1), px(100)), (ratio(1, 100), px(10_000))];

pub(crate) const CLAMP: Scene = Scene {
    name: "clamp",
    purpose: "boxes of mass 1, 100 and 10 000 press boxes of mass 1, 1 and 0.01 against a wall, and stop",
    defaults: usual(6),
    bodies: 2..=6,
    total: |parameters| parameters.bodies + 1,
    body: |_, number| {
        if number == 0 {
            return wall((0, -PITCH), (16, 3 * PITCH), dull(px(0)));
        }
        let (clamp, second) = (usize::from((number - 1) / 2), number.is_multiple_of(2));
        let (light, heavy) = CLAMPS[clamp];
        // 10 px of air on both sides of the light one.
        let (x, mass, speed) = if second { (-50, heavy, SPEED) } else { (-16, light, 0) };
        let position = at(x, PITCH * clamp as i16);
        BodyDef { velocity: at(speed, 0), mass, ..body(square(px(HALF)), position, dull(px(0))) }
    },
    ..VICE
};
