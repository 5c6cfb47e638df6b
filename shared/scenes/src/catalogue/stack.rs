//! Bodies stand on each other, as they are or under something heavy.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Shape, vec2};

use super::{COMMON, STANDING, at, body, circle, dull, floor, settled, usual};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const HALF: i16 = 6;

pub(crate) const STACK: Scene = Scene {
    name: "stack",
    purpose: "boxes stand on each other: none sinks in, nothing moves, and the floor carries them all",
    effects: Effects::GRAVITY.and(Effects::FRICTION),
    steps: 3600,
    defaults: usual(10),
    bodies: 1..=100,
    sizes: &[20, 50],
    takes: Takes { gravities: &[600, 2000], ..Takes::ALL },
    body: |parameters, number| member(parameters, number, EQUAL),
    promises: |parameters| promises(parameters, EQUAL),
    ..COMMON
};

pub(crate) const HEAVY_TOP: Scene = Scene {
    name: "heavy_top",
    purpose: "a box of mass 100 on nine of mass 1",
    sizes: &[],
    takes: Takes { mixes: &[Mix::Sizes, Mix::Shapes], ..STACK.takes },
    body: |parameters, number| member(parameters, number, HUNDRED),
    promises: |parameters| promises(parameters, HUNDRED),
    ..STACK
};

pub(crate) const ANVIL: Scene = Scene {
    name: "anvil",
    purpose: "a box of mass 1000 on one of mass 1",
    defaults: usual(2),
    body: |parameters, number| member(parameters, number, THOUSAND),
    promises: |parameters| promises(parameters, THOUSAND),
    ..HEAVY_TOP
};

pub(crate) const FEATHER: Scene = Scene {
    name: "feather",
    purpose: "a box of mass 10 000 on one of mass 0.01",
    body: |parameters, number| member(parameters, number, MILLION),
    promises: |parameters| promises(parameters, MILLION),
    ..ANVIL
};

/// Masses of the one on top and of the others.
#[derive(Clone, Copy)]
struct Masses {
    top: I16F16,
    others: I16F16,
}

const EQUAL: Masses = Masses { top: px(1), others: px(1) };
const HUNDRED: Masses = Masses { top: px(100), others: px(1) };
const THOUSAND: Masses = Masses { top: px(1000), others: px(1) };
const MILLION: Masses = Masses { top: px(10_000), others: ratio(1, 100) };

/// Number 0 is the floor; then from it up, each up to a px off the middle.
fn member(parameters: &Parameters, number: u16, masses: Masses) -> BodyDef<Fixed> {
    let material = dull(ratio(3, 10));
    if number == 0 {
        return floor(ratio(3, 10));
    }
    let gap = px(parameters.variant.gap.into());
    let below: I16F16 = (1..number).map(|number| 2 * half_height(parameters, number) + gap).sum();
    let half = half_height(parameters, number);
    let position = vec2(I16F16::from_bits(parameters.jitter(number.into())), -(below + gap + half));
    let shape = match parameters.variant.mix {
        // A circle on a circle would roll off.
        Mix::Shapes if number.is_multiple_of(2) => circle(half),
        Mix::Sizes => Shape::Box { half: vec2(px(HALF + 2) - half / 4, half) },
        _ => Shape::Box { half: vec2(px(HALF), half) },
    };
    BodyDef { mass: mass(parameters, number, masses), ..body(shape, position, material) }
}

fn half_height(parameters: &Parameters, number: u16) -> I16F16 {
    match parameters.variant.mix {
        // 5 to 7 px, in steps of 1/65 536.
        Mix::Sizes => px(HALF) + I16F16::from_bits(parameters.jitter(1000 + u32::from(number))),
        _ => px(HALF),
    }
}

fn mass(parameters: &Parameters, number: u16, masses: Masses) -> I16F16 {
    match parameters.variant.mix {
        // 1 to 100.
        Mix::Masses => px(1 + (parameters.jitter(2000 + u32::from(number)).unsigned_abs() % 100) as i16),
        _ if number == parameters.bodies => masses.top,
        _ => masses.others,
    }
}

fn promises(parameters: &Parameters, masses: Masses) -> Promises {
    let (bodies, gap) = (parameters.bodies, i16::from(parameters.variant.gap));
    let from = settled(parameters, STACK.gravity, u32::from(bodies) * u32::from(parameters.variant.gap));
    let high = bodies as i16 * (2 * (HALF + 1) + gap);
    let mut promises = Promises::from_iter([
        Promise::Penetration { from, at_most: STANDING },
        Promise::Still { from },
        // Whoever lands fast may end a step in the floor.
        Promise::Within { min: at(-10, -high), max: at(10, HALF), tolerance: px(1) },
    ]);
    // Impulses are not for reading where bodies of little mass pass on the weight of many.
    if bodies <= 10 && masses.top == masses.others {
        let mass = (1..=bodies).map(|number| mass(parameters, number, masses)).sum();
        // There is room for it.
        let _ = promises.push(Promise::Load { body: 0, from, mass, tolerance: ratio(1, 1000) });
    }
    promises
}
