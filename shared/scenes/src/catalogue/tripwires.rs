//! Sensors, and what is told of them.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Phase, Shape, Vec2};

use super::{COMMON, at, body, circle, dull, floor, usual};
use crate::control::Control;
use crate::parameters::{Parameters, Takes};
use crate::promise::Promise;
use crate::scene::Scene;
use crate::script::Moment;

const RADIUS: i16 = 4;
/// Steps from one drop to the next.
const ROUND: u32 = 150;
const ROUNDS: u32 = 8;
const END: u32 = ROUND * ROUNDS;

/// In the air a box and a circle, on the floor a plate: there balls lie until they are taken away.
const SENSORS: [(Shape<Fixed>, Vec2<I16F16>); 3] = [
    (Shape::Box { half: at(50, 6) }, at(30, -150)),
    (Shape::Circle { radius: px(30) }, at(30, -90)),
    (Shape::Box { half: at(50, 5) }, at(30, -5)),
];
const FIRST_SENSOR: u16 = 1;
/// For each sensor a flag that nobody meets: it moves by a px to the right with each beginning, and down with each end.
const FIRST_FLAG: u16 = FIRST_SENSOR + SENSORS.len() as u16;
const FIRST_BALL: u16 = FIRST_FLAG + SENSORS.len() as u16;

pub(crate) const SCENE: Scene = Scene {
    name: "tripwires",
    purpose: "balls fall through sensors and are dropped again: each is told of once when it comes and once when it goes, also if \
              it is taken away",
    effects: Effects::GRAVITY.and(Effects::FRICTION).and(Effects::SENSORS).and(Effects::EVENTS),
    steps: END,
    defaults: usual(4),
    bodies: 1..=4,
    takes: Takes::PLACES,
    total: |parameters| FIRST_BALL + parameters.bodies,
    body: |_, number| member(number),
    script: Some(script),
    promises: |parameters| {
        let told = (ROUNDS * u32::from(parameters.bodies)) as i16;
        let flags = (0..).zip(&SENSORS).map(|(sensor, _)| Promise::Place {
            body: FIRST_FLAG + sensor,
            step: END,
            at: flag(sensor) + at(told, told),
            tolerance: px(0),
        });
        flags.collect()
    },
    ..COMMON
};

fn flag(sensor: u16) -> Vec2<I16F16> {
    at(100, -40 * sensor as i16)
}

fn member(number: u16) -> BodyDef<Fixed> {
    if let Some(ball) = number.checked_sub(FIRST_BALL) {
        return body(circle(px(RADIUS)), at(20 * ball as i16, -200), dull(ratio(3, 10)));
    }
    let def = if let Some(sensor) = number.checked_sub(FIRST_FLAG) {
        BodyDef { visible: false, ..BodyDef::fixed(circle(px(1)), flag(sensor)) }
    } else if let Some(sensor) = number.checked_sub(FIRST_SENSOR) {
        let (shape, position) = SENSORS[usize::from(sensor)];
        BodyDef { sensor: true, ..BodyDef::fixed(shape, position) }
    } else {
        floor(ratio(3, 10))
    };
    BodyDef { material: dull(ratio(3, 10)), ..def }
}

/// Moves the flags by what the last step told; drops all balls again.
fn script(parameters: &Parameters, moment: Moment, control: &mut dyn Control) {
    for sensor in 0..SENSORS.len() as u16 {
        let count = |phase| control.count_events(FIRST_SENSOR + sensor, phase) as i16;
        let (came, went) = (count(Phase::Begin), count(Phase::End));
        let place = control.position(FIRST_FLAG + sensor);
        if (came, went) != (0, 0) {
            control.set_position(FIRST_FLAG + sensor, place + at(came, went));
        }
    }
    // What is taken away before the last step is told of by it, and moves the flags no more.
    if moment.step.is_multiple_of(ROUND) || moment.step + 2 == END {
        for ball in 0..parameters.bodies {
            control.replace(FIRST_BALL + ball);
        }
    }
}
