//! Fixed point in 32-bit words with 64-bit products; see the table in [`crate::scalar`].

use ::fixed::types::{I2F30, I8F24, I16F16};

use super::{Quantity, SPEED_LIMIT, STEP_HZ, Scalar};
use crate::vec2::{Vec2, vec2};

/// The fixed-point format: the same bits on every chip, no FPU needed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fixed;

macro_rules! fixed_quantity {
    ($($fixed:ident),*) => {$(
        impl Quantity for $fixed {
            const ZERO: Self = $fixed::ZERO;
            #[inline]
            fn abs(self) -> Self {
                self.saturating_abs()
            }
            #[inline]
            fn saturating_add(self, other: Self) -> Self {
                $fixed::saturating_add(self, other)
            }
            #[inline]
            fn saturating_sub(self, other: Self) -> Self {
                $fixed::saturating_sub(self, other)
            }
            fn bits(self) -> i64 {
                self.to_bits().into()
            }
        }
    )*};
}

fixed_quantity!(I16F16, I8F24, I2F30);

/// `product / 2^SHIFT` to nearest, ties away from zero.
#[inline]
const fn rounded<const SHIFT: u32>(product: i64) -> i64 {
    (product + (1 << (SHIFT - 1)) + (product >> 63)) >> SHIFT
}

/// `numerator / denominator` to nearest, ties away from zero; the denominator is positive.
const fn divided(numerator: i64, denominator: i64) -> i64 {
    let half = denominator / 2;
    if numerator < 0 { (numerator - half) / denominator } else { (numerator + half) / denominator }
}

/// Held at the end of the range, the same on both sides.
#[inline]
const fn saturated(value: i64) -> i32 {
    if value > i32::MAX as i64 {
        i32::MAX
    } else if value < -(i32::MAX as i64) {
        -i32::MAX
    } else {
        value as i32
    }
}

#[inline]
fn product(a: i32, b: i32) -> i64 {
    i64::from(a) * i64::from(b)
}

#[inline]
fn product_high(a: u32, b: u32) -> u32 {
    ((u64::from(a) * u64::from(b)) >> 32) as u32
}

/// `2^30 / sqrt(t)` for `t` in Q32, 1/4 <= t < 1: the quadratic of least relative error (2.4 %), then three steps of
/// Newton's iteration `y <- y (3 - t y^2) / 2`, each of which turns an error e into 1.5 e^2.
#[inline]
fn reciprocal_sqrt(t: u32) -> u32 {
    // 2.670835 - 3.285357 t + 1.638568 t^2 in Q30.
    const C0: u32 = 2_867_787_662;
    const C1: u32 = 3_527_624_809;
    const C2: u32 = 1_759_398_851;
    let mut y = C0 - product_high(C1 - product_high(C2, t), t);
    for _ in 0..3 {
        let squared = product_high(y, y); // Q28
        let error = product_high(t, squared); // Q28, close to 1
        y = ((u64::from(y) * u64::from((3 << 28) - error)) >> 29) as u32;
    }
    y
}

impl Scalar for Fixed {
    type Real = I16F16;
    type Speed = I8F24;
    type Unit = I2F30;

    const NAME: &'static str = "fixed";
    const ONE: I16F16 = I16F16::ONE;
    const UNIT: I2F30 = I2F30::ONE;
    const FASTEST: I8F24 = I8F24::from_bits((SPEED_LIMIT as i32) << 24);

    fn real(value: I16F16) -> I16F16 {
        value
    }
    fn is_finite(_value: I16F16) -> bool {
        true
    }
    fn speed(px_per_second: I16F16) -> I8F24 {
        let bits = divided(i64::from(px_per_second.to_bits()) << 8, i64::from(STEP_HZ));
        I8F24::from_bits(saturated(bits)).held(Self::FASTEST)
    }
    fn px_per_second(speed: I8F24) -> I16F16 {
        I16F16::from_bits(saturated(rounded::<8>(i64::from(speed.to_bits()) * i64::from(STEP_HZ))))
    }
    fn speed_from_bits(bits: i64) -> I8F24 {
        I8F24::from_bits(bits as i32)
    }
    fn acceleration(px_per_second2: I16F16) -> I8F24 {
        let bits = divided(i64::from(px_per_second2.to_bits()) << 8, i64::from(STEP_HZ * STEP_HZ));
        I8F24::from_bits(bits as i32) // at most 2^31 * 2^8 / 3600
    }

    #[inline]
    fn advance(position: I16F16, remainder: &mut i16, velocity: I8F24) -> I16F16 {
        let fine = velocity.to_bits() + i32::from(*remainder); // |velocity| <= SPEED_LIMIT leaves room
        let whole = fine / 256;
        *remainder = (fine - whole * 256) as i16;
        I16F16::from_bits(position.to_bits() + whole)
    }
    #[inline]
    fn speed_along(velocity: Vec2<I8F24>, direction: Vec2<I2F30>) -> I8F24 {
        let sum =
            product(velocity.x.to_bits(), direction.x.to_bits()) + product(velocity.y.to_bits(), direction.y.to_bits());
        I8F24::from_bits(saturated(rounded::<30>(sum)))
    }
    #[inline]
    fn speed_times(speed: I8F24, factor: I2F30) -> I8F24 {
        I8F24::from_bits(saturated(rounded::<30>(product(speed.to_bits(), factor.to_bits()))))
    }
    #[inline]
    fn speed_scaled(speed: I8F24, factor: I16F16) -> I8F24 {
        I8F24::from_bits(saturated(rounded::<16>(product(speed.to_bits(), factor.to_bits()))))
    }
    #[inline]
    fn length_times(length: I16F16, factor: I2F30) -> I16F16 {
        I16F16::from_bits(saturated(rounded::<30>(product(length.to_bits(), factor.to_bits()))))
    }
    #[inline]
    fn length_scaled(length: I16F16, factor: I16F16) -> I16F16 {
        I16F16::from_bits(saturated(rounded::<16>(product(length.to_bits(), factor.to_bits()))))
    }
    fn mass_share(own: I16F16, other: I16F16) -> I2F30 {
        if own == other {
            return I2F30::from_bits(1 << 29);
        }
        let (own, other) = (i64::from(own.to_bits()), i64::from(other.to_bits()));
        I2F30::from_bits(divided(other << 30, own + other) as i32)
    }

    #[inline]
    fn within(offset: Vec2<I16F16>, radius: I16F16) -> bool {
        let (x, y, r) = (offset.x.to_bits(), offset.y.to_bits(), radius.to_bits());
        // Up to 2^62 each: the sum fits an unsigned word.
        (product(x, x) as u64) + (product(y, y) as u64) <= product(r, r) as u64
    }
    #[inline]
    fn direction(offset: Vec2<I16F16>) -> Option<(Vec2<I2F30>, I16F16)> {
        let (x, y) = (offset.x.to_bits(), offset.y.to_bits());
        let longest = x.unsigned_abs().max(y.unsigned_abs());
        if longest == 0 {
            return None;
        }
        // Scale so that the longer side lies in [2^29, 2^30): short vectors get as good a direction as long ones.
        let up = longest.leading_zeros() as i32 - 2;
        let scale = |side: i32| if up >= 0 { side << up } else { side >> -up };
        let (x, y) = (scale(x), scale(y));
        let squared = (product(x, x) + product(y, y)) as u64; // [2^58, 2^61)
        // As a fraction of 2^60 this is t in [1/4, 2); the iteration wants it below 1.
        let one_or_more = squared >= 1 << 60;
        let t = if one_or_more { squared >> 30 } else { squared >> 28 } as u32;
        let reciprocal = reciprocal_sqrt(t) >> u32::from(one_or_more); // 2^60 / sqrt(squared)
        let scaled = |side: i32| rounded::<30>(i64::from(side) * i64::from(reciprocal)) as i32;
        let (nx, ny) = (scaled(x), scaled(y));
        let length = (product(x, nx) + product(y, ny)) >> 30;
        let length = if up > 0 { (length + (1 << (up - 1))) >> up } else { length << -up };
        Some((vec2(I2F30::from_bits(nx), I2F30::from_bits(ny)), I16F16::from_bits(saturated(length))))
    }
    #[inline]
    fn half(length: I16F16) -> I16F16 {
        I16F16::from_bits(length.to_bits() / 2)
    }
    #[inline]
    fn floor(length: I16F16) -> i32 {
        length.to_bits() >> 16
    }
}
