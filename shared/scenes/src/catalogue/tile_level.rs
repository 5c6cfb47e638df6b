//! A level of tiles: balls bounce between platforms; bodies slide along its sides.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::tiles::TileFlags;
use flat_physics::{BodyDef, Effects, Fixed, vec2};

use super::{COMMON, at, body, bouncy, circle, dull, room, square, usual};
use crate::control::Control;
use crate::parameters::{Parameters, Takes, Turns};
use crate::promise::Promise;
use crate::scene::{Promises, Scene};
use crate::script::Moment;
use crate::tiles::Tiles;

/// Side of the level's tiles, px.
const SIDE: i16 = 16;
const COLUMNS: usize = 64;
const ROWS: usize = 32;
const RADIUS: i16 = 6;

pub(crate) const TILE_LEVEL: Scene = Scene {
    name: "tile_level",
    purpose: "balls bounce through a level of platforms: none leaves it",
    effects: Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::TILES),
    defaults: usual(20),
    bodies: 1..=130,
    takes: Takes { turns: Turns::Never, ..Takes::GRAVITIES },
    tiles: Some(Tiles {
        data: &LEVEL,
        width: COLUMNS as u16,
        height: ROWS as u16,
        side: SIDE as u8,
        material: bouncy(ratio(4, 5)),
    }),
    total: |parameters| parameters.bodies,
    body: ball,
    promises: |_| {
        Promises::from_iter([Promise::Within {
            min: at(SIDE, SIDE),
            max: at(63 * SIDE, 27 * SIDE),
            tolerance: px(RADIUS),
        }])
    },
    ..COMMON
};

static LEVEL: [u8; COLUMNS * ROWS] = level();

/// Solid: the border, rows 27 to 31, and in rows 4, 8, ... 24 the columns 3 to 8 of every twelve.
const fn level() -> [u8; COLUMNS * ROWS] {
    let mut tiles = room(COLUMNS);
    let mut place = 0;
    while place < tiles.len() {
        let (column, row) = (place % COLUMNS, place / COLUMNS);
        let platform = row % 4 == 0 && column % 12 >= 3 && column % 12 <= 8;
        if row >= 27 || platform {
            tiles[place] = TileFlags::SOLID.bits();
        }
        place += 1;
    }
    tiles
}

/// To the right and to the left in turn, up and down by pairs.
fn ball(_parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    let (column, row) = ((number % 26) as i16, (number / 26) as i16);
    let speed = |size: i16, turn: u16| if turn.is_multiple_of(2) { size } else { -size };
    let velocity = at(speed(80, number), speed(40, number / 2));
    BodyDef { velocity, ..body(circle(px(RADIUS)), at(40 + 36 * column, 40 + 64 * row), bouncy(ratio(4, 5))) }
}

/// Side of the room's tiles, px.
const SMALL: i16 = 8;
/// Where the inner sides of the room's walls lie, px.
const NEAR: i16 = SMALL;
const RIGHT: i16 = SMALL * (COLUMNS as i16 - 1);
const BOTTOM: i16 = SMALL * (ROWS as i16 - 1);
const HALF: i16 = 5;

pub(crate) const SEAMS: Scene = Scene {
    name: "seams",
    purpose: "boxes and circles slide over the seams of floors, walls and ceilings, at 1 to 500 px/s: they feel none",
    effects: Effects::GRAVITY.and(Effects::TILES),
    steps: 3600,
    defaults: usual(64),
    bodies: 1..=64,
    takes: Takes { turns: Turns::Never, ..Takes::GRAVITIES },
    tiles: Some(Tiles {
        data: &ROOM,
        width: COLUMNS as u16,
        height: ROWS as u16,
        side: SMALL as u8,
        material: dull(ratio(0, 1)),
    }),
    body: |parameters, number| sliding(parameters, number, 0),
    script: Some(back_to_the_start),
    promises: |_| Promises::from_iter([Promise::Steady]),
    ..TILE_LEVEL
};

static ROOM: [u8; COLUMNS * ROWS] = room(COLUMNS);

/// The side that a body slides along. Gravity presses against the first two.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Floor,
    Ceiling,
    Left,
    Right,
}

impl Side {
    fn of(number: u16) -> Self {
        [Self::Floor, Self::Ceiling, Self::Left, Self::Right][usize::from(number % 4)]
    }

    fn lies(self) -> bool {
        matches!(self, Self::Floor | Self::Ceiling)
    }

    /// Length of a slide, px: 50 seams, or 22 upright ones.
    fn length(self) -> u32 {
        if self.lies() { 400 } else { 176 }
    }
}

/// Speed of a body, px/s: eight of them, each to both sides.
fn speed(number: u16) -> i16 {
    let sizes = [1, 3, 10, 33, 100, 200, 333, 500];
    let size = sizes[usize::from(number / 4 % 8)];
    if (number / 32).is_multiple_of(2) { size } else { -size }
}

/// Side by side in turn; each pass begins at another part of a px.
fn sliding(parameters: &Parameters, number: u16, pass: u32) -> BodyDef<Fixed> {
    let phase = I16F16::from_bits(parameters.jitter(pass * 64 + u32::from(number)));
    let (side, speed) = (Side::of(number), speed(number));
    let end = if side.lies() { RIGHT } else { BOTTOM };
    let along = phase + px(if speed > 0 { NEAR + 20 } else { end - 20 });
    let across = px(match side {
        Side::Floor => BOTTOM - HALF,
        Side::Right => RIGHT - HALF,
        Side::Ceiling | Side::Left => NEAR + HALF,
    });
    let (position, velocity) =
        if side.lies() { (vec2(along, across), at(speed, 0)) } else { (vec2(across, along), at(0, speed)) };
    let gravity_scale = px(match side {
        Side::Floor => 1,
        Side::Ceiling => -1,
        Side::Left | Side::Right => 0,
    });
    let shape = if (number / 4).is_multiple_of(2) { square(px(HALF)) } else { circle(px(HALF)) };
    // They meet the tiles and not each other.
    let (layer, mask) = (1 << 1, 1);
    BodyDef { velocity, gravity_scale, layer, mask, ..body(shape, position, dull(px(0))) }
}

/// Puts whoever has slid far enough back to where it came from.
fn back_to_the_start(parameters: &Parameters, cue: Moment, control: &mut dyn Control) {
    for number in 0..parameters.bodies {
        let steps = 60 * Side::of(number).length() / u32::from(speed(number).unsigned_abs());
        if cue.step > 1 && cue.step % steps == 1 {
            control.set_position(number, sliding(parameters, number, cue.step / steps).position);
        }
    }
}
