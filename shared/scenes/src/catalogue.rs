//! One scene, or one family of scenes, a file.

pub(crate) mod anvil_drop;
pub(crate) mod ball_pit;
pub(crate) mod beside;
pub(crate) mod bounce;
pub(crate) mod churn;
pub(crate) mod cradle;
pub(crate) mod crate_columns;
pub(crate) mod crumble;
pub(crate) mod drift;
pub(crate) mod drop;
pub(crate) mod floating;
pub(crate) mod heap;
pub(crate) mod kinematic;
pub(crate) mod ledges;
pub(crate) mod overlap;
pub(crate) mod patrol;
pub(crate) mod platformer;
pub(crate) mod projectile;
pub(crate) mod pyramid;
pub(crate) mod shots;
pub(crate) mod slide;
pub(crate) mod soak;
pub(crate) mod stack;
pub(crate) mod terminal;
pub(crate) mod tight;
pub(crate) mod tile_level;
pub(crate) mod tile_shots;
pub(crate) mod tripwires;
pub(crate) mod vice;

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::tiles::TileFlags;
use flat_physics::{BodyDef, Effects, Fixed, Level, Material, Shape, Vec2, vec2};

use crate::parameters::{Order, Parameters, Takes, Variant};
use crate::promise::Shortfall;
use crate::scene::{Promises, Scene};

/// What most scenes have in common.
const COMMON: Scene = Scene {
    name: "",
    purpose: "",
    effects: Effects::GRAVITY,
    steps: 600,
    long: None,
    defaults: usual(1),
    bodies: 1..=1,
    sizes: &[],
    gravity: 200,
    takes: Takes::GRAVITIES,
    demo: None,
    tiles: None,
    total: |parameters| parameters.bodies + 1,
    contacts: |parameters, level| match level {
        // Stacks sink in until far neighbours touch.
        Level::Flat => 17 * parameters.bodies + 8,
        Level::Grounded | Level::Exact => 4 * parameters.bodies + 8,
    },
    body: |_, _| floor(px(0)),
    script: None,
    promises: |_| Promises::new(),
    shortfalls: &[],
};

/// So many bodies, and nothing unusual.
const fn usual(bodies: u16) -> Parameters {
    Parameters { bodies, seed: 1, order: Order::Forward, variant: Variant::NONE }
}

/// A shortfall, in thousandths of the check's unit.
const fn short(check: &'static str, thousandths: i32) -> Shortfall {
    Shortfall { check, figure: I16F16::from_bits(((thousandths as i64 * 65_536 + 999) / 1000) as i32) }
}

/// A point in whole px.
const fn at(x: i16, y: i16) -> Vec2<I16F16> {
    vec2(px(x), px(y))
}

/// A static box that spans from one corner to the other, px.
fn wall(min: (i16, i16), max: (i16, i16), material: Material<Fixed>) -> BodyDef<Fixed> {
    let middle = |a: i16, b: i16| (px(a) + px(b)) / 2;
    let half = vec2((px(max.0) - px(min.0)) / 2, (px(max.1) - px(min.1)) / 2);
    let position = vec2(middle(min.0, max.0), middle(min.1, max.1));
    BodyDef { material, ..BodyDef::fixed(Shape::Box { half }, position) }
}

/// A floor 4000 px wide, its top at y = 0, that doesn't bounce.
fn floor(friction: I16F16) -> BodyDef<Fixed> {
    wall((-2000, 0), (2000, 32), dull(friction))
}

/// A rigid body at rest.
fn body(shape: Shape<Fixed>, position: Vec2<I16F16>, material: Material<Fixed>) -> BodyDef<Fixed> {
    BodyDef { material, ..BodyDef::rigid(shape, position) }
}

/// A square by half its side, px.
const fn square(half: I16F16) -> Shape<Fixed> {
    Shape::Box { half: vec2(half, half) }
}

/// A circle by its radius, px.
const fn circle(radius: I16F16) -> Shape<Fixed> {
    Shape::Circle { radius }
}

/// Neither bounces nor slides freely.
const fn dull(friction: I16F16) -> Material<Fixed> {
    Material { bounce: false, friction, ..Material::DEFAULT }
}

/// Bounces and slides freely.
const fn bouncy(restitution: I16F16) -> Material<Fixed> {
    Material { restitution, ..Material::DEFAULT }
}

/// Deepest overlap in a stack that stands, px.
const STANDING: I16F16 = ratio(1, 50);

/// Steps after which something that falls this far, px, has landed, and a second more.
fn settled(parameters: &Parameters, scene_gravity: i16, fall: u32) -> u32 {
    // t = sqrt(2 h / g)
    let gravity = parameters.variant.gravity.unwrap_or(scene_gravity).unsigned_abs().max(1);
    60 + (7200 * fall / u32::from(gravity)).isqrt()
}

/// Tiles of a room, row by row: its border is solid.
const fn room<const TILES: usize>(columns: usize) -> [u8; TILES] {
    let mut tiles = [0; TILES];
    let mut place = 0;
    while place < TILES {
        let (column, row) = (place % columns, place / columns);
        if column == 0 || column == columns - 1 || row == 0 || row == TILES / columns - 1 {
            tiles[place] = TileFlags::SOLID.bits();
        }
        place += 1;
    }
    tiles
}
