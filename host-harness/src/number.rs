//! What the raw bits of a state mean, as `f64`: exact for every number format.

use flat_wire::message::ScalarKind;

/// The unit of a raw number; fixed point stores each with its own resolution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// px, Q16.16.
    Length,
    /// px per step, Q8.24.
    Speed,
    /// Component of a unit vector, Q2.30.
    Direction,
}

/// Decodes one number.
pub fn decode(scalar: ScalarKind, quantity: Quantity, bits: i64) -> f64 {
    match scalar {
        ScalarKind::Fixed => {
            let fraction_bits = match quantity {
                Quantity::Length => 16,
                Quantity::Speed => 24,
                Quantity::Direction => 30,
            };
            bits as f64 / f64::from(1 << fraction_bits)
        }
        ScalarKind::F32 => f64::from(f32::from_bits(bits as u32)),
        ScalarKind::F64 => f64::from_bits(bits.cast_unsigned()),
    }
}

/// The bits as they are written in reports, as wide as the format stores them.
pub fn hexadecimal(scalar: ScalarKind, bits: i64) -> String {
    match scalar {
        ScalarKind::Fixed | ScalarKind::F32 => format!("0x{:08x}", bits as u32),
        ScalarKind::F64 => format!("0x{bits:016x}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(clippy::float_cmp)] // the conversions are exact
    fn every_format_decodes_to_the_value_that_it_stores() {
        assert_eq!(decode(ScalarKind::Fixed, Quantity::Length, -3 << 15), -1.5);
        assert_eq!(decode(ScalarKind::Fixed, Quantity::Speed, 1 << 23), 0.5);
        assert_eq!(decode(ScalarKind::Fixed, Quantity::Direction, -(1 << 30)), -1.0);
        assert_eq!(decode(ScalarKind::F32, Quantity::Speed, i64::from((-0.1f32).to_bits())), f64::from(-0.1f32));
        assert_eq!(decode(ScalarKind::F64, Quantity::Length, (-0.1f64).to_bits().cast_signed()), -0.1);
    }

    #[test]
    fn negative_numbers_keep_their_stored_width_in_hexadecimal() {
        assert_eq!(hexadecimal(ScalarKind::Fixed, -1), "0xffffffff");
        assert_eq!(hexadecimal(ScalarKind::F64, -1), "0xffffffffffffffff");
    }
}
