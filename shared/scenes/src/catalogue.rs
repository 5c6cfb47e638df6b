//! One scene a file.

pub(crate) mod ball_pit;
pub(crate) mod bounce;
pub(crate) mod crate_columns;
pub(crate) mod drop;

use fixed::types::I16F16;
use flat_physics::scalar::px;
use flat_physics::{BodyDef, Fixed, Material, Shape, Vec2, vec2};

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

/// Neither bounces nor slides freely.
const fn dull(friction: I16F16) -> Material<Fixed> {
    Material { bounce: false, friction, ..Material::DEFAULT }
}
