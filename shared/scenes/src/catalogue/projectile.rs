//! Bodies are thrown and meet nothing.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Fixed, vec2};

use super::{COMMON, at, bouncy, circle, usual};
use crate::parameters::Parameters;
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

/// Steps in the air: 10 s.
const FLIGHT: u32 = 600;

pub(crate) const SCENE: Scene = Scene {
    name: "projectile",
    purpose: "balls fly for 10 s where p + v t + g t^2 / 2 says",
    steps: FLIGHT,
    defaults: usual(5),
    bodies: 1..=40,
    total: |parameters| parameters.bodies,
    body,
    promises: |_| Promises::from_iter([Promise::Parabola { at_most: ratio(1, 64) }]),
    ..COMMON
};

/// All start at the origin, ever faster to the right, with what brings them back to their height at the end.
fn body(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let gravity = parameters.variant.gravity.unwrap_or(SCENE.gravity);
    let velocity = vec2(px(number as i16) * 25 / 2, px(-5 * gravity));
    // They start in the same place: no layer, no contact.
    BodyDef { velocity, layer: 0, mask: 0, ..super::body(circle(px(4)), at(0, 0), bouncy(px(0))) }
}
