//! Every fixed-point routine against f64, over its whole range.

use fixed::types::{I2F30, I8F24, I16F16};
use flat_physics::scalar::{EXTENT_LIMIT, Exact, Fixed, POSITION_LIMIT, SPEED_LIMIT, Scalar};
use flat_physics::{Vec2, vec2};
use proptest::prelude::*;

const LENGTH: f64 = 65_536.0;
const SPEED: f64 = 16_777_216.0;
const UNIT: f64 = 1_073_741_824.0;
/// Error of a direction in units of the last place, 6e-9 of its length: what Newton's iteration in Q28 leaves.
const TOLERANCE: f64 = 6.0;
/// Half a unit of the last place, and a hair for f64's own rounding.
const HALF: f64 = 0.5 + 1e-6;

fn real(bits: i32) -> I16F16 {
    I16F16::from_bits(bits)
}
fn speed(bits: i32) -> I8F24 {
    I8F24::from_bits(bits)
}
fn unit(bits: i32) -> I2F30 {
    I2F30::from_bits(bits)
}

/// Any value, with the ends and the neighbourhood of 0 as likely as all the rest.
fn bits(limit: i32) -> impl Strategy<Value = i32> {
    prop_oneof![-limit..=limit, -300..=300, Just(limit), Just(-limit), (0u32..31).prop_map(move |shift| limit >> shift)]
}

/// The result in units of its last place, and what it should be.
fn assert_near(got: i32, exact: f64, tolerance: f64) -> Result<(), TestCaseError> {
    let held = exact.clamp(-f64::from(i32::MAX), f64::from(i32::MAX));
    prop_assert!((f64::from(got) - held).abs() <= tolerance, "got {got}, exact {exact}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100_000))]

    #[test]
    fn products_round_to_nearest_and_saturate(a in bits(i32::MAX), b in bits(i32::MAX), u in bits(1 << 30)) {
        let (fa, fb, fu) = (f64::from(a), f64::from(b), f64::from(u));
        assert_near(Fixed::speed_times(speed(a), unit(u)).to_bits(), fa * fu / UNIT, HALF)?;
        assert_near(Fixed::length_times(real(a), unit(u)).to_bits(), fa * fu / UNIT, HALF)?;
        assert_near(Fixed::speed_scaled(speed(a), real(b)).to_bits(), fa * fb / LENGTH, HALF)?;
        assert_near(Fixed::length_scaled(real(a), real(b)).to_bits(), fa * fb / LENGTH, HALF)?;
    }

    #[test]
    fn products_are_mirror_symmetric(a in bits(i32::MAX), b in bits(i32::MAX), u in bits(1 << 30)) {
        prop_assert_eq!(Fixed::speed_times(speed(-a), unit(u)), -Fixed::speed_times(speed(a), unit(u)));
        prop_assert_eq!(Fixed::speed_scaled(speed(-a), real(b)), -Fixed::speed_scaled(speed(a), real(b)));
        prop_assert_eq!(Fixed::length_scaled(real(-a), real(b)), -Fixed::length_scaled(real(a), real(b)));
    }

    #[test]
    fn the_speed_along_a_direction_is_the_scalar_product(vx in bits(i32::MAX), vy in bits(i32::MAX), angle in 0.0..6.3f64) {
        let n = vec2(unit((angle.cos() * UNIT) as i32), unit((angle.sin() * UNIT) as i32));
        let exact = (f64::from(vx) * f64::from(n.x.to_bits()) + f64::from(vy) * f64::from(n.y.to_bits())) / UNIT;
        assert_near(Fixed::speed_along(vec2(speed(vx), speed(vy)), n).to_bits(), exact, HALF)?;
    }

    #[test]
    fn a_direction_has_length_1_and_the_distance_is_right(
        x in bits(i32::from(EXTENT_LIMIT) << 17), y in bits(i32::from(EXTENT_LIMIT) << 17),
    ) {
        let Some((n, length)) = Fixed::direction(vec2(real(x), real(y))) else {
            prop_assert_eq!((x, y), (0, 0));
            return Ok(());
        };
        let exact = f64::from(x).hypot(f64::from(y));
        assert_near(n.x.to_bits(), f64::from(x) / exact * UNIT, TOLERANCE)?;
        assert_near(n.y.to_bits(), f64::from(y) / exact * UNIT, TOLERANCE)?;
        assert_near(length.to_bits(), exact, 0.5 + exact * TOLERANCE / UNIT)?;
        let mirrored = Fixed::direction(vec2(real(-x), real(-y)));
        prop_assert_eq!(mirrored, Some((vec2(-n.x, -n.y), length)));
    }

    #[test]
    fn within_is_exact(x in bits(i32::MAX), y in bits(i32::MAX), r in 0..i32::MAX, nudge in -1..=1i64) {
        let wide = |n: i32| i128::from(n) * i128::from(n);
        prop_assert_eq!(Fixed::within(vec2(real(x), real(y)), real(r)), wide(x) + wide(y) <= wide(r));
        // Also where it is close.
        let close = ((wide(x) + wide(y)) as u128).isqrt() as i64 + nudge;
        if let Ok(r) = i32::try_from(close) && r >= 0 {
            prop_assert_eq!(Fixed::within(vec2(real(x), real(y)), real(r)), wide(x) + wide(y) <= wide(r));
        }
    }

    #[test]
    fn masses_share_an_impulse(a in 1..=16_384i32 << 16, b in 1..=16_384i32 << 16) {
        let (own, other) = (real(a), real(b));
        let exact = f64::from(b) / (f64::from(a) + f64::from(b)) * UNIT;
        assert_near(Fixed::mass_share(own, other).to_bits(), exact, HALF)?;
    }

    #[test]
    fn quotients_are_exact(v in bits(i32::MAX), whole in 1..=i32::MAX, small in bits(i32::MAX), cut in 0..=i16::MAX) {
        let (motion, rest) = (i64::from(v), i64::from(i16::MAX - cut));
        prop_assert_eq!(i64::from(Fixed::uncut(speed(v), cut).to_bits()), motion * rest / i64::from(i16::MAX));
        for whole in [whole, small.abs().max(1)] {
            let part = v.unsigned_abs() % whole.unsigned_abs();
            let exact = (u64::from(part) << 30) / u64::from(whole.unsigned_abs());
            prop_assert_eq!(u64::from(real(part as i32).fraction_of(real(whole)).to_bits().unsigned_abs()), exact);
            let share = whole.min(1 << 30);
            assert_near(Fixed::over_share(speed(v), unit(share)).to_bits(), f64::from(v) * UNIT / f64::from(share), HALF)?;
        }
    }

    #[test]
    fn units_convert_there_and_back(v in bits(7620 << 16), g in bits(8000 << 16)) {
        assert_near(Fixed::speed(real(v)).to_bits(), f64::from(v) / LENGTH / 60.0 * SPEED, HALF)?;
        assert_near(Fixed::px_per_second(Fixed::speed(real(v))).to_bits(), f64::from(v), 1.0)?;
        assert_near(Fixed::acceleration(real(g)).to_bits(), f64::from(g) / LENGTH / 3600.0 * SPEED, HALF)?;
    }

    #[test]
    fn motion_loses_nothing_to_rounding(
        start in bits(i32::from(POSITION_LIMIT) << 15),
        velocities in prop::collection::vec(bits(i32::from(SPEED_LIMIT) << 24), 1..40),
    ) {
        let (mut position, mut remainder, mut sum) = (real(start), 0, 0i64);
        let (mut mirror, mut mirror_remainder) = (real(-start), 0);
        for v in velocities {
            position = Fixed::advance(position, &mut remainder, speed(v));
            mirror = Fixed::advance(mirror, &mut mirror_remainder, speed(-v));
            sum += i64::from(v);
            let exact = i64::from(start) * 256 + sum;
            prop_assert_eq!(i64::from(position.to_bits()) * 256 + i64::from(remainder), exact);
            prop_assert!(remainder.abs() < 256);
            prop_assert_eq!((mirror, mirror_remainder), (-position, -remainder));
        }
    }

    #[test]
    fn whole_px_round_down(x in bits(i32::MAX)) {
        let exact = (f64::from(x) / LENGTH).floor() as i32;
        prop_assert_eq!(Fixed::floor(real(x)), exact);
        prop_assert_eq!(<f64 as Scalar>::floor(f64::from(x) / LENGTH), exact);
        prop_assert_eq!(<f32 as Scalar>::floor(x as f32 / 65_536.0), (x as f32 / 65_536.0).floor() as i32);
    }
}

#[test]
fn a_constant_velocity_is_kept_for_an_hour_in_both_directions() {
    let v = Fixed::speed(I16F16::from_num(1));
    let (mut position, mut remainder): (I16F16, i16) = (I16F16::ZERO, 0);
    let (mut back, mut back_remainder): (I16F16, i16) = (I16F16::ZERO, 0);
    for _ in 0..60 * 3600 {
        position = Fixed::advance(position, &mut remainder, v);
        back = Fixed::advance(back, &mut back_remainder, -v);
    }
    let error = (position.to_num::<f64>() / 3600.0 - 1.0).abs();
    assert!(error <= 2e-4, "off by {error}");
    assert_eq!(back, -position);
}

#[test]
fn floats_have_no_direction_where_squares_vanish() {
    let tiny: Vec2<f32> = vec2(1e-30, 1e-30);
    assert_eq!(f32::direction(tiny), None);
    assert_eq!(f32::direction(vec2(3.0, 4.0)), Some((vec2(0.6, 0.8), 5.0)));
}
