//! Tiles that go, and come back.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Vec2};

use super::{COMMON, at, body, circle, dull, square, usual};
use crate::control::Control;
use crate::parameters::{Parameters, Takes, Turns};
use crate::promise::Promise;
use crate::scene::Scene;
use crate::script::Moment;
use crate::tiles::{self, Tiles};

const COLUMNS: usize = 16;
const ROWS: usize = 9;
const SIDE: i16 = 16;
const HALF: i16 = 6;
/// Rows of the bridge and of the block.
const BRIDGE: u16 = 4;
const BLOCK: u16 = 7;

/// A bridge with coins on it, and a block on the floor.
static LEVEL: [u8; COLUMNS * ROWS] = tiles::drawn(&[
    b"#              #",
    b"#              #",
    b"#        o     #",
    b"#        o     #",
    b"################",
    b"#              #",
    b"#              #",
    b"#    ###       #",
    b"################",
]);

/// Who stands on the bridge, by column; the last falls through coins and counts them.
const COLUMNS_OF: [u16; 4] = [2, 5, 6, 9];
const COLLECTOR: u16 = 3;
/// Moves up by a px with each coin; nobody meets it.
const TALLY: u16 = 4;
const TALLY_PLACE: Vec2<I16F16> = at(128, 200);

/// The first loses the ground under its feet for good. The third falls through the bridge into a pit in the block; both close
/// again, which lifts it onto the block.
const GONE: u32 = 60;
const OPEN: u32 = 120;
const SHUT: u32 = 300;
const END: u32 = 600;

const ON_THE_BRIDGE: i16 = BRIDGE as i16 * SIDE - HALF;
const ON_THE_FLOOR: i16 = 8 * SIDE - HALF;

pub(crate) const SCENE: Scene = Scene {
    name: "crumble",
    purpose: "tiles of a bridge go and come back under what stands on it; a ball falls through coins and takes each once",
    effects: Effects::GRAVITY.and(Effects::FRICTION).and(Effects::TILES).and(Effects::SENSORS).and(Effects::EVENTS),
    steps: END,
    defaults: usual(4),
    bodies: 4..=4,
    takes: Takes { turns: Turns::Never, ..Takes::GRAVITIES },
    tiles: Some(Tiles {
        data: &LEVEL,
        width: COLUMNS as u16,
        height: ROWS as u16,
        side: SIDE as u8,
        material: dull(ratio(3, 10)),
    }),
    total: |_| TALLY + 1,
    body: |_, number| member(number),
    script: Some(script),
    promises: |_| {
        let by = |body, step, x, y| Promise::Place { body, step, at: at(x, y), tolerance: ratio(1, 2) };
        let x = |place: usize| middle(COLUMNS_OF[place]);
        [
            by(0, GONE, x(0), ON_THE_BRIDGE),
            by(0, END, x(0), ON_THE_FLOOR),
            by(1, END, x(1), ON_THE_BRIDGE),
            by(2, SHUT - 1, x(2), ON_THE_FLOOR),
            by(2, END, x(2), ON_THE_FLOOR - SIDE),
            by(COLLECTOR, END, x(3), ON_THE_BRIDGE),
            Promise::Place { body: TALLY, step: END, at: TALLY_PLACE - at(0, 2), tolerance: px(0) },
            Promise::Rest { from: END - 60, body: None, at_most: ratio(1, 10) },
        ]
        .into_iter()
        .collect()
    },
    ..COMMON
};

const fn middle(column: u16) -> i16 {
    column as i16 * SIDE + SIDE / 2
}

fn member(number: u16) -> BodyDef<Fixed> {
    if number == TALLY {
        return BodyDef { visible: false, material: dull(px(0)), ..BodyDef::fixed(circle(px(1)), TALLY_PLACE) };
    }
    let column = COLUMNS_OF[usize::from(number) % COLUMNS_OF.len()];
    let (shape, y) = if number == COLLECTOR { (circle(px(HALF)), HALF) } else { (square(px(HALF)), ON_THE_BRIDGE) };
    body(shape, at(middle(column), y), dull(ratio(3, 10)))
}

/// Takes tiles away, and gives one back.
fn script(_parameters: &Parameters, moment: Moment, control: &mut dyn Control) {
    let mut taken = 0;
    for tile in control.tiles_met(COLLECTOR) {
        if tile.flags.is_collectible() && control.set_tile(tile.column, tile.row, false) {
            taken += 1;
        }
    }
    if taken > 0 {
        let place = control.position(TALLY);
        control.set_position(TALLY, place - at(0, taken));
    }
    match moment.step {
        GONE => {
            control.set_tile(COLUMNS_OF[0], BRIDGE, false);
        }
        OPEN | SHUT => {
            for row in [BRIDGE, BLOCK] {
                control.set_tile(COLUMNS_OF[2], row, moment.step == SHUT);
            }
        }
        _ => {}
    }
}
