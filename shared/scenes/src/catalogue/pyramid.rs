//! A pyramid of boxes stands: each but those on the floor rests on two.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, vec2};

use super::{COMMON, STANDING, at, body, dull, floor, settled, square, usual};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const SIDE: i16 = 12;
/// Distance between neighbours in a row, px; even, so that the row above is in the middle.
const PITCH: i16 = 14;

pub(crate) const SCENE: Scene = Scene {
    name: "pyramid",
    purpose: "a pyramid on a base of ten boxes stands still",
    effects: Effects::GRAVITY.and(Effects::FRICTION),
    steps: 3600,
    defaults: usual(55),
    bodies: 1..=210,
    takes: Takes { mixes: &[Mix::Masses], ..Takes::ALL },
    body: member,
    promises,
    ..COMMON
};

/// Boxes in the lowest row: the least with which all find room.
fn base(parameters: &Parameters) -> u16 {
    (1..parameters.bodies).find(|base| base * (base + 1) / 2 >= parameters.bodies).unwrap_or(1)
}

/// Number 0 is the floor; then row by row, from it up.
fn member(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let friction = ratio(3, 10);
    if number == 0 {
        return floor(friction);
    }
    let (mut place, mut row, mut width) = (number - 1, 0, base(parameters));
    while place >= width {
        (place, row, width) = (place - width, row + 1, width - 1);
    }
    let left = -PITCH / 2 * (width as i16 - 1);
    let up = row * (SIDE + i16::from(parameters.variant.gap)) + i16::from(parameters.variant.gap);
    let position = vec2(px(left + PITCH * place as i16), px(-up - SIDE / 2));
    let mass = match parameters.variant.mix {
        // 1 to 100.
        Mix::Masses => px(1 + (parameters.jitter(number.into()).unsigned_abs() % 100) as i16),
        _ => px(1),
    };
    BodyDef { mass, ..body(square(px(SIDE / 2)), position, dull(friction)) }
}

fn promises(parameters: &Parameters) -> Promises {
    let (rows, gap) = (base(parameters) as i16, i16::from(parameters.variant.gap));
    let from = settled(parameters, SCENE.gravity, u32::from(rows.unsigned_abs()) * u32::from(parameters.variant.gap));
    let wide = PITCH * rows / 2;
    Promises::from_iter([
        Promise::Penetration { from, at_most: STANDING },
        Promise::Still { from },
        Promise::Within { min: at(-wide, -rows * (SIDE + gap)), max: at(wide, 0), tolerance: px(1) },
    ])
}
