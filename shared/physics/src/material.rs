//! What happens at the surface of a body.
//!
//! Two surfaces combine to the lesser friction and the lesser restitution; a pair bounces only if both do.

use crate::effects::Effects;
use crate::error::{Error, Field, check};
use crate::scalar::{Quantity, Scalar};

/// Surface of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material<S: Scalar> {
    /// Part of the approach speed that comes back: 0 absorbs, 1 returns all; at most 2.
    pub restitution: S::Real,
    /// Whether the body bounces at all.
    pub bounce: bool,
    /// Coulomb coefficient, 0..=1.
    pub friction: S::Real,
}

impl<S: Scalar> Material<S> {
    /// Fully elastic and frictionless.
    pub const DEFAULT: Self = Self { restitution: S::ONE, bounce: true, friction: S::Real::ZERO };

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the first field that is, and its value.
    pub fn validate(&self) -> Result<(), Error<S>> {
        check(Field::Restitution, self.restitution, 0, 2)?;
        check(Field::Friction, self.friction, 0, 1)
    }

    /// The effects without which this surface would not do what it says.
    pub fn called_for(&self) -> Effects {
        let bounces = self.bounce && self.restitution > S::Real::ZERO;
        let rubs = self.friction > S::Real::ZERO;
        let calls = |condition, effect| if condition { effect } else { Effects::NONE };
        calls(bounces, Effects::BOUNCE) | calls(rubs, Effects::FRICTION)
    }
}

impl<S: Scalar> Default for Material<S> {
    fn default() -> Self {
        Self::DEFAULT
    }
}
