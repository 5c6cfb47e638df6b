//! Balls of different restitution bounce side by side.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed, Level, Material, Shape};

use super::{at, wall};
use crate::parameters::{Order, Parameters};
use crate::promise::Promise;
use crate::scene::{Capacity, Promises, Scene};

const PITCH: i16 = 32;
const RADIUS: i16 = 6;
const HEIGHT: i16 = 100;

pub(crate) const SCENE: Scene = Scene {
    name: "bounce",
    purpose: "balls of restitution 1, .75, .5, .25, 0 drop 100 px and bounce",
    effects: Effects::GRAVITY.and(Effects::BOUNCE),
    steps: 600,
    defaults: Parameters { bodies: 5, seed: 1, order: Order::Forward },
    bodies: 1..=200,
    capacity: |parameters| Capacity { bodies: parameters.bodies + 1, contacts: 2 * parameters.bodies + 8 },
    body,
    promises,
};

/// Number 0 is the floor, its top at y = 0.
fn body(parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
    if number == 0 {
        return wall((-PITCH, 0), (PITCH * parameters.bodies as i16, 16), Material::DEFAULT);
    }
    let mut position = at(PITCH * (number as i16 - 1), -HEIGHT - RADIUS);
    position.x += I16F16::from_bits(parameters.jitter(u32::from(number)));
    let material = Material { restitution: restitution(number), ..Material::DEFAULT };
    BodyDef { material, ..BodyDef::rigid(Shape::Circle { radius: px(RADIUS) }, position) }
}

fn restitution(number: u16) -> I16F16 {
    px(1) - ratio((number as i16 - 1) % 5, 4)
}

/// After the first bounce a ball rises to `restitution^2` of the height it fell from.
fn promises(parameters: &Parameters, _level: Level) -> Promises {
    let right = PITCH * parameters.bodies as i16;
    let mut promises = Promises::from_iter([Promise::Within {
        min: at(-PITCH, -HEIGHT - 2 * RADIUS - 4),
        max: at(right, 0),
        tolerance: ratio(7, 2),
    }]);
    for number in 1..=parameters.bodies.min(4) {
        let e = restitution(number);
        let y = -px(RADIUS) - px(HEIGHT) * e * e;
        // There is room for one promise a restitution.
        let _ = promises.push(Promise::Apex { body: number, bounce: 1, y, tolerance: px(4) });
    }
    promises
}
