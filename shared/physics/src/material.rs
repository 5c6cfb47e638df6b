//! What happens at the surface of a body.
//!
//! Two surfaces combine to the lesser friction and the lesser restitution; a pair bounces only if both do.

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
}

impl<S: Scalar> Default for Material<S> {
    fn default() -> Self {
        Self::DEFAULT
    }
}
