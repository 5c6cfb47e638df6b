//! What can be wrong with what a user passes in. Nothing changes when an error is returned.

use core::fmt;

use crate::handle::Handle;
use crate::scalar::{Scalar, px};

/// Why a call was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Error<S: Scalar> {
    /// All body slots are taken.
    Full {
        /// Body capacity of the storage.
        capacity: u16,
    },
    /// The body is gone, or the handle is of another world.
    NoSuchBody {
        /// The handle.
        handle: Handle,
    },
    /// A number is outside its range, or not a number.
    OutOfRange {
        /// Which.
        field: Field,
        /// What it was.
        value: S::Real,
        /// Its range, both ends included.
        range: (i16, i16),
    },
    /// A number must be above 0.
    NotPositive {
        /// Which.
        field: Field,
        /// What it was.
        value: S::Real,
    },
}

/// A number that users set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // the names are those of the fields they stand for
pub enum Field {
    PositionX,
    PositionY,
    VelocityX,
    VelocityY,
    Radius,
    HalfWidth,
    HalfHeight,
    Mass,
    GravityScale,
    Restitution,
    Friction,
    GravityX,
    GravityY,
    VelocityIterations,
    Bias,
    Slop,
    VelocityThreshold,
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::PositionX => "position.x",
            Self::PositionY => "position.y",
            Self::VelocityX => "velocity.x",
            Self::VelocityY => "velocity.y",
            Self::Radius => "radius",
            Self::HalfWidth => "half width",
            Self::HalfHeight => "half height",
            Self::Mass => "mass",
            Self::GravityScale => "gravity scale",
            Self::Restitution => "restitution",
            Self::Friction => "friction",
            Self::GravityX => "gravity.x",
            Self::GravityY => "gravity.y",
            Self::VelocityIterations => "velocity iterations",
            Self::Bias => "bias",
            Self::Slop => "slop",
            Self::VelocityThreshold => "velocity threshold",
        })
    }
}

impl<S: Scalar> fmt::Display for Error<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Full { capacity } => write!(f, "all {capacity} body slots are taken"),
            Self::NoSuchBody { handle } => {
                write!(f, "no body in slot {} of generation {}", handle.slot(), handle.generation())
            }
            Self::OutOfRange { field, value, range: (low, high) } => {
                write!(f, "{field} is {value}, must be {low}..={high}")
            }
            Self::NotPositive { field, value } => write!(f, "{field} is {value}, must be above 0"),
        }
    }
}

impl<S: Scalar> core::error::Error for Error<S> {}

/// Whether a value lies in a range, both ends included; NaN doesn't.
pub(crate) fn check<S: Scalar>(field: Field, value: S::Real, low: i16, high: i16) -> Result<(), Error<S>> {
    let bound = |n: i16| S::real(px(n));
    if S::is_finite(value) && value >= bound(low) && value <= bound(high) {
        Ok(())
    } else {
        Err(Error::OutOfRange { field, value, range: (low, high) })
    }
}

/// Whether a value is above 0 and at most `high`.
pub(crate) fn check_positive<S: Scalar>(field: Field, value: S::Real, high: i16) -> Result<(), Error<S>> {
    check(field, value, 0, high)?;
    if value > S::real(px(0)) { Ok(()) } else { Err(Error::NotPositive { field, value }) }
}
