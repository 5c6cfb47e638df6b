//! Light beside heavy, at rest.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed};

use super::{COMMON, STANDING, at, body, dull, floor, square, usual};
use crate::parameters::Takes;
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const HALF: i16 = 6;

pub(crate) const SCENE: Scene = Scene {
    name: "beside",
    purpose: "boxes of mass 0.01 and 10 000 stand side by side, touching: neither knows of the other",
    effects: Effects::GRAVITY.and(Effects::FRICTION),
    steps: 600,
    defaults: usual(9),
    bodies: 2..=60,
    takes: Takes { gravities: &[600, 2000], ..Takes::GRAVITIES },
    body: |_, number| {
        let friction = ratio(3, 10);
        if number == 0 {
            return floor(friction);
        }
        let mass = if number % 2 == 1 { ratio(1, 100) } else { px(10_000) };
        let position = at(2 * HALF * (number as i16 - 1), -HALF);
        BodyDef::<Fixed> { mass, ..body(square(px(HALF)), position, dull(friction)) }
    },
    promises: |_| {
        Promises::from_iter([Promise::Penetration { from: 1, at_most: STANDING }, Promise::Still { from: 60 }])
    },
    ..COMMON
};
