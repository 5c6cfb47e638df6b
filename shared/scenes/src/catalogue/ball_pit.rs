//! Balls fall into a heap in a closed room.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Level, Material, vec2};

use super::{COMMON, at, circle, short, square, usual, wall};
use crate::parameters::{Mix, Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

const RADIUS: i16 = 6;
const WALLS: u16 = 4;
const THICK: i16 = 16;

pub(crate) const BALL_PIT: Scene = Scene {
    name: "ball_pit",
    purpose: "balls settle into a heap in a closed room: many contacts, none may escape",
    effects: Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::FRICTION),
    defaults: usual(100),
    bodies: 1..=2000,
    sizes: &[200, 400],
    takes: Takes { gap: false, ..Takes::ALL },
    total: |parameters| parameters.bodies + WALLS,
    // Up to 3.2 contacts a ball at 2000 px/s2, 2.6 at 200. At level Flat balls overlap so deeply that far neighbours touch: 2.9 in a
    // pit of 100, 6.6 in one of 2000.
    contacts: |parameters, level| match level {
        Level::Flat => 7 * parameters.bodies + 16,
        Level::Grounded | Level::Exact => 7 * parameters.bodies / 2 + 16,
    },
    body: |parameters, number| member(parameters, number, Style::default()),
    promises,
    // Single pairs, under one seed in ten, where the heap still gives way somewhere.
    shortfalls: &[short("no deep overlap", 300)],
    ..COMMON
};

pub(crate) const BALL_PIT_OFFSET: Scene = Scene {
    name: "ball_pit_offset",
    purpose: "the ball pit with every other row shifted by 5 px",
    body: |parameters, number| member(parameters, number, Style { shift: 5, ..Style::default() }),
    ..BALL_PIT
};

pub(crate) const BALL_PIT_MIXED: Scene = Scene {
    name: "ball_pit_mixed",
    purpose: "the ball pit with radii of 5, 6 and 7 px and masses of 1 and 2",
    takes: Takes { mixes: &[Mix::Shapes], ..BALL_PIT.takes },
    body: |parameters, number| member(parameters, number, Style { shift: 0, sizes: true, masses: true }),
    ..BALL_PIT
};

/// How a pit departs from the plain one.
#[derive(Clone, Copy, Default)]
struct Style {
    /// Of every other row, px.
    shift: i16,
    sizes: bool,
    masses: bool,
}

/// Inner width and height of the room: `20 sqrt(bodies)`, to the nearest px.
fn width(parameters: &Parameters) -> i16 {
    let square = 400 * u32::from(parameters.bodies);
    let root = square.isqrt();
    (root + u32::from(square - root * root > root)) as i16
}

/// The first four are the walls: floor, ceiling, left, right, around (0, 0)..(width, width). The balls stand on a lattice of
/// 16 x 14 px, jittered by up to 1 px, row by row from the floor up.
fn member(parameters: &Parameters, number: u16, style: Style) -> BodyDef<Fixed> {
    let width = width(parameters);
    let material = Material { restitution: ratio(1, 5), friction: ratio(3, 10), ..Material::DEFAULT };
    let (near, far) = (-THICK, width + THICK);
    match number {
        0 => wall((near, width), (far, far), material),
        1 => wall((near, near), (far, 0), material),
        2 => wall((near, 0), (0, width), material),
        3 => wall((width, 0), (far, width), material),
        _ => {
            let ball = number - WALLS;
            let mix = parameters.variant.mix;
            let columns = ((width - style.shift) / 16).max(1) as u16;
            let (column, row) = ((ball % columns) as i16, (ball / columns) as i16);
            let jitter = |axis| I16F16::from_bits(parameters.jitter(2 * u32::from(ball) + axis));
            let x = px(8 + 16 * column + style.shift * (row % 2));
            let position = vec2(x + jitter(0), px(width - 7 - 14 * row) + jitter(1));
            let sized = style.sizes || mix == Mix::Sizes;
            let radius = if sized { RADIUS - 1 + (ball % 3) as i16 } else { RADIUS };
            let heavy = (style.masses || mix == Mix::Masses) && ball % 2 == 1;
            // A square of about the ball's area.
            let boxed = mix == Mix::Shapes && ball % 3 == 1;
            let shape = if boxed { square(px(radius) - px(1) / 2) } else { circle(px(radius)) };
            BodyDef { mass: px(if heavy { 2 } else { 1 }), ..super::body(shape, position, material) }
        }
    }
}

/// A ball whose centre is past the middle of a wall leaves on the other side.
fn promises(parameters: &Parameters) -> Promises {
    let width = width(parameters);
    let tolerance = px(RADIUS + THICK / 2);
    let mut promises = Promises::from_iter([Promise::Within { min: at(0, 0), max: at(width, width), tolerance }]);
    if let Some(at_most) = deepest(parameters) {
        // There is room for the two.
        let _ = promises.push(Promise::Penetration { from: 301, at_most });
    }
    promises
}

/// Deepest overlap once the heap has settled, by size and gravity; none where no bar is set.
fn deepest(parameters: &Parameters) -> Option<I16F16> {
    let strong = parameters.variant.gravity.is_some_and(|gravity| gravity > 200);
    let thousandths = match (parameters.bodies, strong) {
        (..=100, false) => 25,
        (..=100, true) | (..=200, false) => 30,
        (..=400, false) => 100,
        (..=200, true) => 150,
        (..=400, true) => 600,
        _ => return None,
    };
    Some(ratio(thousandths, 1000))
}
