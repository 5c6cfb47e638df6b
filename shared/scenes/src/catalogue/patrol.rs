//! Guards that look before they go.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Shape, Vec2, vec2};

use super::{COMMON, at, body, dull, square, usual};
use crate::control::Control;
use crate::parameters::{Parameters, Takes, Turns};
use crate::promise::Promise;
use crate::scene::Scene;
use crate::script::Moment;
use crate::tiles::{self, Tiles};

const COLUMNS: usize = 30;
const ROWS: usize = 9;
const SIDE: i16 = 16;

/// Two rooms upstairs, then platforms over a corridor with a door.
static LEVEL: [u8; COLUMNS * ROWS] = tiles::drawn(&[
    b"##############################",
    b"#            #               #",
    b"##############################",
    b"#                            #",
    b"#  ########      -------     #",
    b"#                            #",
    b"#             #              #",
    b"#             .              #",
    b"##############################",
]);

const HALF: i16 = 5;
/// How far a guard looks ahead, px.
const SIGHT: i16 = 14;
/// Layer of the guards, besides that of everything.
const GUARDS: u16 = 1 << 1;

/// What a guard looks out for.
#[derive(Clone, Copy, PartialEq)]
enum Watch {
    /// What is in the way: a wall, a door, another guard.
    Wall,
    /// The end of what it stands on.
    Edge,
}

struct Guard {
    start: (i16, i16),
    speed: i16,
    watch: Watch,
    /// Where its centre stays, px.
    from: i16,
    to: i16,
}

/// Where a centre gets to: as near to a wall as a look ahead reaches, as far as an edge.
const fn beat(start: (i16, i16), speed: i16, watch: Watch, (left, right): (i16, i16)) -> Guard {
    let (from, to) = match watch {
        Watch::Wall => (left + SIGHT, right - SIGHT),
        Watch::Edge => (left, right),
    };
    Guard { start, speed, watch, from, to }
}

static BEATS: [Guard; 7] = [
    beat((40, 2 * SIDE - HALF), 50, Watch::Wall, (SIDE, 13 * SIDE)),
    // Two in one room turn where they meet.
    beat((240, 2 * SIDE - HALF), 60, Watch::Wall, (14 * SIDE, 29 * SIDE)),
    beat((400, 2 * SIDE - HALF), -35, Watch::Wall, (14 * SIDE, 29 * SIDE)),
    beat((60, 4 * SIDE - HALF), 45, Watch::Edge, (3 * SIDE, 11 * SIDE)),
    beat((300, 4 * SIDE - HALF), -70, Watch::Edge, (17 * SIDE, 24 * SIDE)),
    // Through the door and back.
    beat((40, 8 * SIDE - HALF), 40, Watch::Wall, (SIDE, 29 * SIDE)),
    beat((400, 8 * SIDE - HALF), -55, Watch::Wall, (SIDE, 29 * SIDE)),
];

const DOOR: u16 = 0;
const SHUT: Vec2<I16F16> = at(14 * SIDE + 8, 7 * SIDE + 8);
/// Speed of the door, px/s, and how far it opens, px.
const SLIDE: i16 = 60;
const OPEN: i16 = 14;
/// Where a guard opens the door, to both sides of it, px.
const NEAR: Vec2<I16F16> = at(40, 6);

pub(crate) const SCENE: Scene = Scene {
    name: "patrol",
    purpose: "guards see walls and each other by rays and the end of a platform by a point; a door opens for whoever overlaps \
              the area around it",
    effects: Effects::GRAVITY.and(Effects::KINEMATIC).and(Effects::ONE_WAY).and(Effects::TILES),
    steps: 1800,
    defaults: usual(BEATS.len() as u16),
    bodies: 1..=BEATS.len() as u16,
    takes: Takes { turns: Turns::Never, ..Takes::GRAVITIES },
    tiles: Some(Tiles {
        data: &LEVEL,
        width: COLUMNS as u16,
        height: ROWS as u16,
        side: SIDE as u8,
        material: dull(px(0)),
    }),
    total: |parameters| parameters.bodies + 1,
    body: |_, number| member(number),
    script: Some(script),
    promises: |parameters| {
        let guards = (1..=parameters.bodies).zip(&BEATS).map(|(body, guard)| {
            let y = guard.start.1;
            Promise::Stays { body, min: at(guard.from, y), max: at(guard.to, y), tolerance: px(2) }
        });
        let top = SHUT - at(0, OPEN);
        let door = Promise::Stays { body: DOOR, min: top, max: SHUT, tolerance: px(1) };
        // The last has come from the far side, at full speed.
        let through = Promise::Place {
            body: BEATS.len() as u16,
            step: 200,
            at: vec2(ratio(400 * 3 - 55 * 10, 3), px(8 * SIDE - HALF)),
            tolerance: px(1),
        };
        let through = Some(through).filter(|_| usize::from(parameters.bodies) == BEATS.len());
        guards.chain([door, Promise::Penetration { from: 1, at_most: px(0) }]).chain(through).collect()
    },
    ..COMMON
};

fn member(number: u16) -> BodyDef<Fixed> {
    let Some(place) = number.checked_sub(DOOR + 1) else {
        let door = Shape::Box { half: at(3, 8) };
        return BodyDef { material: dull(px(0)), ..BodyDef::kinematic(door, SHUT) };
    };
    let Guard { start: (x, y), speed, .. } = BEATS[usize::from(place) % BEATS.len()];
    let def = body(square(px(HALF)), at(x, y), dull(px(0)));
    // They meet what is solid and not each other: to keep apart is the rays' part.
    BodyDef { velocity: at(speed, 0), layer: GUARDS, mask: 1, ..def }
}

/// Each guard looks ahead and turns; the door looks around.
fn script(parameters: &Parameters, _moment: Moment, control: &mut dyn Control) {
    for (number, guard) in (DOOR + 1..=parameters.bodies).zip(&BEATS) {
        let way = if control.velocity(number).x < 0 { -1 } else { 1 };
        let ahead = px(way * SIGHT);
        let turns = match guard.watch {
            Watch::Wall => control.sees(number, vec2(ahead, px(0))),
            Watch::Edge => {
                let foot = control.position(number) + vec2(ahead / 8, px(HALF + 2));
                !control.is_anything_at(foot)
            }
        };
        if turns {
            control.set_velocity(number, at(-way * guard.speed.abs(), 0));
        }
    }
    let wanted = if control.is_anyone_in(SHUT, NEAR, GUARDS) { SHUT.y - px(OPEN) } else { SHUT.y };
    // Sixtieths of the way that is left, unless that is more than the door can do.
    let speed = ((wanted - control.position(DOOR).y) * 60).clamp(px(-SLIDE), px(SLIDE));
    control.set_velocity(DOOR, vec2(px(0), speed));
}
