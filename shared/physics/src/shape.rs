//! What a body looks like to others.

use crate::scalar::Scalar;
use crate::vec2::{Vec2, vec2};

/// Shape around a body's centre; shapes don't rotate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape<S: Scalar> {
    /// A disc.
    Circle {
        /// Radius, px: above 0, at most [`EXTENT_LIMIT`](crate::scalar::EXTENT_LIMIT).
        radius: S::Real,
    },
    /// An axis-aligned box.
    Box {
        /// Half width and half height, px: above 0, at most [`EXTENT_LIMIT`](crate::scalar::EXTENT_LIMIT).
        half: Vec2<S::Real>,
    },
}

impl<S: Scalar> Shape<S> {
    /// Half width and half height of the bounding box, px.
    pub fn half_extents(&self) -> Vec2<S::Real> {
        match *self {
            Self::Circle { radius } => vec2(radius, radius),
            Self::Box { half } => half,
        }
    }
}
