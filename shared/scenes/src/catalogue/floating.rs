//! Bodies that touch where nothing pulls.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed};

use super::{COMMON, at, body, circle, dull, square, usual};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const HALF: i16 = 6;
/// Distance between clusters, px.
const PITCH: i16 = 100;
/// Bodies side by side in each of the clusters: a column, a block, a row.
const WIDTHS: [u16; 3] = [1, 3, u16::MAX];

pub(crate) const SCENE: Scene = Scene {
    name: "floating",
    purpose: "a column, a block and a row of bodies that touch exactly, where nothing pulls: no bit of them changes",
    effects: Effects::FRICTION,
    steps: 600,
    defaults: usual(30),
    bodies: 3..=90,
    gravity: 0,
    takes: Takes { gap: true, mixes: &[Mix::Masses, Mix::Shapes], ..Takes::PLACES },
    total: |parameters| parameters.bodies,
    body: member,
    promises: |_| Promises::from_iter([Promise::Still { from: 1 }, Promise::Penetration { from: 1, at_most: px(0) }]),
    ..COMMON
};

/// By clusters in turn, each row by row from its own corner.
fn member(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let (cluster, place) = (number % 3, number / 3);
    let width = WIDTHS[usize::from(cluster)];
    let (column, row) = ((place % width) as i16, (place / width) as i16);
    let pitch = 2 * HALF + i16::from(parameters.variant.gap);
    let position = at(PITCH * cluster as i16 + pitch * column, pitch * row);
    let mix = parameters.variant.mix;
    let shape = if mix == Mix::Shapes && place % 2 == 1 { circle(px(HALF)) } else { square(px(HALF)) };
    // 1 to 100.
    let random = || px(1 + (parameters.jitter(number.into()).unsigned_abs() % 100) as i16);
    let mass = if mix == Mix::Masses { random() } else { px(1) };
    BodyDef { mass, ..body(shape, position, dull(ratio(3, 10))) }
}
