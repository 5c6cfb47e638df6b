//! Bounding boxes.

use super::Outline;
use crate::scalar::{Quantity, Scalar};
use crate::vec2::{Vec2, vec2};

/// An axis-aligned box by its corners; ends held at the number format's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<S: Scalar> {
    /// Left and top.
    pub min: Vec2<S::Real>,
    /// Right and bottom.
    pub max: Vec2<S::Real>,
}

impl<S: Scalar> Bounds<S> {
    /// Around a shape.
    #[inline(never)]
    pub fn of(outline: &Outline<S>) -> Self {
        Self { min: outline.centre.saturating_sub(outline.half), max: outline.centre.saturating_add(outline.half) }
    }

    /// Around all places of a shape that makes a motion.
    #[inline(never)]
    pub fn swept(outline: &Outline<S>, motion: Vec2<S::Real>) -> Self {
        let start = Self::of(outline);
        let zero = S::Real::ZERO;
        Self {
            min: start.min.saturating_add(vec2(motion.x.lesser(zero), motion.y.lesser(zero))),
            max: start.max.saturating_add(vec2(motion.x.greater(zero), motion.y.greater(zero))),
        }
    }

    /// Wider by so much on all sides.
    #[must_use]
    #[inline(never)]
    pub fn grown(&self, margin: S::Real) -> Self {
        let margin = vec2(margin, margin);
        Self { min: self.min.saturating_sub(margin), max: self.max.saturating_add(margin) }
    }

    /// Whether two boxes overlap or touch.
    #[inline]
    pub fn touch(&self, other: &Self) -> bool {
        self.min.x <= other.max.x && self.max.x >= other.min.x && self.min.y <= other.max.y && self.max.y >= other.min.y
    }
}

/// The box that fills some bounds, which are at most twice [`EXTENT_LIMIT`](crate::scalar::EXTENT_LIMIT) wide and high.
impl<S: Scalar> From<Bounds<S>> for Outline<S> {
    fn from(bounds: Bounds<S>) -> Self {
        let half = (bounds.max - bounds.min).map(S::half);
        Self { centre: bounds.min + half, half, circle: false }
    }
}
