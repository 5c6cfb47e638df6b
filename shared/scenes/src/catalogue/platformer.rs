//! A level to play through.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::tiles::TileFlags;
use flat_physics::{BodyDef, Effects, Fixed, Shape, Vec2, vec2};

use super::{COMMON, at, circle, dull, square, usual};
use crate::buttons::{Buttons, Hold};
use crate::control::{Control, Noticed};
use crate::parameters::{Parameters, Takes, Turns};
use crate::promise::Promise;
use crate::scene::{Demo, Promises, Scene};
use crate::script::Moment;
use crate::tiles::{self, Tiles};

const COLUMNS: usize = 40;
const ROWS: usize = 13;
const SIDE: i16 = 16;
/// Top of the ground, px.
const GROUND: i16 = 10 * SIDE;

/// The ground has a pit, and ends at spikes below the upper floor.
static LEVEL: [u8; COLUMNS * ROWS] = tiles::drawn(&[
    b"########################################",
    b"#                                      #",
    b"#                                      #",
    b"#                                      #",
    b"#     o                           o    #",
    b"#    ---                         ####  #",
    b"#                                      #",
    b"#                                      #",
    b"#    ----                              #",
    b"#   o o o      o                       #",
    b"########################  #########    #",
    b"#######################   #########^^^^#",
    b"########################################",
]);
/// Of tiles and of bodies.
const COINS: i16 = 8;

const FRICTION: I16F16 = ratio(3, 10);

const HERO: u16 = 0;
const LIFT: u16 = 1;
const CRATE: u16 = 2;
const FLAG: u16 = 3;
/// A coin over the lift's upper end, one in the pit.
const FIRST_COIN: u16 = 4;
const COIN_PLACES: [Vec2<I16F16>; 2] = [at(470, 62), at(392, 182)];

const START: Vec2<I16F16> = at(30, GROUND - 7);
const FLAG_DOWN: Vec2<I16F16> = at(600, 72);
/// How far the flag rises for each coin, px.
const HOIST: i16 = 6;
/// Half height of the lift, px.
const PLANK: i16 = 3;
/// Steps that the lift takes from one end to the other.
const PASS: u32 = 120;

pub(crate) const SCENE: Scene = Scene {
    name: "platformer",
    purpose: "a player runs, jumps, drops through ledges, rides a lift, pushes a crate and minds the spikes; a flag rises with \
              each coin",
    effects: Effects::GRAVITY
        .and(Effects::FRICTION)
        .and(Effects::SENSORS)
        .and(Effects::ONE_WAY)
        .and(Effects::KINEMATIC)
        .and(Effects::TILES),
    steps: END,
    defaults: usual(1),
    gravity: 600,
    takes: Takes { turns: Turns::Never, ..Takes::PLACES },
    demo: Some(Demo {
        holds: DEMO,
        promises: |_| {
            let by = |body, step, at| Promise::Place { body, step, at, tolerance: px(1) };
            Promises::from_iter([
                by(CRATE, 300, at(410, 12 * SIDE - 6)),
                by(HERO, 576, vec2(ratio(943, 2), ratio(251, 3))),
                by(HERO, 664, vec2(ratio(1147, 2), px(5 * SIDE - 7))),
                by(HERO, 714, START),
                by(HERO, 890, at(111, 5 * SIDE - 7)),
                by(HERO, END, at(111, GROUND - 7)),
                by(FLAG, END, FLAG_DOWN + at(0, -HOIST * COINS)),
            ])
        },
    }),
    tiles: Some(Tiles {
        data: &LEVEL,
        width: COLUMNS as u16,
        height: ROWS as u16,
        side: SIDE as u8,
        material: dull(FRICTION),
    }),
    total: |_| FIRST_COIN + COIN_PLACES.len() as u16,
    body: |_, number| member(number),
    script: Some(play),
    promises: |_| {
        Promises::from_iter([
            Promise::OutOfTiles { body: HERO, at_most: ratio(1, 100) },
            Promise::OutOfTiles { body: CRATE, at_most: ratio(1, 10) },
            Promise::Penetration { from: 1, at_most: ratio(1, 10) },
        ])
    },
    ..COMMON
};

const fn hold(buttons: Buttons, steps: u32) -> Hold {
    Hold { buttons, steps }
}

/// All coins, by way of the pit, the lift and the spikes, and back to the ground.
static DEMO: &[Hold] = &[
    // Pushes the crate into the pit and follows it, for the coin.
    hold(Buttons::RIGHT, 255),
    hold(Buttons::IDLE, 10),
    hold(Buttons::LEFT, 15),
    hold(Buttons::IDLE, 10),
    hold(Buttons::JUMP, 1),
    hold(Buttons::IDLE, 6),
    hold(Buttons::RIGHT, 55),
    // Waits for the lift, and rides it.
    hold(Buttons::IDLE, 118),
    hold(Buttons::JUMP, 1),
    hold(Buttons::IDLE, 125),
    // Upstairs, and over the edge onto the spikes: back to the start.
    hold(Buttons::JUMP.and(Buttons::RIGHT), 1),
    hold(Buttons::RIGHT, 124),
    hold(Buttons::IDLE, 5),
    // Up through both ledges, and down again.
    hold(Buttons::RIGHT, 47),
    hold(Buttons::JUMP, 1),
    hold(Buttons::IDLE, 59),
    hold(Buttons::JUMP, 1),
    hold(Buttons::IDLE, 59),
    hold(Buttons::DOWN, 12),
    hold(Buttons::IDLE, 40),
    hold(Buttons::DOWN, 12),
];
const END: u32 = 1000;

fn member(number: u16) -> BodyDef<Fixed> {
    let sized = |x, y| Shape::Box { half: at(x, y) };
    let def = match number {
        HERO => BodyDef::kinematic(sized(5, 7), START),
        LIFT => BodyDef { one_way: true, ..BodyDef::kinematic(sized(20, PLANK), at(470, GROUND - PLANK)) },
        CRATE => BodyDef::rigid(square(px(6)), at(200, GROUND - 6)),
        FLAG => BodyDef { visible: false, ..BodyDef::fixed(sized(6, 4), FLAG_DOWN) },
        _ => {
            let place = COIN_PLACES[usize::from(number - FIRST_COIN) % COIN_PLACES.len()];
            BodyDef { sensor: true, ..BodyDef::fixed(circle(px(4)), place) }
        }
    };
    BodyDef { material: dull(FRICTION), ..def }
}

/// The player's turn, then the lift's.
fn play(_parameters: &Parameters, moment: Moment, control: &mut dyn Control) {
    /// Speeds, px/s; gravity in a step.
    const RUN: i16 = 90;
    const JUMP: i16 = -280;
    const FALL: i16 = 10;
    const RISE: i16 = 40;

    let Moment { step, buttons } = moment;
    let walker = control.walker();
    let along = i16::from(buttons.hold(Buttons::RIGHT)) - i16::from(buttons.hold(Buttons::LEFT));
    let upwards = if buttons.hold(Buttons::JUMP) && walker.stands { px(JUMP) } else { walker.velocity.y };
    let noticed = control.walk(HERO, vec2(px(RUN * along), upwards + px(FALL)), buttons.hold(Buttons::DOWN));
    for sensor in noticed {
        match sensor {
            Noticed::Body(coin) => {
                control.set_visible(coin, false);
                collect(control);
            }
            Noticed::Tile(tile) if tile.flags.is_collectible() => {
                if control.set_tile(tile.column, tile.row, false) {
                    collect(control);
                }
            }
            Noticed::Tile(tile) if tile.flags.contains(TileFlags::DAMAGE) => control.carry_off(HERO, START),
            Noticed::Tile(_) => {}
        }
    }
    let up = (step / PASS).is_multiple_of(2);
    control.set_velocity(LIFT, at(0, if up { -RISE } else { RISE }));
}

/// Hoists the flag.
fn collect(control: &mut dyn Control) {
    let place = control.position(FLAG);
    control.set_position(FLAG, place - at(0, HOIST));
}
