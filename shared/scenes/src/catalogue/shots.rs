//! Shots at everything that can be hit.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Shape, vec2};

use super::{COMMON, at, body, bouncy, circle, square, usual};
use crate::control::Control;
use crate::parameters::{Parameters, Takes};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};
use crate::script::Moment;

/// Steps between volleys: enough for the slowest shot to arrive.
const VOLLEY: u32 = 16;
/// Distance between lanes, px.
const PITCH: i16 = 40;

pub(crate) const SCENE: Scene = Scene {
    name: "shots",
    purpose: "circles and boxes are shot at walls of 1 px and at what moves, as fast as numbers go: none gets through",
    effects: Effects::BOUNCE.and(Effects::CCD).and(Effects::KINEMATIC),
    steps: 640,
    // 12 800 shots.
    long: Some(6400),
    defaults: usual(64),
    bodies: 2..=64,
    gravity: 0,
    takes: Takes::PLACES,
    total: |parameters| 2 * (parameters.bodies / 2),
    body: |parameters, number| aimed(parameters, number, 0),
    script: Some(reload),
    promises: |_| Promises::from_iter([Promise::Sides]),
    ..COMMON
};

/// Even numbers are shots, each followed by its target, lane by lane from the top.
fn aimed(parameters: &Parameters, number: u16, volley: u32) -> BodyDef<Fixed> {
    let lane = number / 2;
    let y = px(PITCH * lane as i16);
    let random = |use_of: u32| parameters.jitter((volley * 64 + u32::from(lane)) * 4 + use_of);
    if number.is_multiple_of(2) {
        // 13 to 255 px away, up to 3 px off the middle; circles are hit in the middle, or the shot would fly off past them.
        let x = px(-134) + I16F16::from_bits(random(0) * 121);
        let off = if lane % 4 == 2 { 0 } else { random(1) * 3 };
        let y = y + I16F16::from_bits(off);
        // 1000 to 7300 px/s: whoever meets a wall that comes at 120 px/s leaves 240 px/s faster, and 7620 is the most.
        let speed = px(4150) + I16F16::from_bits(random(2)) * 3150;
        let shape = if lane.is_multiple_of(3) { square(px(3)) } else { circle(px(2)) };
        return BodyDef { velocity: vec2(speed, px(0)), ..body(shape, vec2(x, y), bouncy(px(1))) };
    }
    let thin = Shape::Box { half: vec2(ratio(1, 2), px(16)) };
    let target = match lane % 4 {
        0 => BodyDef::fixed(thin, vec2(px(0), y)),
        1 => BodyDef { velocity: at(-120, 0), ..BodyDef::kinematic(thin, vec2(px(0), y)) },
        2 => body(circle(px(8)), vec2(px(0), y), bouncy(px(1))),
        _ => BodyDef { mass: px(100), ..body(square(px(8)), vec2(px(0), y), bouncy(px(1))) },
    };
    BodyDef { material: bouncy(px(1)), ..target }
}

/// Puts everything back and shoots again.
fn reload(parameters: &Parameters, cue: Moment, control: &mut dyn Control) {
    if cue.step % VOLLEY != 1 {
        return;
    }
    for number in 0..(SCENE.total)(parameters) {
        let def = aimed(parameters, number, cue.step / VOLLEY);
        // Nothing moves a wall.
        if number % 8 != 1 {
            control.set_position(number, def.position);
            control.set_velocity(number, def.velocity);
        }
    }
}
