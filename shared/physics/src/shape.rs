//! What a body looks like to others.

use crate::error::{Error, Field, check_positive};
use crate::scalar::{EXTENT_LIMIT, Scalar};
use crate::vec2::{Vec2, vec2};

/// Shape around a body's centre; shapes don't rotate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape<S: Scalar> {
    /// A disc.
    Circle {
        /// Radius, px: above 0, at most [`EXTENT_LIMIT`].
        radius: S::Real,
    },
    /// An axis-aligned box.
    Box {
        /// Half width and half height, px: above 0, at most [`EXTENT_LIMIT`].
        half: Vec2<S::Real>,
    },
}

impl<S: Scalar> Shape<S> {
    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or [`Error::NotPositive`] with the first field that is, and its value.
    pub fn validate(&self) -> Result<(), Error<S>> {
        match *self {
            Self::Circle { radius } => check_positive(Field::Radius, radius, EXTENT_LIMIT),
            Self::Box { half } => {
                check_positive(Field::HalfWidth, half.x, EXTENT_LIMIT)?;
                check_positive(Field::HalfHeight, half.y, EXTENT_LIMIT)
            }
        }
    }

    /// Half width and half height of the bounding box, px.
    pub fn half_extents(&self) -> Vec2<S::Real> {
        match *self {
            Self::Circle { radius } => vec2(radius, radius),
            Self::Box { half } => half,
        }
    }
}
