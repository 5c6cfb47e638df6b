//! Shots at walls of tiles that are a px thick.

use fixed::types::I16F16;
use flat_physics::scalar::px;
use flat_physics::{BodyDef, Effects, Fixed, vec2};

use super::{COMMON, at, body, bouncy, circle, room, square, usual};
use crate::control::Control;
use crate::parameters::{Parameters, Takes, Turns};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};
use crate::script::Moment;
use crate::tiles::Tiles;

const COLUMNS: usize = 64;
const ROWS: usize = 32;
const HALF: i16 = 2;
/// Steps between volleys.
const VOLLEY: u32 = 8;

pub(crate) const SCENE: Scene = Scene {
    name: "tile_shots",
    purpose: "circles and boxes are shot at tiles of 1 px on all four sides, as fast as numbers go: none gets through",
    effects: Effects::BOUNCE.and(Effects::CCD).and(Effects::TILES),
    // A step in which everybody hits two walls is a dear one, above all where floats are soft.
    steps: 240,
    defaults: usual(24),
    bodies: 1..=64,
    gravity: 0,
    takes: Takes { turns: Turns::Never, ..Takes::PLACES },
    tiles: Some(Tiles { data: &ROOM, width: COLUMNS as u16, height: ROWS as u16, side: 1, material: bouncy(px(1)) }),
    total: |parameters| parameters.bodies,
    // In a corner a shot meets tiles of both walls.
    contacts: |parameters, _| 8 * parameters.bodies + 16,
    body: |parameters, number| shot(parameters, number, 0),
    script: Some(reload),
    promises: |_| {
        Promises::from_iter([Promise::Within {
            min: at(1, 1),
            max: at(COLUMNS as i16 - 1, ROWS as i16 - 1),
            // Whoever is further out has its centre past the tile.
            tolerance: px(HALF + 1),
        }])
    },
    ..COMMON
};

static ROOM: [u8; COLUMNS * ROWS] = room(COLUMNS);

/// From anywhere near the middle of the room, to anywhere.
fn shot(parameters: &Parameters, number: u16, volley: u32) -> BodyDef<Fixed> {
    let random = |use_of: u32| I16F16::from_bits(parameters.jitter((volley * 64 + u32::from(number)) * 4 + use_of));
    let position = vec2(px(32) + random(0) * 25, px(16) + random(1) * 10);
    // Up to 7600 px/s along each axis: 126 px a step, twice through the room.
    let velocity = vec2(random(2) * 7600, random(3) * 7600);
    let shape = if number.is_multiple_of(3) { square(px(HALF)) } else { circle(px(HALF)) };
    // They meet the tiles and not each other.
    let (layer, mask) = (1 << 1, 1);
    BodyDef { velocity, layer, mask, ..body(shape, position, bouncy(px(1))) }
}

/// Puts everything back and shoots again.
fn reload(parameters: &Parameters, moment: Moment, control: &mut dyn Control) {
    if moment.step % VOLLEY != 1 {
        return;
    }
    for number in 0..parameters.bodies {
        let def = shot(parameters, number, moment.step / VOLLEY);
        control.set_position(number, def.position);
        control.set_velocity(number, def.velocity);
    }
}
