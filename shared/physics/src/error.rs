//! What can be wrong with what a user passes in. Nothing changes when an error is returned.

use core::fmt;

use crate::config::Level;
use crate::effects::Effects;
use crate::handle::Handle;
use crate::scalar::{Scalar, px};
use crate::tiles::TileError;
use crate::variety::Variety;

/// Why a call was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Error<S: Scalar> {
    /// All body slots are taken.
    Full {
        /// Body capacity of the storage.
        capacity: u16,
    },
    /// A world can become a copy of one of its own size only.
    Size {
        /// Its room for bodies and contacts.
        own: (u16, u16),
        /// The other's.
        other: (u16, u16),
    },
    /// The body is gone, or the handle is of another world.
    NoSuchBody {
        /// The handle.
        handle: Handle,
    },
    /// The body isn't kinematic: the game may not move it itself.
    NotKinematic {
        /// The handle.
        handle: Handle,
    },
    /// The body isn't rigid: nothing pushes it.
    NotRigid {
        /// The handle.
        handle: Handle,
    },
    /// Something calls for effects that the world was [declared](crate::World::declare) to do without.
    Undeclared {
        /// The slot of the body, or the one that it would get; none for the settings.
        slot: Option<u16>,
        /// What it calls for and is not declared.
        missing: Effects,
        /// What is.
        declared: Effects,
    },
    /// The settings are for another level of accuracy than the world was [declared](crate::World::declare) to have.
    OtherLevel {
        /// The level of the settings.
        configured: Level,
        /// The declared one.
        declared: Level,
    },
    /// A body is of a kind that the world was [declared](crate::World::declare) to do without.
    OtherVariety {
        /// Its slot, or the one that it would get.
        slot: u16,
        /// What it is and is not declared.
        missing: Variety,
        /// What is.
        declared: Variety,
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
    /// Something is wrong with tiles.
    Tile(TileError),
}

impl<S: Scalar> From<TileError> for Error<S> {
    fn from(error: TileError) -> Self {
        Self::Tile(error)
    }
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
    Damping,
    SpeedCap,
    CcdThreshold,
    SleepSpeed,
    ImpulseX,
    ImpulseY,
    ForceX,
    ForceY,
    MotionX,
    MotionY,
    UpX,
    UpY,
    Snap,
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
            Self::Damping => "damping",
            Self::SpeedCap => "speed cap",
            Self::CcdThreshold => "ccd threshold",
            Self::SleepSpeed => "sleep speed",
            Self::ImpulseX => "impulse.x",
            Self::ImpulseY => "impulse.y",
            Self::ForceX => "force.x",
            Self::ForceY => "force.y",
            Self::MotionX => "motion.x",
            Self::MotionY => "motion.y",
            Self::UpX => "up.x",
            Self::UpY => "up.y",
            Self::Snap => "snap",
        })
    }
}

impl<S: Scalar> fmt::Display for Error<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Full { capacity } => write!(f, "all {capacity} body slots are taken"),
            Self::Size { own, other } => write!(
                f,
                "a world for {} bodies and {} contacts can't become a copy of one for {} and {}",
                own.0, own.1, other.0, other.1
            ),
            Self::NoSuchBody { handle } => {
                write!(f, "no body in slot {} of generation {}", handle.slot(), handle.generation())
            }
            Self::NotKinematic { handle } => write!(f, "the body in slot {} is not kinematic", handle.slot()),
            Self::NotRigid { handle } => write!(f, "the body in slot {} is not rigid", handle.slot()),
            Self::Undeclared { slot, missing, declared } => {
                match slot {
                    Some(slot) => write!(f, "the body in slot {slot} calls for {missing}")?,
                    None => write!(f, "the settings call for {missing}")?,
                }
                write!(f, ", but only {declared} is declared: declare {missing} too, or do without")
            }
            Self::OtherLevel { configured, declared } => {
                write!(
                    f,
                    "the settings are for level {configured:?}, but only {declared:?} is declared: use one of them"
                )
            }
            Self::OtherVariety { slot, missing, declared } => write!(
                f,
                "the body in slot {slot} calls for {missing}, but only {declared} is declared: declare {missing} too, or do without"
            ),
            Self::OutOfRange { field, value, range: (low, high) } => {
                write!(f, "{field} is {value}, must be {low}..={high}")
            }
            Self::NotPositive { field, value } => write!(f, "{field} is {value}, must be above 0"),
            Self::Tile(error) => error.fmt(f),
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
