//! Bodies come and go all the time.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Material};

use super::{COMMON, at, body, circle, usual, wall};
use crate::parameters::Parameters;
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const RADIUS: i16 = 6;
const WALLS: u16 = 3;
/// Balls in a row.
const ROW: u16 = 5;
/// Inner size of the trough, px.
const WIDE: i16 = 80;
const HIGH: i16 = 200;

pub(crate) const SCENE: Scene = Scene {
    name: "churn",
    purpose: "balls fall into a trough; every other step one is taken out and dropped again, thousands of times",
    effects: Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::FRICTION),
    steps: 1200,
    long: Some(7200),
    defaults: usual(20),
    bodies: 1..=20,
    total: |parameters| parameters.bodies + WALLS,
    body: member,
    script: Some(|parameters, cue, control| {
        if cue.step.is_multiple_of(2) {
            control.replace(WALLS + (cue.step / 2 % u32::from(parameters.bodies)) as u16);
        }
    }),
    promises: |parameters| {
        let gravity = u32::from(parameters.variant.gravity.unwrap_or(SCENE.gravity).unsigned_abs());
        // Nobody is faster than after a fall through all of it: v = sqrt(2 g h).
        let fastest = (2 * gravity * u32::from(HIGH.unsigned_abs())).isqrt() as i16 + 1;
        Promises::from_iter([
            Promise::Within { min: at(0, -HIGH), max: at(WIDE, 0), tolerance: px(RADIUS) },
            Promise::Rest { from: 1, body: None, at_most: px(fastest) },
        ])
    },
    ..COMMON
};

/// The first three are floor, left and right; then row by row, in the upper half.
fn member(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let material = Material { restitution: ratio(1, 5), friction: ratio(3, 10), ..Material::DEFAULT };
    match number {
        0 => wall((-16, 0), (WIDE + 16, 16), material),
        1 => wall((-16, -HIGH), (0, 0), material),
        2 => wall((WIDE, -HIGH), (WIDE + 16, 0), material),
        _ => {
            let (row, column) = ((number - WALLS) / ROW, (number - WALLS) % ROW);
            let mut position = at(8 + 16 * column as i16, 8 - HIGH + 16 * row as i16);
            position.x += I16F16::from_bits(parameters.jitter(number.into()));
            body(circle(px(RADIUS)), position, material)
        }
    }
}
