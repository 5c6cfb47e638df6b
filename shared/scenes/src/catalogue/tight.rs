//! Tight places: wedges, edges, tiny beside huge, one between four.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, vec2};

use super::{COMMON, STANDING, at, body, circle, dull, settled, square, usual, wall};
use crate::parameters::{Mix, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

pub(crate) const WEDGE: Scene = Scene {
    name: "wedge",
    purpose: "balls fall into gaps too narrow for them, between boxes and between balls, and stay",
    effects: Effects::GRAVITY.and(Effects::FRICTION),
    steps: 600,
    defaults: usual(2),
    bodies: 2..=2,
    takes: Takes { gravities: &[600, 2000], ..Takes::GRAVITIES },
    total: |_| 6,
    body: |_, number| {
        let friction = ratio(3, 10);
        let anchored = |x| BodyDef { material: dull(friction), ..BodyDef::fixed(circle(px(20)), at(x, 20)) };
        match number {
            // 10 px apart, and 8 px apart at their narrowest.
            0 => wall((-40, 0), (-5, 40), dull(friction)),
            1 => wall((5, 0), (40, 40), dull(friction)),
            2 => anchored(76),
            3 => anchored(124),
            4 => body(circle(px(6)), at(0, -30), dull(friction)),
            _ => body(circle(px(8)), at(100, -30), dull(friction)),
        }
    },
    promises: |parameters| {
        let from = settled(parameters, WEDGE.gravity, 60);
        Promises::from_iter([
            Promise::Penetration { from, at_most: STANDING },
            Promise::Rest { from, body: None, at_most: ratio(1, 100) },
        ])
    },
    ..COMMON
};

pub(crate) const TWO_PIXELS: Scene = Scene {
    name: "two_pixels",
    purpose: "a box stands on two pixels, a px under each end",
    defaults: usual(1),
    bodies: 1..=1,
    total: |_| 3,
    body: |_, number| {
        let friction = ratio(3, 10);
        match number {
            0 => wall((-8, 0), (-7, 1), dull(friction)),
            1 => wall((7, 0), (8, 1), dull(friction)),
            _ => body(square(px(8)), at(0, -8), dull(friction)),
        }
    },
    promises: |_| standing(60),
    ..WEDGE
};

pub(crate) const TINY_AND_HUGE: Scene = Scene {
    name: "tiny_and_huge",
    purpose: "boxes of 1 px stand under, on and beside boxes of 200 px",
    defaults: usual(6),
    bodies: 6..=6,
    takes: Takes { mixes: &[Mix::Masses], ..WEDGE.takes },
    total: |_| 7,
    body: |parameters, number| {
        let friction = ratio(3, 10);
        let (tiny, huge) = (ratio(1, 2), px(100));
        let (half, position) = match number {
            0 => return super::floor(friction),
            1 => (tiny, vec2(px(-90), -tiny)),
            2 => (tiny, vec2(px(90), -tiny)),
            // On two of 1 px, with one on its back.
            3 => (huge, vec2(px(0), px(-101))),
            4 => (tiny, vec2(px(30), px(-201) - tiny)),
            // Beside each other.
            5 => (huge, at(400, -100)),
            _ => (tiny, vec2(px(500) + tiny, -tiny)),
        };
        let mass = if parameters.variant.mix == Mix::Masses && half == huge { px(10_000) } else { px(1) };
        BodyDef::<Fixed> { mass, ..body(square(half), position, dull(friction)) }
    },
    promises: |_| standing(60),
    ..WEDGE
};

pub(crate) const SQUEEZED: Scene = Scene {
    name: "squeezed",
    purpose: "a box between four that close in on it from all sides",
    effects: Effects::NONE,
    defaults: usual(5),
    bodies: 5..=5,
    gravity: 0,
    takes: Takes { mixes: &[Mix::Shapes], ..Takes::PLACES },
    total: |_| 5,
    body: |parameters, number| {
        let (x, y) = [(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)][usize::from(number)];
        let shape = if parameters.variant.mix == Mix::Shapes { circle(px(6)) } else { square(px(6)) };
        BodyDef { velocity: at(-30 * x, -30 * y), ..body(shape, at(20 * x, 20 * y), dull(px(0))) }
    },
    promises: |_| {
        Promises::from_iter([
            Promise::Penetration { from: 60, at_most: STANDING },
            // Nobody leaves faster than the four came.
            Promise::Rest { from: 1, body: None, at_most: px(30) },
        ])
    },
    ..WEDGE
};

fn standing(from: u32) -> Promises {
    Promises::from_iter([Promise::Penetration { from, at_most: STANDING }, Promise::Still { from }])
}
