//! Number formats behind one trait: fixed point for the devices, `f32` for chips with an FPU, `f64` as oracle.
//!
//! | quantity | unit | [`Fixed`] | range | resolution |
//! |---|---|---|---|---|
//! | [`Real`](Scalar::Real) | px, px/s, px/s2, mass, coefficients | Q16.16 | +-32768 | 1.5e-5 |
//! | [`Speed`](Scalar::Speed) | px per step | Q8.24 | +-128 (7680 px/s) | 6e-8 (3.6e-6 px/s) |
//! | [`Unit`](Scalar::Unit) | 1 (normals, mass shares) | Q2.30 | +-2 | 9e-10 |
//!
//! **Overflow.** Nothing wraps. Positions stay within [`POSITION_LIMIT`] and half extents within [`EXTENT_LIMIT`], so sums
//! and differences of lengths fit. Speeds and corrections saturate at the end of the format; once a step, speeds are
//! held within [`SPEED_LIMIT`], and each component held there is counted.
//!
//! **Rounding.** To nearest, ties away from zero: a mirrored scene gives mirrored bits. Integrating a position keeps what
//! rounding would lose in a remainder, so no velocity is too small to move a body.

mod fixed_point;
mod float;

use core::fmt::{Debug, Display};
use core::ops::{Add, Neg, Sub};

use ::fixed::types::I16F16;

use crate::vec2::{Vec2, vec2};
pub use fixed_point::Fixed;

/// Largest coordinate of a body's centre, px. A body beyond it is disabled and reported.
pub const POSITION_LIMIT: i16 = 16_384;
/// Largest half extent or radius, px.
pub const EXTENT_LIMIT: i16 = 4_096;
/// Largest velocity component, px per step (7620 px/s).
pub const SPEED_LIMIT: i16 = 127;
/// Steps per second.
pub const STEP_HZ: u32 = 60;

/// A fixed-point constant in whole px (or px/s, px/s2).
pub const fn px(whole: i16) -> I16F16 {
    I16F16::from_bits((whole as i32) << 16)
}

/// The fixed-point constant `numerator / denominator`, rounded towards 0.
///
/// # Panics
/// If the denominator is 0; in a constant that is a compile error.
pub const fn ratio(numerator: i16, denominator: i16) -> I16F16 {
    I16F16::from_bits(((numerator as i32) << 16) / denominator as i32)
}

/// A number with a unit.
pub trait Quantity:
    Copy + Debug + Default + Display + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Neg<Output = Self>
{
    /// Nothing.
    const ZERO: Self;
    /// Magnitude.
    #[must_use]
    fn abs(self) -> Self;
    /// Sum, held at the end of the format.
    #[must_use]
    fn saturating_add(self, other: Self) -> Self;
    /// Difference, held at the end of the format.
    #[must_use]
    fn saturating_sub(self, other: Self) -> Self;
    /// The bits, for digests and streams: fixed point as the signed integer, floats as IEEE bits.
    fn bits(self) -> i64;

    /// The smaller of two.
    #[inline]
    #[must_use]
    fn lesser(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of two.
    #[inline]
    #[must_use]
    fn greater(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// The value within +-`limit`.
    #[inline]
    #[must_use]
    fn held(self, limit: Self) -> Self {
        self.lesser(limit).greater(-limit)
    }
}

impl<T: Quantity> Vec2<T> {
    /// Sum, each component held at the end of the format.
    #[inline]
    #[must_use]
    pub fn saturating_add(self, other: Self) -> Self {
        vec2(self.x.saturating_add(other.x), self.y.saturating_add(other.y))
    }

    /// Difference, each component held at the end of the format.
    #[inline]
    #[must_use]
    pub fn saturating_sub(self, other: Self) -> Self {
        vec2(self.x.saturating_sub(other.x), self.y.saturating_sub(other.y))
    }
}

/// A number format: the quantities that physics computes with and the operations between them.
///
/// Operations name their rounding and what happens at the end of the range only where it differs from the module's rule.
pub trait Scalar: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// What users speak in: px, px/s, px/s2, mass, coefficients.
    type Real: Quantity;
    /// Velocity in px per step.
    type Speed: Quantity;
    /// Dimensionless, at most 1 in magnitude.
    type Unit: Quantity;

    /// Name of the format.
    const NAME: &'static str;
    /// One.
    const ONE: Self::Real;
    /// One.
    const UNIT: Self::Unit;
    /// [`SPEED_LIMIT`].
    const FASTEST: Self::Speed;

    /// Converts a constant; exact for up to 24 significant bits.
    fn real(value: I16F16) -> Self::Real;
    /// False for NaN and infinities.
    fn is_finite(value: Self::Real) -> bool;
    /// px/s to px per step, held within [`SPEED_LIMIT`].
    fn speed(px_per_second: Self::Real) -> Self::Speed;
    /// px per step to px/s.
    fn px_per_second(speed: Self::Speed) -> Self::Real;
    /// The speed with these [`Quantity::bits`].
    fn speed_from_bits(bits: i64) -> Self::Speed;
    /// px/s2 to px per step, per step.
    fn acceleration(px_per_second2: Self::Real) -> Self::Speed;

    /// A centre after one step at `velocity`, |component| <= [`SPEED_LIMIT`]; `remainder` carries what rounding would lose to
    /// the next step, in 1/256 of the format's resolution with the sign of the motion (floats leave it alone).
    fn advance(position: Self::Real, remainder: &mut i16, velocity: Self::Speed) -> Self::Real;
    /// Speed along a unit vector: the scalar product, saturating.
    fn speed_along(velocity: Vec2<Self::Speed>, direction: Vec2<Self::Unit>) -> Self::Speed;
    /// Component of a speed along one axis of a unit vector, or its share.
    fn speed_times(speed: Self::Speed, factor: Self::Unit) -> Self::Speed;
    /// A speed times a coefficient, saturating.
    fn speed_scaled(speed: Self::Speed, factor: Self::Real) -> Self::Speed;
    /// Component of a length along one axis of a unit vector, or its share.
    fn length_times(length: Self::Real, factor: Self::Unit) -> Self::Real;
    /// A length times a coefficient, saturating.
    fn length_scaled(length: Self::Real, factor: Self::Real) -> Self::Real;
    /// The part of a pair's impulse that moves the first body: `other / (own + other)`. Masses are positive.
    fn mass_share(own: Self::Real, other: Self::Real) -> Self::Unit;

    /// Whether a vector is no longer than `radius`, exactly.
    fn within(offset: Vec2<Self::Real>, radius: Self::Real) -> bool;
    /// Direction (to 6e-9) and length of a vector; none for the zero vector.
    fn direction(offset: Vec2<Self::Real>) -> Option<(Vec2<Self::Unit>, Self::Real)>;
    /// Half of a length.
    fn half(length: Self::Real) -> Self::Real;
    /// Whole px, rounded down.
    fn floor(length: Self::Real) -> i32;
}
