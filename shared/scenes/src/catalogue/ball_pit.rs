//! Balls fall into a heap in a closed room.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Level, Material, Shape, vec2};

use super::{at, wall};
use crate::parameters::{Order, Parameters};
use crate::promise::Promise;
use crate::scene::{Capacity, Promises, Scene};

const RADIUS: i16 = 6;
const WALLS: u16 = 4;
const THICK: i16 = 16;

pub(crate) const SCENE: Scene = Scene {
    name: "ball_pit",
    purpose: "balls settle into a heap in a closed room: many contacts, none may escape",
    effects: Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::FRICTION),
    steps: 600,
    defaults: Parameters { bodies: 100, seed: 1, order: Order::Forward },
    bodies: 1..=2000,
    // At level Flat balls overlap so deeply that far neighbours touch: 2.9 contacts a ball in a pit of 100, 6.6 in one of 2000.
    capacity: |parameters| Capacity { bodies: parameters.bodies + WALLS, contacts: 7 * parameters.bodies + 16 },
    body,
    promises,
};

/// Inner width and height of the room: `20 sqrt(bodies)`, to the nearest px.
fn width(parameters: &Parameters) -> i16 {
    let square = 400 * u32::from(parameters.bodies);
    let root = square.isqrt();
    (root + u32::from(square - root * root > root)) as i16
}

/// The first four are the walls: floor, ceiling, left, right, around (0, 0)..(width, width). The balls stand on a lattice of
/// 16 x 14 px, jittered by up to 1 px, row by row from the floor up.
fn body(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
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
            let columns = (width / 16) as u16;
            let (column, row) = ((ball % columns) as i16, (ball / columns) as i16);
            let jitter = |axis| I16F16::from_bits(parameters.jitter(2 * u32::from(ball) + axis));
            let position = vec2(px(8 + 16 * column) + jitter(0), px(width - 7 - 14 * row) + jitter(1));
            BodyDef { material, ..BodyDef::rigid(Shape::Circle { radius: px(RADIUS) }, position) }
        }
    }
}

/// A ball whose centre is past the middle of a wall leaves on the other side.
fn promises(parameters: &Parameters, _level: Level) -> Promises {
    let width = width(parameters);
    let tolerance = px(RADIUS + THICK / 2);
    Promises::from_iter([Promise::Within { min: at(0, 0), max: at(width, width), tolerance }])
}
