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

            const NAME: &'static str = $name;
            const ONE: $float = 1.0;
            const UNIT: $float = 1.0;
            const FASTEST: $float = SPEED_LIMIT as $float;

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
