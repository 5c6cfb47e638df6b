//! Bodies move at constant speed for a long time.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, vec2};

use super::{COMMON, at, body, bouncy, circle, usual};
use crate::parameters::{Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

pub(crate) const SCENE: Scene = Scene {
    name: "drift",
    purpose: "2, 1/2, 1/8 and 1/32 px/s, to the left and to the right: nothing is lost to rounding, not in an hour",
    effects: Effects::NONE,
    steps: 3600,
    long: Some(216_000),
    defaults: usual(8),
    bodies: 2..=8,
    gravity: 0,
    takes: Takes::PLACES,
    total: |parameters| parameters.bodies,
    body: member,
    promises,
    ..COMMON
};

/// By pairs that part from the middle, each pair a row further down.
fn member(_parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let pair = number / 2;
    let speed = px(2) / (1 << (2 * pair));
    let (x, speed) = if number.is_multiple_of(2) { (-8, -speed) } else { (8, speed) };
    BodyDef { velocity: vec2(speed, px(0)), ..body(circle(px(4)), at(x, 16 * pair as i16), bouncy(px(0))) }
}

fn promises(parameters: &Parameters) -> Promises {
    let mut promises = Promises::from_iter([Promise::Travel { tolerance: ratio(2, 10_000) }]);
    for pair in 0..parameters.bodies / 2 {
        // There is room for the four pairs.
        let _ = promises.push(Promise::Opposite { bodies: [2 * pair, 2 * pair + 1] });
    }
    promises
}
