//! One-way platforms, case by case.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Shape, Vec2, vec2};

use super::{COMMON, at, body, circle, dull, floor, square, usual};
use crate::buttons::{Buttons, Hold};
use crate::control::Control;
use crate::parameters::{Parameters, Takes, Turns};
use crate::promise::Promise;
use crate::scene::{Demo, Scene};
use crate::script::Moment;

/// Distance between lanes, px.
const PITCH: i16 = 200;
/// Half height of what moves, px.
const HALF: i16 = 5;
/// Upper edge of the ledges, px.
const TOP: i16 = -60;
const LEDGE: Vec2<I16F16> = at(30, 4);

/// Where somebody stands, from the middle of its lane.
const UP: i16 = TOP - HALF;
const DOWN: i16 = -HALF;

/// What comes to a ledge, how, and where it ends.
struct Lane {
    start: (i16, i16),
    velocity: (i16, i16),
    circle: bool,
    end: (i16, i16),
}

const fn lane(start: (i16, i16), velocity: (i16, i16), end: (i16, i16)) -> Lane {
    Lane { start, velocity, circle: false, end }
}

/// The ledge of this lane swings, and carries what stands on it.
const SWINGS: u16 = 6;
/// What stands in this lane drops through when somebody says so.
const DROPS: u16 = 7;

static LANES: [Lane; 10] = [
    // From above it lands: a box, a circle, and one that only just meets the corner.
    lane((0, TOP - 45), (0, 0), (0, UP)),
    Lane { circle: true, ..lane((0, TOP - 45), (0, 0), (0, UP)) },
    lane((-33, TOP - 45), (0, 0), (-33, UP)),
    // From below it gets through, and lands, or sinks back if it doesn't get over the edge.
    lane((0, DOWN), (0, -200), (0, UP)),
    lane((0, DOWN), (0, -150), (0, DOWN)),
    // From the side it gets through, and lands at 49 px with 146 px/s downwards, which costs 0.3 times as much of its 150.
    lane((-60, TOP + 2), (150, 0), (144, DOWN)),
    lane((0, UP), (0, 0), (0, UP)),
    lane((0, UP), (0, 0), (0, DOWN)),
    // Five times the ledge's height in a step, from above; and nearly three times, first from below, then from above.
    lane((0, TOP - 400), (0, 2400), (0, UP)),
    lane((0, DOWN), (0, -1200), (0, UP)),
];

/// Steps of a swing to and fro.
const SWING: u32 = 240;
const DROP: u32 = 600;
const END: u32 = 15 * SWING;

pub(crate) const SCENE: Scene = Scene {
    name: "ledges",
    purpose: "one-way platforms hold for a minute what comes from above, also while they swing, and let through what comes from \
              below, from the side, or wants to drop",
    effects: Effects::GRAVITY.and(Effects::FRICTION).and(Effects::KINEMATIC).and(Effects::ONE_WAY).and(Effects::CCD),
    steps: END,
    defaults: usual(LANES.len() as u16),
    bodies: 1..=LANES.len() as u16,
    takes: Takes { turns: Turns::Mirror, ..Takes::PLACES },
    total: |parameters| 2 * parameters.bodies + 1,
    body: |_, number| member(number),
    script: Some(script),
    demo: Some(Demo {
        holds: &[Hold { buttons: Buttons::IDLE, steps: DROP }, Hold { buttons: Buttons::DOWN, steps: 1 }],
        promises: |parameters| {
            let lanes = || (0..parameters.bodies).zip(&LANES);
            let ends = lanes().map(|(lane, Lane { end, .. })| Promise::Place {
                body: mover(lane),
                step: END,
                at: place(lane, *end),
                tolerance: ratio(1, 2),
            });
            let before = lanes().filter(|(lane, _)| *lane == DROPS).map(|(lane, _)| Promise::Place {
                body: mover(lane),
                step: DROP,
                at: place(lane, (0, UP)),
                tolerance: ratio(1, 2),
            });
            ends.chain(before).collect()
        },
    }),
    promises: |parameters| {
        // Who is carried moves at the mean of two steps' velocities, and so lags by half a step: at 30 px/s, by 1/4 px.
        let slips = (0..parameters.bodies).filter(|lane| *lane == SWINGS);
        slips.map(|lane| Promise::Slip { bodies: [ledge(lane), mover(lane)], at_most: ratio(3, 10) }).collect()
    },
    ..COMMON
};

fn ledge(lane: u16) -> u16 {
    2 * lane + 1
}

fn mover(lane: u16) -> u16 {
    2 * lane + 2
}

/// A place from the middle of a lane.
fn place(lane: u16, (x, y): (i16, i16)) -> Vec2<I16F16> {
    at(PITCH * lane as i16 + x, y)
}

/// The floor, then ledge and mover lane by lane.
fn member(number: u16) -> BodyDef<Fixed> {
    let lane = number.saturating_sub(1) / 2;
    let rough = dull(px(1));
    if number == 0 {
        return floor(ratio(3, 10));
    }
    if number == ledge(lane) {
        let (shape, middle) = (Shape::Box { half: LEDGE }, place(lane, (0, TOP)) + vec2(px(0), LEDGE.y));
        let def = if lane == SWINGS { BodyDef::kinematic(shape, middle) } else { BodyDef::fixed(shape, middle) };
        return BodyDef { one_way: true, material: rough, ..def };
    }
    let Lane { start, velocity: (x, y), circle: round, .. } = LANES[usize::from(lane) % LANES.len()];
    let shape = if round { circle(px(HALF)) } else { square(px(HALF)) };
    BodyDef { velocity: at(x, y), ..body(shape, place(lane, start), rough) }
}

/// Swings a ledge, with less than gravity and friction stand, and lets drop who wants to.
fn script(_parameters: &Parameters, moment: Moment, control: &mut dyn Control) {
    // From 0 to 60, to -60, and back to 0.
    let speed = px(((moment.step + SWING / 4) % SWING).abs_diff(SWING / 2) as i16 - SWING as i16 / 4);
    control.set_velocity(ledge(SWINGS), vec2(speed / 2, speed / 3));
    if moment.buttons.hold(Buttons::DOWN) {
        control.drop_through(mover(DROPS));
    }
}
