//! Where a ray meets a shape.

use super::{Hit, Outline, cast};
use crate::scalar::Scalar;
use crate::vec2::Vec2;

/// Casts a ray from `origin` to `origin + way`, |component| <= 32767 px. A ray that starts inside meets the shape at once, with
/// a [`depth`](Hit::depth) above 0; one that starts on the edge and leads away doesn't.
pub fn ray<S: Scalar>(origin: Vec2<S::Real>, way: Vec2<S::Real>, target: &Outline<S>) -> Option<Hit<S>> {
    cast(&Outline::point(origin), way, target)
}
