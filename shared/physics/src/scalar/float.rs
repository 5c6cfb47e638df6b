//! IEEE 754 numbers. Only +, -, *, / and sqrt are used, which round the same everywhere: equal bits on every chip.

use ::fixed::types::I16F16;

use super::{Quantity, SPEED_LIMIT, STEP_HZ, Scalar};
use crate::vec2::{Vec2, vec2};

macro_rules! float_scalar {
    ($float:ident, $sqrt:path, $name:literal) => {
        impl Quantity for $float {
            const ZERO: Self = 0.0;
            #[inline]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline]
            fn saturating_add(self, other: Self) -> Self {
                self + other
            }
            #[inline]
            fn saturating_sub(self, other: Self) -> Self {
                self - other
            }
            fn bits(self) -> i64 {
                self.to_bits() as i64
            }
        }

        impl Scalar for $float {
            type Real = $float;
            type Speed = $float;
            type Unit = $float;
            type Area = $float;

            const NAME: &'static str = $name;
            const ONE: $float = 1.0;
            const UNIT: $float = 1.0;
            const FASTEST: $float = SPEED_LIMIT as $float;

            const MOST_IMPULSE: $float = SPEED_LIMIT as $float;

            fn real(value: I16F16) -> $float {
                value.to_bits() as $float / 65_536.0
            }
            fn is_finite(value: $float) -> bool {
                value.is_finite()
            }
            fn speed(px_per_second: $float) -> $float {
                (px_per_second / STEP_HZ as $float).held(Self::FASTEST)
            }
            fn px_per_second(speed: $float) -> $float {
                speed * STEP_HZ as $float
            }
            fn speed_from_bits(bits: i64) -> $float {
                $float::from_bits(bits as _)
            }
            fn acceleration(px_per_second2: $float) -> $float {
                px_per_second2 / (STEP_HZ * STEP_HZ) as $float
            }

            #[inline]
            fn advance(position: $float, _remainder: &mut i16, velocity: $float) -> $float {
                position + velocity
            }
            fn creep(motion: Vec2<$float>) -> u16 {
                ((motion.x.abs().max(motion.y.abs()) * 16_384.0) as u16).saturating_add(1)
            }
            #[inline]
            fn speed_along(velocity: Vec2<$float>, direction: Vec2<$float>) -> $float {
                velocity.x * direction.x + velocity.y * direction.y
            }
            #[inline]
            fn speed_times(speed: $float, factor: $float) -> $float {
                speed * factor
            }
            #[inline]
            fn speed_scaled(speed: $float, factor: $float) -> $float {
                speed * factor
            }
            #[inline]
            fn length_times(length: $float, factor: $float) -> $float {
                length * factor
            }
            #[inline]
            fn length_scaled(length: $float, factor: $float) -> $float {
                length * factor
            }
            #[inline]
            fn mass_share(own: $float, other: $float) -> $float {
                other / (own + other)
            }
            fn over_mass(value: $float, mass: $float, rate: u32) -> $float {
                (value / (mass * rate as $float)).held(Self::FASTEST)
            }

            #[inline]
            fn is_tame(_a: Vec2<$float>, _b: Vec2<$float>, _impulse: $float) -> bool {
                true
            }
            #[inline]
            fn is_negligible(change: Vec2<$float>) -> bool {
                const LEAST: $float = 1.0 / 262_144.0;
                change.x.abs() < LEAST && change.y.abs() < LEAST
            }
            #[inline]
            fn is_nearly_same(a: Vec2<$float>, b: Vec2<$float>) -> bool {
                Self::is_negligible(b - a)
            }
            fn into_frame(vector: Vec2<$float>, normal: Vec2<$float>) -> Vec2<$float> {
                vec2(vector.x * normal.x + vector.y * normal.y, vector.y * normal.x - vector.x * normal.y)
            }
            #[inline]
            fn is_at_rest(a: Vec2<$float>, b: Vec2<$float>) -> bool {
                const LEAST: $float = 1.0 / 32_768.0;
                let apart = b - a;
                apart.x.abs() <= LEAST && apart.y.abs() <= LEAST
            }
            #[inline]
            fn out_of_frame(vector: Vec2<$float>, normal: Vec2<$float>) -> Vec2<$float> {
                vec2(vector.x * normal.x - vector.y * normal.y, vector.x * normal.y + vector.y * normal.x)
            }
            #[inline]
            fn tame_share(speed: $float, share: $float) -> $float {
                speed * share
            }
            #[inline]
            fn half_speed(speed: $float) -> $float {
                speed * 0.5
            }
            #[inline]
            fn sixteenth(speed: $float) -> $float {
                speed * 0.0625
            }
            #[inline]
            fn even_part(speed: $float) -> $float {
                speed * 0.5
            }
            #[inline]
            fn coulomb(normal: $float, friction: u16) -> $float {
                normal * (<$float>::from(friction) * (1.0 / 32_768.0))
            }
            #[inline]
            fn over_slope(speed: $float, slope: $float) -> $float {
                speed / slope
            }
            fn over_share(speed: $float, share: $float) -> $float {
                speed / share
            }
            fn fallen(speed: $float, acceleration: $float, distance: $float) -> $float {
                $sqrt((speed * speed + 2.0 * acceleration * distance).greater(0.0))
            }
            #[inline]
            fn per_step(length: $float) -> $float {
                length.held(100.0)
            }
            #[inline]
            fn in_a_step(speed: $float) -> $float {
                speed
            }
            #[inline]
            fn unit_ratio(numerator: i8, denominator: i8) -> $float {
                <$float>::from(numerator) / <$float>::from(denominator)
            }
            fn unit_from_number(number: u32) -> $float {
                number as $float
            }
            fn number_of(unit: $float) -> u32 {
                unit as u32
            }
            #[inline]
            fn area(a: $float, b: $float) -> $float {
                a * b
            }
            #[inline]
            fn mean(a: $float, b: $float) -> $float {
                (a + b) * 0.5
            }
            fn per_speed(part: $float, whole: $float) -> $float {
                part / whole
            }
            fn cut(rest: $float) -> i16 {
                let whole = i16::MAX as $float;
                i16::MAX - (rest * whole) as i16
            }
            fn uncut(motion: $float, cut: i16) -> $float {
                motion * ((i16::MAX - cut) as $float / i16::MAX as $float)
            }
            fn capped(velocity: Vec2<$float>, cap: $float) -> Vec2<$float> {
                let speed = $sqrt(velocity.x * velocity.x + velocity.y * velocity.y);
                if speed <= cap { velocity } else { velocity.map(|v| v / speed * cap) }
            }
            #[inline]
            fn pushes(count: i32) -> $float {
                count as $float / 4096.0
            }
            #[inline]
            fn whole_pushes(length: $float) -> i16 {
                (length.held(4.0) * 4096.0) as i16
            }
            fn in_65536ths(value: $float) -> i64 {
                (value * 65_536.0) as i64
            }
            fn coefficient(value: $float) -> u16 {
                (value * 32_768.0) as u16
            }

            #[inline]
            fn within(offset: Vec2<$float>, radius: $float) -> bool {
                offset.x * offset.x + offset.y * offset.y <= radius * radius
            }
            #[inline]
            fn direction(offset: Vec2<$float>) -> Option<(Vec2<$float>, $float)> {
                let length = $sqrt(offset.x * offset.x + offset.y * offset.y);
                // Offsets too short to square have no direction that could be trusted.
                if length < $float::MIN_POSITIVE {
                    return None;
                }
                Some((vec2(offset.x / length, offset.y / length), length))
            }
            #[inline]
            fn half(length: $float) -> $float {
                length * 0.5
            }
            #[inline]
            fn floor(length: $float) -> i32 {
                let whole = length as i32;
                whole - i32::from(length < whole as $float)
            }
        }
    };
}

float_scalar!(f32, libm::sqrtf, "f32");
float_scalar!(f64, libm::sqrt, "f64");
