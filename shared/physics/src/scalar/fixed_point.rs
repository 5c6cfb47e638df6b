//! Fixed point in 32-bit words with 64-bit products; see the table in [`crate::scalar`].

use ::fixed::types::{I2F30, I8F24, I16F16};

use super::{Quantity, SPEED_LIMIT, STEP_HZ, Scalar};
use crate::geometry::direction;
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
    // Half of the last place; below 0 a unit less, which is still one word.
    let half = (1u32 << (SHIFT - 1)).wrapping_add((product >> 63) as u32);
    (product + half as i64) >> SHIFT
}

/// `numerator / denominator` to nearest, ties away from zero; the denominator is positive.
const fn divided(numerator: i64, denominator: i64) -> i64 {
    let half = denominator / 2;
    if numerator < 0 { (numerator - half) / denominator } else { (numerator + half) / denominator }
}

/// `numerator / divisor` rounded down, held at the end of the word; the divisor is above 0. Long division by two digits of 16 bits
/// (D. Knuth, "The Art of Computer Programming" 2, 4.3.1 D): a third of the code that dividing 64 bits by 64 takes.
#[inline(never)]
pub(super) fn quotient(numerator: u64, divisor: u32) -> u32 {
    if (numerator >> 32) as u32 >= divisor {
        return u32::MAX;
    }
    let zeros = even_leading_zeros(divisor);
    let (numerator, divisor) = (numerator << zeros, divisor << zeros);
    let (mut rest, low) = ((numerator >> 32) as u32, numerator as u32);
    let mut whole = 0;
    for next in [low >> 16, low & 0xffff] {
        // What the divisor's upper digit says is too much by four at most.
        let (mut digit, mut left) = (rest / (divisor >> 16), rest % (divisor >> 16));
        while digit >> 16 != 0 || (left >> 16 == 0 && digit * (divisor & 0xffff) > (left << 16 | next)) {
            digit -= 1;
            left += divisor >> 16;
        }
        rest = (rest << 16 | next).wrapping_sub(digit.wrapping_mul(divisor));
        whole = whole << 16 | digit;
    }
    whole
}

/// Held at the end of the range, the same on both sides.
#[inline]
const fn saturated(value: i64) -> i32 {
    let word = value as i32;
    if word as i64 == value && word != i32::MIN { word } else { end_of_range(value < 0) }
}

#[cold]
const fn end_of_range(below: bool) -> i32 {
    if below { -i32::MAX } else { i32::MAX }
}

/// `a b / 2^SHIFT` to nearest, held at the end of the range. Out of line: inlined it would be most of what calls it, and what is
/// called all the time takes shorter ways.
#[inline(never)]
fn scaled<const SHIFT: u32>(a: i32, b: i32) -> i32 {
    saturated(rounded::<SHIFT>(product(a, b)))
}

/// `bits * 2^SHIFT / DIVISOR` to nearest for an odd divisor below 2^8, which leaves no ties: without a division of 64 bits.
fn over<const SHIFT: u32, const DIVISOR: u32>(bits: i32) -> i32 {
    let (whole, rest) = (bits.unsigned_abs() / DIVISOR, bits.unsigned_abs() % DIVISOR);
    let magnitude = (whole << SHIFT) + ((rest << SHIFT) + DIVISOR / 2) / DIVISOR;
    if bits < 0 { -(magnitude as i32) } else { magnitude as i32 }
}

#[inline]
fn product(a: i32, b: i32) -> i64 {
    i64::from(a) * i64::from(b)
}

/// Upper half of a signed product: one instruction.
#[inline]
fn upper_half(a: i32, b: i32) -> i32 {
    (product(a, b) >> 32) as i32
}

#[inline]
fn product_high(a: u32, b: u32) -> u32 {
    ((u64::from(a) * u64::from(b)) >> 32) as u32
}

/// Upper half of a product of a signed and an unsigned word: one instruction.
#[inline]
fn product_high_mixed(a: i32, b: u32) -> i32 {
    ((i64::from(a) * i64::from(b)) >> 32) as i32
}

/// `2^30 / sqrt(t)` for `t` in Q32, 1/4 <= t < 1: the quartic of least relative error (0.22 %), then two steps of Newton's
/// iteration `y <- y + y (1 - t y^2) / 2`, each of which turns an error e into 1.5 e^2.
#[inline]
fn reciprocal_sqrt(t: u32) -> u32 {
    // 3.498030 - 8.984586 t + 14.657674 t^2 - 11.973431 t^3 + 3.804430 t^4 in Q28.
    const C: [u32; 5] = [938_995_352, 2_411_781_490, 3_934_639_439, 3_214_093_319, 1_021_243_944];
    let quartic = C[2] - product_high(C[3] - product_high(C[4], t), t);
    let mut y = (C[0] - product_high(C[1] - product_high(quartic, t), t)) << 2;
    for _ in 0..2 {
        let error = (1 << 28) - product_high(t, product_high(y, y)) as i32; // Q28, close to 0
        y = y.wrapping_add_signed(product_high_mixed(error << 3, y));
    }
    y
}

/// Whether both are in `-2^BITS..2^BITS`.
#[inline]
fn are_small<const BITS: u32>(x: i32, y: i32) -> bool {
    let shifted = |v: i32| v.wrapping_add(1 << BITS);
    ((shifted(x) | shifted(y)) as u32) >> (BITS + 1) == 0
}

/// Leading zeros of a word above 0, of those an even number: by halves, for chips that have no instruction for it.
#[inline]
fn even_leading_zeros(word: u32) -> u32 {
    let in_byte = |zeros: u32| {
        let byte = (word << zeros) >> 24;
        zeros
            + if byte >= 1 << 4 {
                if byte >= 1 << 6 { 0 } else { 2 }
            } else if byte >= 1 << 2 {
                4
            } else {
                6
            }
    };
    if word >= 1 << 16 {
        if word >= 1 << 24 { in_byte(0) } else { in_byte(8) }
    } else if word >= 1 << 8 {
        in_byte(16)
    } else {
        in_byte(24)
    }
}

/// A number above 0 as `t 4^(32 - up)`, with `t` in Q32, 1/4 <= t < 1.
#[inline(always)] // as for `direction`
fn normalized(number: u64) -> (u32, u32) {
    let (high, low) = ((number >> 32) as u32, number as u32);
    if high == 0 {
        return normalized_word(low);
    }
    let zeros = even_leading_zeros(high);
    (high << zeros | (low >> 1) >> (31 - zeros), zeros / 2)
}

/// [`normalized`] for one word: the square of less than a px.
#[cold]
#[inline(never)]
fn normalized_word(mut number: u32) -> (u32, u32) {
    let mut up = 16;
    while number < 1 << 30 {
        number <<= 2;
        up += 1;
    }
    (number, up)
}

impl Scalar for Fixed {
    type Real = I16F16;
    type Speed = I8F24;
    type Unit = I2F30;
    type Area = i64;

    const NAME: &'static str = "fixed";
    const ONE: I16F16 = I16F16::ONE;
    const UNIT: I2F30 = I2F30::ONE;
    const FASTEST: I8F24 = I8F24::from_bits((SPEED_LIMIT as i32) << 24);

    const MOST_IMPULSE: I8F24 = Self::FASTEST;

    fn real(value: I16F16) -> I16F16 {
        value
    }
    fn is_finite(_value: I16F16) -> bool {
        true
    }
    fn speed(px_per_second: I16F16) -> I8F24 {
        const FASTEST: i32 = (SPEED_LIMIT as i32 * STEP_HZ as i32) << 16;
        const { assert!(STEP_HZ == 15 << 2) }; // 2^8 / 60 = 2^6 / 15
        I8F24::from_bits(over::<6, 15>(px_per_second.to_bits().clamp(-FASTEST, FASTEST)))
    }
    fn px_per_second(speed: I8F24) -> I16F16 {
        I16F16::from_bits(saturated(rounded::<8>(i64::from(speed.to_bits()) * i64::from(STEP_HZ))))
    }
    fn speed_from_bits(bits: i64) -> I8F24 {
        I8F24::from_bits(bits as i32)
    }
    fn acceleration(px_per_second2: I16F16) -> I8F24 {
        const { assert!(STEP_HZ * STEP_HZ == 225 << 4) }; // 2^8 / 3600 = 2^4 / 225
        I8F24::from_bits(over::<4, 225>(px_per_second2.to_bits()))
    }

    #[inline]
    fn advance(position: I16F16, remainder: &mut i16, velocity: I8F24) -> I16F16 {
        let fine = velocity.to_bits() + i32::from(*remainder); // |velocity| <= SPEED_LIMIT leaves room
        let whole = fine / 256;
        *remainder = (fine - whole * 256) as i16;
        I16F16::from_bits(position.to_bits() + whole)
    }
    #[inline]
    fn creep(motion: Vec2<I8F24>) -> u16 {
        let length = motion.x.to_bits().unsigned_abs() | motion.y.to_bits().unsigned_abs();
        (length >> 10).min(0x7fff) as u16 + 1
    }
    #[inline(never)]
    fn speed_along(velocity: Vec2<I8F24>, direction: Vec2<I2F30>) -> I8F24 {
        let sum =
            product(velocity.x.to_bits(), direction.x.to_bits()) + product(velocity.y.to_bits(), direction.y.to_bits());
        I8F24::from_bits(saturated(rounded::<30>(sum)))
    }
    #[inline]
    fn speed_times(speed: I8F24, factor: I2F30) -> I8F24 {
        I8F24::from_bits(scaled::<30>(speed.to_bits(), factor.to_bits()))
    }
    #[inline]
    fn speed_scaled(speed: I8F24, factor: I16F16) -> I8F24 {
        I8F24::from_bits(scaled::<16>(speed.to_bits(), factor.to_bits()))
    }
    #[inline]
    fn length_times(length: I16F16, factor: I2F30) -> I16F16 {
        I16F16::from_bits(scaled::<30>(length.to_bits(), factor.to_bits()))
    }
    #[inline]
    fn length_scaled(length: I16F16, factor: I16F16) -> I16F16 {
        I16F16::from_bits(scaled::<16>(length.to_bits(), factor.to_bits()))
    }
    fn mass_share(own: I16F16, other: I16F16) -> I2F30 {
        if own == other {
            return I2F30::from_bits(1 << 29);
        }
        let (own, other) = (own.to_bits() as u32, other.to_bits() as u32);
        let both = own + other; // at most 2^30 each
        I2F30::from_bits(quotient((u64::from(other) << 30) + u64::from(both / 2), both) as i32)
    }
    fn over_mass(value: I16F16, mass: I16F16, rate: u32) -> I8F24 {
        let bits = divided(i64::from(value.to_bits()) << 24, i64::from(mass.to_bits()) * i64::from(rate));
        I8F24::from_bits(saturated(bits)).held(Self::FASTEST)
    }

    #[inline]
    fn is_tame(a: Vec2<I8F24>, b: Vec2<I8F24>, impulse: I8F24) -> bool {
        const TAME: i32 = 8 << 24;
        let shifted = |v: I8F24| v.to_bits().wrapping_add(TAME);
        let all = shifted(a.x) | shifted(a.y) | shifted(b.x) | shifted(b.y);
        (all as u32) >> 28 == 0 && (impulse.to_bits() as u32) >> 29 == 0
    }
    #[inline]
    fn is_negligible(change: Vec2<I8F24>) -> bool {
        are_small::<6>(change.x.to_bits(), change.y.to_bits())
    }
    #[inline]
    fn is_nearly_same(a: Vec2<I8F24>, b: Vec2<I8F24>) -> bool {
        // Differences are below 2^32: no other one wraps to a value so close to 0.
        Self::is_negligible(vec2(b.x.wrapping_sub(a.x), b.y.wrapping_sub(a.y)))
    }
    #[inline]
    fn is_at_rest(a: Vec2<I8F24>, b: Vec2<I8F24>) -> bool {
        are_small::<9>(b.x.wrapping_sub(a.x).to_bits(), b.y.wrapping_sub(a.y).to_bits())
    }
    #[inline]
    fn into_frame(vector: Vec2<I8F24>, normal: Vec2<I2F30>) -> Vec2<I8F24> {
        // Two bits to the left, and the upper half of a product with 2^30 is a product with 1.
        let (x, y) = (vector.x.to_bits() << 2, vector.y.to_bits() << 2);
        let (nx, ny) = (normal.x.to_bits(), normal.y.to_bits());
        let along = upper_half(x, nx) + upper_half(y, ny);
        let across = upper_half(y, nx) - upper_half(x, ny);
        vec2(I8F24::from_bits(along), I8F24::from_bits(across))
    }
    #[inline]
    fn out_of_frame(vector: Vec2<I8F24>, normal: Vec2<I2F30>) -> Vec2<I8F24> {
        let (along, across) = (vector.x.to_bits() << 2, vector.y.to_bits() << 2);
        let (nx, ny) = (normal.x.to_bits(), normal.y.to_bits());
        let x = upper_half(along, nx) - upper_half(across, ny);
        let y = upper_half(along, ny) + upper_half(across, nx);
        vec2(I8F24::from_bits(x), I8F24::from_bits(y))
    }
    #[inline]
    fn tame_share(speed: I8F24, share: I2F30) -> I8F24 {
        I8F24::from_bits(upper_half(speed.to_bits() << 1, share.to_bits()) << 1)
    }
    #[inline]
    fn half_speed(speed: I8F24) -> I8F24 {
        I8F24::from_bits(speed.to_bits() >> 1)
    }
    #[inline]
    fn sixteenth(speed: I8F24) -> I8F24 {
        I8F24::from_bits(speed.to_bits() >> 4)
    }
    #[inline]
    fn even_part(speed: I8F24) -> I8F24 {
        let bits = speed.to_bits();
        I8F24::from_bits((bits >> 1) + (bits & i32::from(bits > 0)))
    }
    #[inline]
    fn coulomb(normal: I8F24, friction: u16) -> I8F24 {
        I8F24::from_bits((product_high(normal.to_bits() as u32, u32::from(friction) << 16) << 1) as i32)
    }
    #[inline]
    fn over_slope(speed: I8F24, slope: I2F30) -> I8F24 {
        // 1 / s in Q29 by 48/17 - 32/17 s, which is at most 1/17 too low, and two steps of Newton's iteration y <- y (2 - s y).
        const C0: i32 = 1_515_870_810; // 48/17 in Q29
        const C1: i32 = 2_021_161_081; // 32/17 in Q30
        let s = slope.to_bits();
        let mut y = C0 - (upper_half(s, C1) << 1);
        for _ in 0..2 {
            let factor = (1 << 28) - upper_half(s, y); // 2 - s y in Q27
            y = upper_half(y, factor) << 5;
        }
        let speed = speed.to_bits();
        I8F24::from_bits(if speed.wrapping_add(1 << 28) as u32 >> 29 == 0 {
            upper_half(speed << 3, y) // nearly always
        } else {
            saturated(product(speed, y) >> 29)
        })
    }
    fn over_share(speed: I8F24, share: I2F30) -> I8F24 {
        let (speed, share) = (speed.to_bits(), share.to_bits() as u32);
        let magnitude = quotient((u64::from(speed.unsigned_abs()) << 30) + u64::from(share / 2), share);
        let magnitude = magnitude.min(i32::MAX as u32) as i32;
        I8F24::from_bits(if speed < 0 { -magnitude } else { magnitude })
    }
    fn fallen(speed: I8F24, acceleration: I8F24, distance: I8F24) -> I8F24 {
        let squared =
            product(speed.to_bits(), speed.to_bits()) + 2 * product(acceleration.to_bits(), distance.to_bits());
        if squared <= 0 {
            return I8F24::ZERO;
        }
        let (t, up) = normalized(squared as u64);
        let root = product_high(t, reciprocal_sqrt(t)); // sqrt(t) in Q30
        I8F24::from_bits(saturated((i64::from(root) << 2) >> up))
    }
    #[inline]
    fn per_step(length: I16F16) -> I8F24 {
        const LONGEST: i32 = 100 << 16;
        I8F24::from_bits(length.to_bits().clamp(-LONGEST, LONGEST) << 8)
    }
    #[inline]
    fn in_a_step(speed: I8F24) -> I16F16 {
        I16F16::from_bits(speed.to_bits() >> 8)
    }
    #[inline]
    fn unit_ratio(numerator: i8, denominator: i8) -> I2F30 {
        I2F30::from_bits((i32::from(numerator) << 23) / i32::from(denominator) * 128)
    }
    fn unit_from_number(number: u32) -> I2F30 {
        I2F30::from_bits(number as i32)
    }
    fn number_of(unit: I2F30) -> u32 {
        unit.to_bits() as u32
    }
    #[inline]
    fn area(a: I16F16, b: I16F16) -> i64 {
        product(a.to_bits(), b.to_bits())
    }
    #[inline]
    fn mean(a: I8F24, b: I8F24) -> I8F24 {
        let (a, b) = (a.to_bits(), b.to_bits());
        I8F24::from_bits((a & b) + ((a ^ b) >> 1)) // the sum may not fit
    }
    fn per_speed(part: I8F24, whole: I8F24) -> I2F30 {
        I2F30::from_bits(quotient((part.to_bits() as u64) << 30, whole.to_bits() as u32) as i32)
    }
    fn cut(rest: I2F30) -> i16 {
        i16::MAX - (product(rest.to_bits(), i32::from(i16::MAX)) >> 30) as i16
    }
    fn uncut(motion: I8F24, cut: i16) -> I8F24 {
        let (whole, rest) = (i16::MAX as u32, i16::MAX.abs_diff(cut));
        let magnitude = quotient(u64::from(motion.to_bits().unsigned_abs()) * u64::from(rest), whole) as i32;
        I8F24::from_bits(if motion.to_bits() < 0 { magnitude.wrapping_neg() } else { magnitude })
    }
    fn capped(velocity: Vec2<I8F24>, cap: I8F24) -> Vec2<I8F24> {
        let halved = velocity.map(|v| I16F16::from_bits(v.to_bits() >> 1));
        let Some((direction, speed)) = direction::<Self>(halved) else {
            return velocity;
        };
        // Twice that speed in Q23 is the speed in Q24.
        if i64::from(speed.to_bits()) * 2 <= i64::from(cap.to_bits()) {
            return velocity;
        }
        direction.map(|n| Self::speed_times(cap, n))
    }
    #[inline]
    fn pushes(count: i32) -> I8F24 {
        I8F24::from_bits(count << 12)
    }
    #[inline]
    fn whole_pushes(length: I8F24) -> i16 {
        (length.to_bits().clamp(-(4 << 24), 4 << 24) / 4096) as i16
    }
    fn in_65536ths(value: I16F16) -> i64 {
        value.to_bits().into()
    }
    fn coefficient(value: I16F16) -> u16 {
        (value.to_bits() >> 1) as u16
    }

    #[inline]
    fn within(offset: Vec2<I16F16>, radius: I16F16) -> bool {
        let (x, y, r) = (offset.x.to_bits(), offset.y.to_bits(), radius.to_bits());
        // Up to 2^62 each: the sum fits an unsigned word.
        (product(x, x) as u64) + (product(y, y) as u64) <= product(r, r) as u64
    }
    #[inline(always)] // a call and its saves would cost a third of it
    fn direction(offset: Vec2<I16F16>) -> Option<(Vec2<I2F30>, I16F16)> {
        let (x, y) = (offset.x.to_bits(), offset.y.to_bits());
        let squared = (product(x, x) + product(y, y)) as u64;
        if squared == 0 {
            return None;
        }
        let (t, up) = normalized(squared);
        let reciprocal = reciprocal_sqrt(t);
        // No side is longer than the vector, which the shift brings below 2^32. Magnitudes, so that mirrored sides stay so.
        let scaled = |side: i32| {
            let magnitude = product_high(side.unsigned_abs() << up, reciprocal) as i32;
            I2F30::from_bits(if side < 0 { -magnitude } else { magnitude })
        };
        let length = product_high(t, reciprocal); // sqrt(t) in Q30
        let length =
            if up > 2 { (((length >> (up - 3)) + 1) >> 1) as i32 } else { saturated(i64::from(length) << (2 - up)) };
        Some((vec2(scaled(x), scaled(y)), I16F16::from_bits(length)))
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
