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

mod exact;
mod fixed_point;
mod float;

use core::fmt::{Debug, Display};
use core::ops::{Add, Neg, Sub};

use ::fixed::types::I16F16;

use crate::vec2::{Vec2, vec2};
pub use exact::Exact;
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

    /// Whether the magnitude is at most `limit`, which is 0 or more.
    #[inline]
    fn is_within(self, limit: Self) -> bool {
        self <= limit && self >= -limit
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
    type Real: Quantity + Exact<Self::Unit>;
    /// Velocity in px per step.
    type Speed: Quantity;
    /// Dimensionless, at most 1 in magnitude.
    type Unit: Quantity;
    /// px2, exact.
    type Area: Copy + PartialOrd;

    /// Name of the format.
    const NAME: &'static str;
    /// One.
    const ONE: Self::Real;
    /// One.
    const UNIT: Self::Unit;
    /// [`SPEED_LIMIT`].
    const FASTEST: Self::Speed;
    /// Largest impulse that a contact remembers, px per step; what exceeds it is left to the pass from the ground up.
    const MOST_IMPULSE: Self::Speed;

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
    /// How far a motion leads, in 2^-14 px along the longer axis: never too little, at least 1 and at most twice too much.
    fn creep(motion: Vec2<Self::Speed>) -> u16;
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
    /// `value / (mass rate)` for a positive mass: a force or an impulse as a change of velocity, held within [`SPEED_LIMIT`].
    fn over_mass(value: Self::Real, mass: Self::Real, rate: u32) -> Self::Speed;

    /// Whether a contact's visit fits 32 bits: velocities below 8 px/step and an impulse below 32. Faster bodies are rare, and take
    /// the same formulas through the saturating operations.
    fn is_tame(a: Vec2<Self::Speed>, b: Vec2<Self::Speed>, impulse: Self::Speed) -> bool;
    /// Whether a change of velocity is too small to be worth making: below 2^-18 px/step (0.0002 px/s) along both axes.
    fn is_negligible(change: Vec2<Self::Speed>) -> bool;
    /// Whether the difference of two velocities is [negligible](Self::is_negligible), tame or not.
    fn is_nearly_same(a: Vec2<Self::Speed>, b: Vec2<Self::Speed>) -> bool;
    /// Whether two velocities differ by at most 2^-15 px/step (0.002 px/s) along both axes.
    fn is_at_rest(a: Vec2<Self::Speed>, b: Vec2<Self::Speed>) -> bool;
    /// Components of a tame vector along a unit normal (x) and along the normal turned by a quarter (y). Each product is rounded
    /// down to the format's resolution.
    fn into_frame(vector: Vec2<Self::Speed>, normal: Vec2<Self::Unit>) -> Vec2<Self::Speed>;
    /// The inverse of [`into_frame`](Self::into_frame), rounded likewise.
    fn out_of_frame(vector: Vec2<Self::Speed>, normal: Vec2<Self::Unit>) -> Vec2<Self::Speed>;
    /// A share of a tame speed, rounded down to twice the format's resolution.
    fn tame_share(speed: Self::Speed, share: Self::Unit) -> Self::Speed;
    /// Half of a speed, rounded down.
    fn half_speed(speed: Self::Speed) -> Self::Speed;
    /// A sixteenth of a speed, rounded down.
    fn sixteenth(speed: Self::Speed) -> Self::Speed;
    /// A half of a speed, as [`speed_times`](Self::speed_times) rounds it.
    fn even_part(speed: Self::Speed) -> Self::Speed;
    /// The most that friction may do: a speed of 0 or more times a coefficient in 1/32768, rounded down.
    fn coulomb(normal: Self::Speed, friction: u16) -> Self::Speed;
    /// `speed / slope` for a slope of 1/2..=1, to 1e-4 and never more than that.
    fn over_slope(speed: Self::Speed, slope: Self::Unit) -> Self::Speed;
    /// `speed / share` for a share above 0, saturating.
    fn over_share(speed: Self::Speed, share: Self::Unit) -> Self::Speed;
    /// A speed after (or before, where `acceleration` is negative) falling: `sqrt(speed^2 + 2 acceleration distance)`; 0 if that
    /// is not real.
    fn fallen(speed: Self::Speed, acceleration: Self::Speed, distance: Self::Speed) -> Self::Speed;
    /// A length as the speed that covers it in a step, saturating.
    fn per_step(length: Self::Real) -> Self::Speed;
    /// What a speed covers in a step, rounded down.
    fn in_a_step(speed: Self::Speed) -> Self::Real;
    /// The constant `numerator / denominator` of at most 1.
    fn unit_ratio(numerator: i8, denominator: i8) -> Self::Unit;
    /// A whole number below 2^24 kept as a unit; [`number_of`](Self::number_of) gives it back.
    fn unit_from_number(number: u32) -> Self::Unit;
    /// The number that [`unit_from_number`](Self::unit_from_number) took.
    fn number_of(unit: Self::Unit) -> u32;
    /// A product of two lengths, for comparing with others.
    fn area(a: Self::Real, b: Self::Real) -> Self::Area;
    /// The mean of two speeds, rounded down.
    fn mean(a: Self::Speed, b: Self::Speed) -> Self::Speed;
    /// Part of a speed in another, larger one; both above 0.
    fn per_speed(part: Self::Speed, whole: Self::Speed) -> Self::Unit;
    /// What part of a motion, of 32767, is cut to leave `rest`, 0..=1; rounded up.
    fn cut(rest: Self::Unit) -> i16;
    /// A motion of which so many parts of 32767 are cut, rounded towards 0.
    fn uncut(motion: Self::Speed, cut: i16) -> Self::Speed;
    /// A velocity with its magnitude held at `cap`, to 1e-7 of it.
    fn capped(velocity: Vec2<Self::Speed>, cap: Self::Speed) -> Vec2<Self::Speed>;
    /// A length in 1/4096 px, of at most 16 px.
    fn pushes(count: i32) -> Self::Speed;
    /// A length in whole 1/4096 px, rounded towards 0, held at 4 px.
    fn whole_pushes(length: Self::Speed) -> i16;
    /// A value in 1/65 536, rounded towards 0.
    fn in_65536ths(value: Self::Real) -> i64;
    /// A coefficient of 0..=1 in 1/32768.
    fn coefficient(value: Self::Real) -> u16;

    /// Whether a vector is no longer than `radius`, exactly.
    fn within(offset: Vec2<Self::Real>, radius: Self::Real) -> bool;
    /// Direction (to 6e-9) and length of a vector; none for the zero vector.
    fn direction(offset: Vec2<Self::Real>) -> Option<(Vec2<Self::Unit>, Self::Real)>;
    /// Half of a length.
    fn half(length: Self::Real) -> Self::Real;
    /// Whole px, rounded down.
    fn floor(length: Self::Real) -> i32;
}
