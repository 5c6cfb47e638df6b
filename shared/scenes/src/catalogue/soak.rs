//! A bit of everything, for as long as you like.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Material, Shape, vec2};

use super::{COMMON, at, body, circle, square, usual, wall};
use crate::control::Control;
use crate::parameters::{Parameters, Takes, Turns};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};
use crate::script::Moment;

const HALF: i16 = 6;
/// Inner size of the room, px.
const WIDE: i16 = 240;
const HIGH: i16 = 200;
/// Bodies that don't move by themselves: walls, platforms, the sensor.
const FIXTURES: u16 = 7;
const PLATFORM: u16 = 6;
/// Steps that the platform takes from one end to the other.
const PASS: u32 = 120;

pub(crate) const SCENE: Scene = Scene {
    name: "soak",
    purpose: "balls and boxes in a room with a moving platform, a one-way platform and a sensor; one is dropped anew now and then",
    effects: Effects::GRAVITY
        .and(Effects::BOUNCE)
        .and(Effects::FRICTION)
        .and(Effects::KINEMATIC)
        .and(Effects::SENSORS)
        .and(Effects::ONE_WAY)
        .and(Effects::EVENTS),
    steps: 3600,
    defaults: usual(24),
    bodies: 1..=30,
    // A one-way platform knows up from down.
    takes: Takes { turns: Turns::Mirror, ..Takes::GRAVITIES },
    total: |parameters| parameters.bodies + FIXTURES,
    body: member,
    script: Some(script),
    promises: |_| {
        Promises::from_iter([
            Promise::Within { min: at(0, -HIGH), max: at(WIDE, 0), tolerance: px(2 * HALF) },
            // Whoever lands at full speed may sink in for a moment, but not half way.
            Promise::Penetration { from: 120, at_most: px(HALF) },
            Promise::Rest { from: 1, body: None, at_most: px(500) },
        ])
    },
    ..COMMON
};

/// First the fixtures: floor, ceiling, left, right, one-way platform, sensor, moving platform; then what falls, in rows.
fn member(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let material = Material { restitution: ratio(1, 5), friction: ratio(3, 10), ..Material::DEFAULT };
    let slab = |half_width| Shape::Box { half: vec2(px(half_width), px(4)) };
    let fixture = match number {
        0 => wall((-16, 0), (WIDE + 16, 16), material),
        1 => wall((-16, -HIGH - 16), (WIDE + 16, -HIGH), material),
        2 => wall((-16, -HIGH), (0, 0), material),
        3 => wall((WIDE, -HIGH), (WIDE + 16, 0), material),
        4 => BodyDef { one_way: true, ..BodyDef::fixed(slab(40), at(180, -100)) },
        5 => BodyDef { sensor: true, ..BodyDef::fixed(square(px(20)), at(40, -20)) },
        PLATFORM => BodyDef { velocity: at(30, 0), ..BodyDef::kinematic(slab(20), at(40, -60)) },
        _ => {
            let (row, column) = ((number - FIXTURES) / 10, (number - FIXTURES) % 10);
            let jitter = I16F16::from_bits(parameters.jitter(number.into()));
            let position = at(20 + 22 * column as i16, 10 - HIGH + 16 * row as i16) + vec2(jitter, px(0));
            let shape = if number.is_multiple_of(3) { square(px(HALF)) } else { circle(px(HALF)) };
            BodyDef { mass: px(1 + (number % 4) as i16), ..body(shape, position, material) }
        }
    };
    BodyDef { material, ..fixture }
}

/// The platform goes to and fro; every half second one body is dropped anew.
fn script(parameters: &Parameters, cue: Moment, control: &mut dyn Control) {
    if cue.step.is_multiple_of(PASS) {
        let leftwards = (cue.step / PASS) % 2 == 1;
        control.set_velocity(PLATFORM, at(if leftwards { -30 } else { 30 }, 0));
    }
    if cue.step.is_multiple_of(30) {
        control.replace(FIXTURES + (cue.step / 30 % u32::from(parameters.bodies)) as u16);
    }
}
