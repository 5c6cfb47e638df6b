//! What swept tests need of lengths: comparisons without rounding, quotients rounded down.

use ::fixed::types::{I2F30, I16F16};

use super::Quantity;
use super::fixed_point::quotient;
use crate::vec2::Vec2;

/// Lengths whose squares and products compare without rounding, and their fractions as a `Unit`.
///
/// Floats round as IEEE says; [`SLACK`](Self::SLACK) covers what they lose at the ends of the world.
pub trait Exact<Unit>: Quantity {
    /// Overlap that counts as touching, px: what rounding a position can cost. 0 in fixed point, where a position that was found
    /// free stays so.
    const SLACK: Self;
    /// The least length that moves any body, px.
    const NUDGE: Self;

    /// `self / whole` rounded down, for 0 <= `self` < `whole`.
    fn fraction_of(self, whole: Self) -> Unit;
    /// Whether `a * b < c * d`.
    fn product_less(a: Self, b: Self, c: Self, d: Self) -> bool;
    /// Whether a vector is shorter than `radius`.
    fn shorter(offset: Vec2<Self>, radius: Self) -> bool;
    /// Whether a point that makes `motion` comes closer than `radius` to what lies at `offset` from it. If it moves away or past,
    /// none; otherwise when it first does, 0..=1, early by what moves it by a unit of the last place at most.
    fn approach(offset: Vec2<Self>, motion: Vec2<Self>, radius: Self) -> Option<Unit>;
}

/// The bits, with the two ends of the format equally far from 0: sums of two products then fit 63 bits.
fn wide(length: I16F16) -> i64 {
    i64::from(length.to_bits().max(-i32::MAX))
}

/// The root rounded down, digit by digit: a tenth of the code of [`u64::isqrt`], which is made for speed.
#[inline]
fn square_root(number: u64) -> u64 {
    let (mut rest, mut root) = (number, 0);
    for digit in (0..64).step_by(2).rev() {
        let next = root + (1 << digit);
        root >>= 1;
        if rest >= next {
            rest -= next;
            root += 1 << digit;
        }
    }
    root
}

/// Bits without leading zeros. Out of line: chips without an instruction for it take 150 bytes.
#[inline(never)]
fn bits(number: u64) -> u32 {
    u64::BITS - number.leading_zeros()
}

impl Exact<I2F30> for I16F16 {
    const SLACK: Self = Self::ZERO;
    const NUDGE: Self = Self::DELTA;

    fn fraction_of(self, whole: Self) -> I2F30 {
        I2F30::from_bits(quotient((wide(self) as u64) << 30, wide(whole) as u32) as i32)
    }

    #[inline]
    fn product_less(a: Self, b: Self, c: Self, d: Self) -> bool {
        wide(a) * wide(b) < wide(c) * wide(d)
    }

    #[inline]
    fn shorter(offset: Vec2<Self>, radius: Self) -> bool {
        let (x, y, r) = (wide(offset.x), wide(offset.y), wide(radius));
        x * x + y * y < r * r
    }

    fn approach(offset: Vec2<Self>, motion: Vec2<Self>, radius: Self) -> Option<I2F30> {
        let (x, y, mx, my, r) = (wide(offset.x), wide(offset.y), wide(motion.x), wide(motion.y), wide(radius));
        // The point at time t is closer than r where L t^2 - 2 A t + x^2 + y^2 - r^2 < 0, with the scalar product A and the
        // squared length L. The discriminant is r^2 L - B^2, with the cross product B.
        let ahead = x * mx + y * my;
        if ahead <= 0 {
            return None;
        }
        let (length2, aside) = ((mx * mx + my * my) as u64, (x * my - y * mx).unsigned_abs());
        let wide_product = |a: u64, b: u64| u128::from(a) * u128::from(b);
        let discriminant = wide_product((r * r) as u64, length2).checked_sub(wide_product(aside, aside))?;
        let ends_short = ahead as u64 >= length2 && !Self::shorter(offset.saturating_sub(motion), radius);
        if discriminant == 0 || ends_short {
            return None;
        }
        // 64 of its bits give 32 bits of the root, rounded up.
        let (high, low) = ((discriminant >> 64) as u64, discriminant as u64);
        let excess = bits(high).div_ceil(2); // at most 31: the radius has 31 bits, the motion 32
        let upper = if excess == 0 { low } else { low >> (2 * excess) | high << (64 - 2 * excess) };
        let root = (square_root(upper) + 1) << excess;
        let start = (ahead as u64).saturating_sub(root);
        if start >= length2 {
            return Some(I2F30::ONE);
        }
        // 33 bits of the divisor leave the quotient right to its last place but one.
        let excess = bits(length2).saturating_sub(33);
        let (start, length2) = ((start >> excess) << 30, length2 >> excess);
        // Of those, 32 say it to within two.
        let excess = bits(length2).saturating_sub(32);
        let mut time = quotient(start >> excess, (length2 >> excess) as u32);
        while u64::from(time) * length2 > start {
            time -= 1;
        }
        Some(I2F30::from_bits(time as i32))
    }
}

macro_rules! exact_float {
    ($float:ident, $sqrt:path, $slack:expr) => {
        impl Exact<$float> for $float {
            const SLACK: Self = $slack;
            const NUDGE: Self = $slack;

            fn fraction_of(self, whole: Self) -> Self {
                self / whole
            }
            #[inline]
            fn product_less(a: Self, b: Self, c: Self, d: Self) -> bool {
                a * b < c * d
            }
            #[inline]
            fn shorter(offset: Vec2<Self>, radius: Self) -> bool {
                offset.x * offset.x + offset.y * offset.y < radius * radius
            }
            fn approach(offset: Vec2<Self>, motion: Vec2<Self>, radius: Self) -> Option<Self> {
                let ahead = offset.x * motion.x + offset.y * motion.y;
                if ahead <= 0.0 {
                    return None;
                }
                let length2 = motion.x * motion.x + motion.y * motion.y;
                let aside = offset.x * motion.y - offset.y * motion.x;
                let discriminant = radius * radius * length2 - aside * aside;
                let ends_short = ahead >= length2 && !Self::shorter(offset - motion, radius);
                if discriminant <= 0.0 || ends_short {
                    return None;
                }
                Some(((ahead - $sqrt(discriminant)) / length2).greater(0.0).lesser(1.0))
            }
        }
    };
}

// Twice the resolution at the ends of the world.
exact_float!(f32, libm::sqrtf, 1.0 / 256.0);
exact_float!(f64, libm::sqrt, 1e-11);
