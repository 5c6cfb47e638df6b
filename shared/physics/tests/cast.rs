//! Swept tests against closed formulas in f64, over the whole range: nothing is missed and nobody ends inside anybody.

use fixed::types::{I2F30, I16F16};
use flat_physics::geometry::{Hit, Outline, cast, overlaps, part, penetration, ray, touches};
use flat_physics::scalar::{Exact, px};
use flat_physics::{Fixed, Quantity, Scalar, Vec2, vec2};
use proptest::prelude::*;

type Place = [f64; 2];

/// The sum of two shapes around the second one's centre, in units of the last place of fixed point.
struct Sum {
    centre: Place,
    rect: Place,
    round: f64,
}

impl Sum {
    fn of(first: &Outline<Fixed>, second: &Outline<Fixed>) -> Self {
        let mut sum = Self { centre: [0.0; 2], rect: [0.0; 2], round: 0.0 };
        sum.centre = [0, 1].map(|axis| bits(second.centre)[axis] - bits(first.centre)[axis]);
        for outline in [first, second] {
            let half = bits(outline.half);
            if outline.circle {
                sum.round += half[0];
            } else {
                sum.rect = [sum.rect[0] + half[0], sum.rect[1] + half[1]];
            }
        }
        sum
    }

    /// Distance of a point from the sum; below 0 inside.
    fn distance(&self, point: Place) -> f64 {
        let beyond = [0, 1].map(|axis| (point[axis] - self.centre[axis]).abs() - self.rect[axis]);
        let outside = beyond.map(|b| b.max(0.0));
        let inside = beyond[0].max(beyond[1]).min(0.0);
        outside[0].hypot(outside[1]) + inside - self.round
    }

    /// When a point that starts at 0 and makes `motion` enters the sum, which is the union of two rectangles and four discs.
    fn entry(&self, motion: Place) -> Option<f64> {
        let (rect, round) = (self.rect, self.round);
        let mut entries = vec![
            slab(self.centre, [rect[0] + round, rect[1]], motion),
            slab(self.centre, [rect[0], rect[1] + round], motion),
        ];
        for (sx, sy) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            entries.push(disc([self.centre[0] + sx * rect[0], self.centre[1] + sy * rect[1]], round, motion));
        }
        entries.into_iter().flatten().reduce(f64::min)
    }

    /// How deep the motion gets in.
    fn deepest(&self, motion: Place) -> f64 {
        // The distance from a convex shape is convex along a line: ternary search.
        let at = |t: f64| self.distance([motion[0] * t, motion[1] * t]);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..200 {
            let third = (high - low) / 3.0;
            if at(low + third) < at(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        -at(low).min(at(0.0)).min(at(1.0))
    }
}

fn slab(centre: Place, half: Place, motion: Place) -> Option<f64> {
    let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in [0, 1] {
        if motion[axis] == 0.0 {
            if centre[axis].abs() >= half[axis] {
                return None;
            }
            continue;
        }
        let ends = [-1.0, 1.0].map(|side| (centre[axis] + side * half[axis]) / motion[axis]);
        enter = enter.max(ends[0].min(ends[1]));
        leave = leave.min(ends[0].max(ends[1]));
    }
    (enter < leave && leave > 0.0 && enter < 1.0).then_some(enter.max(0.0))
}

fn disc(centre: Place, radius: f64, motion: Place) -> Option<f64> {
    let (a, b) = (motion[0].powi(2) + motion[1].powi(2), centre[0] * motion[0] + centre[1] * motion[1]);
    let aside = (centre[0] * motion[1] - centre[1] * motion[0]).powi(2) / a;
    let root = (radius * radius - aside).max(0.0) * a;
    let (enter, leave) = ((b - root.sqrt()) / a, (b + root.sqrt()) / a);
    (root > 0.0 && leave > 0.0 && enter < 1.0).then_some(enter.max(0.0))
}

fn bits(v: Vec2<I16F16>) -> Place {
    [f64::from(v.x.to_bits()), f64::from(v.y.to_bits())]
}

fn real(x: i64, y: i64) -> Vec2<I16F16> {
    let held = |bits: i64| I16F16::from_bits(bits.clamp(-i64::from(i32::MAX), i64::from(i32::MAX)) as i32);
    vec2(held(x), held(y))
}

const WORLD: i64 = 16_384 << 16;
const EXTENT: i64 = 4_096 << 16;

/// A length of any order of magnitude, at least 1.
fn length(most: i64) -> impl Strategy<Value = i64> {
    (1..=most, 0u32..30).prop_map(|(bits, shift)| (bits >> shift).max(1))
}

fn signed(most: i64) -> impl Strategy<Value = i64> {
    (length(most), -1..=1i64).prop_map(|(length, sign)| length * sign)
}

prop_compose! {
    fn outline()(x in signed(WORLD), y in signed(WORLD), w in length(EXTENT), h in length(EXTENT), kind in 0..4u8) -> Outline<Fixed> {
        let half = match kind {
            0 => real(0, 0),
            1 => real(w, h),
            _ => real(w, w),
        };
        Outline { centre: real(x, y), half, circle: kind >= 2 }
    }
}

prop_compose! {
    /// Two shapes, and a motion towards a point near the second one's edge: most meet, many graze, some start in touch.
    fn flight()(
        first in outline(), second in outline(),
        way in (signed(WORLD), signed(WORLD)), close in prop::option::of((signed(1 << 20), signed(1 << 20))),
        aside in (-2..=2i64, -2..=2i64, signed(1 << 18), signed(1 << 18)), stretch in 0..=48i64,
    ) -> (Outline<Fixed>, Vec2<I16F16>, Outline<Fixed>) {
        let target = Outline { half: if second.half == real(0, 0) { real(1, 1) } else { second.half }, ..second };
        let reach = [first.half.x + target.half.x, first.half.y + target.half.y].map(|sum| i64::from(sum.to_bits()));
        let at = |centre: I16F16, offset: i64| (i64::from(centre.to_bits()) + offset).clamp(-WORLD, WORLD);
        let start = match close {
            // Close to the edge, from either side.
            Some((x, y)) => real(at(target.centre.x, reach[0] * way.0.signum() + x), at(target.centre.y, reach[1] * way.1.signum() + y)),
            None => real(at(target.centre.x, way.0), at(target.centre.y, way.1)),
        };
        let aim = |centre: I16F16, start: I16F16, side: i64, reach: i64, off: i64| {
            (i64::from(centre.to_bits()) + side * reach / 2 + off - i64::from(start.to_bits())) * stretch / 16
        };
        let motion = real(
            aim(target.centre.x, start.x, aside.0, reach[0], aside.2),
            aim(target.centre.y, start.y, aside.1, reach[1], aside.3),
        );
        (first.at(start), motion, target)
    }
}

/// The centre after the free part of a motion, and what its rounding may cost.
fn end(motion: Vec2<I16F16>, hit: &Hit<Fixed>) -> (Place, f64) {
    let length = bits(motion)[0].hypot(bits(motion)[1]);
    (bits(part::<Fixed>(motion, hit.time)), 3.0 + 2.0 * length / f64::from(1 << 30))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100_000))]

    #[test]
    fn a_sweep_ends_in_touch_with_what_it_first_meets((mover, motion, target) in flight()) {
        let sum = Sum::of(&mover, &target);
        let (start, entry) = (sum.distance([0.0, 0.0]), sum.entry(bits(motion)));
        let Some(hit) = cast(&mover, motion, &target) else {
            // What is missed is at most grazed.
            prop_assert!(sum.deepest(bits(motion)) <= 1.001, "entered {} deep at {entry:?}", sum.deepest(bits(motion)));
            return Ok(());
        };
        let normal = [hit.normal.x, hit.normal.y].map(|n| n.to_num::<f64>());
        prop_assert!((normal[0].hypot(normal[1]) - 1.0).abs() < 2e-8, "normal {normal:?}");
        if hit.depth > px(0) {
            prop_assert_eq!(hit.time.to_bits(), 0);
            prop_assert!(start < 0.0 && (f64::from(hit.depth.to_bits()) + start).abs() <= 1.0 + sum.round * 1e-8, "depth {}, start {start}", hit.depth);
            return Ok(());
        }
        prop_assert!(start >= -1.0, "starts {start} deep");
        prop_assert!(sum.deepest(bits(motion)) > -1.0, "met from {} away", -sum.deepest(bits(motion)));
        let (place, rounding) = end(motion, &hit);
        let distance = sum.distance(place);
        prop_assert!((-1.0..=rounding).contains(&distance), "ends {distance} away, rounding {rounding}");
        // Nothing was entered on the way.
        let on_the_way = sum.deepest(place);
        prop_assert!(on_the_way <= 1.001, "passes {on_the_way} deep");
        // The normal leads away from the target, against the motion.
        let further = [place[0] + normal[0] * 64.0, place[1] + normal[1] * 64.0];
        prop_assert!((sum.distance(further) - distance - 64.0).abs() < 0.01 || sum.round < 64.0, "normal {normal:?}");
        let against = normal[0] * bits(motion)[0] + normal[1] * bits(motion)[1];
        // A place that is off by its rounding turns the normal of a round shape.
        let turn = if sum.round > 0.0 { 2.0 * rounding / sum.round } else { 0.0 };
        let length = bits(motion)[0].hypot(bits(motion)[1]);
        prop_assert!(against <= length * turn + 1.0, "normal {normal:?} along the motion by {against}");
    }
}

/// Any length, with the ends and the neighbourhood of 0 as likely as all the rest.
fn any_length() -> impl Strategy<Value = i32> {
    prop_oneof![
        -i32::MAX..=i32::MAX,
        -300..=300,
        Just(i32::MAX),
        Just(-i32::MAX),
        (0u32..31).prop_map(|n| i32::MAX >> n)
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100_000))]

    #[test]
    fn comparisons_are_exact_and_fractions_rounded_down(
        a in any_length(), b in any_length(), c in any_length(), d in any_length(), nudge in -1..=1i128,
    ) {
        let ([ra, rb, rc, rd], [wa, wb, wc, wd]) = ([a, b, c, d].map(I16F16::from_bits), [a, b, c, d].map(i128::from));
        prop_assert_eq!(I16F16::product_less(ra, rb, rc, rd), wa * wb < wc * wd);
        let squared = wa * wa + wb * wb;
        prop_assert_eq!(I16F16::shorter(vec2(ra, rb), rc), squared < wc * wc);
        if let Ok(close) = i32::try_from(squared.isqrt() + nudge) && close >= 0 {
            let radius = I16F16::from_bits(close);
            prop_assert_eq!(I16F16::shorter(vec2(ra, rb), radius), squared < i128::from(close).pow(2));
        }
        let (part, whole) = (wa.abs().min(wb.abs()), wa.abs().max(wb.abs()));
        if part < whole {
            let fraction: I2F30 = ra.abs().lesser(rb.abs()).fraction_of(ra.abs().greater(rb.abs()));
            prop_assert_eq!(i128::from(fraction.to_bits()), (part << 30) / whole);
        }
    }

    #[test]
    fn an_approach_is_noticed_exactly_and_timed_to_the_last_places(
        x in any_length(), y in any_length(), mx in any_length(), my in any_length(), r in 1..=16_384i32 << 16, nudge in -1..=1i128,
    ) {
        let [wx, wy, wmx, wmy] = [x, y, mx, my].map(i128::from);
        let (ahead, length2, aside) = (wx * wmx + wy * wmy, wmx * wmx + wmy * wmy, wx * wmy - wy * wmx);
        // Any radius, and the one that the motion just grazes.
        let grazing = if length2 > 0 { (aside * aside / length2).isqrt() + nudge } else { 0 };
        for radius in [i128::from(r), grazing.clamp(1, 1 << 30)] {
            let real = |bits: i32| I16F16::from_bits(bits);
            let got = I16F16::approach(vec2(real(x), real(y)), vec2(real(mx), real(my)), real(radius as i32));
            let end = [wx - wmx, wy - wmy].map(|gap| gap.clamp(i128::from(i32::MIN), i128::from(i32::MAX)));
            let comes = if ahead <= 0 {
                false
            } else if ahead >= length2 {
                end[0] * end[0] + end[1] * end[1] < radius * radius
            } else {
                aside * aside < radius * radius * length2
            };
            prop_assert_eq!(got.is_some(), comes);
            if let Some(time) = got {
                // f64 has the root to 53 bits; the time may be early by what moves the point by one unit, or by one of its own.
                let root = ((radius * radius * length2 - aside * aside) as f64).sqrt();
                let exact = ((ahead as f64 - root) / length2 as f64).max(0.0);
                let early = exact - time.to_num::<f64>();
                let unit = 2.0 / (length2 as f64).sqrt() + 2.0_f64.powi(-29);
                prop_assert!((-1e-9..unit).contains(&early), "{} instead of {}", time, exact);
            }
        }
    }
}

/// The same outline in another format; exact for all but the last bits of large lengths in `f32`.
fn convert<S: Scalar>(outline: &Outline<Fixed>) -> Outline<S> {
    Outline { centre: outline.centre.map(S::real), half: outline.half.map(S::real), circle: outline.circle }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn overlap_and_touch_are_decided_exactly((first, _, second) in flight()) {
        let distance = Sum::of(&first, &second).distance([0.0, 0.0]);
        // Squares of long lengths are beyond f64.
        if distance.abs() > 1e-3 {
            prop_assert_eq!(overlaps(&first, &second), distance < 0.0, "{} apart", distance);
            prop_assert_eq!(touches(&first, &second), distance < 0.0, "{} apart", distance);
        }
        let Some(way_out) = penetration(&first, &second) else {
            prop_assert!(!overlaps(&first, &second));
            return Ok(());
        };
        let (depth, normal) = (f64::from(way_out.depth.to_bits()), [way_out.normal.x, way_out.normal.y].map(|n| n.to_num::<f64>()));
        let sum = Sum::of(&first, &second);
        let after = sum.distance([normal[0] * depth, normal[1] * depth]);
        prop_assert!(after.abs() <= 1.0 + (sum.round + depth) * 2e-8, "the way out ends {after} away");
    }

    #[test]
    fn mirrored_shapes_meet_at_the_same_time((mover, motion, target) in flight()) {
        let flip = |v: Vec2<I16F16>| vec2(-v.x, v.y);
        let flipped = |outline: &Outline<Fixed>| outline.at(flip(outline.centre));
        let hit = cast(&mover, motion, &target);
        let mirrored = cast(&flipped(&mover), flip(motion), &flipped(&target));
        // What has no horizontal direction of its own keeps its normal: circles and boxes with equal centres.
        prop_assert_eq!(hit.map(|hit| (hit.time, hit.depth)), mirrored.map(|hit| (hit.time, hit.depth)));
    }

    #[test]
    fn a_whole_px_shift_changes_no_bit((mover, motion, target) in flight(), dx in -8000..8000i64, dy in -8000..8000i64) {
        let shifted = |outline: &Outline<Fixed>| {
            let moved = [outline.centre.x, outline.centre.y].map(|c| i64::from(c.to_bits()));
            let (x, y) = (moved[0] + (dx << 16), moved[1] + (dy << 16));
            (x.abs() <= WORLD && y.abs() <= WORLD).then(|| outline.at(real(x, y)))
        };
        if let (Some(m), Some(t)) = (shifted(&mover), shifted(&target)) {
            prop_assert_eq!(cast(&m, motion, &t), cast(&mover, motion, &target));
        }
    }

    #[test]
    fn floats_agree_with_fixed_point((mover, motion, target) in flight()) {
        let fixed = cast(&mover, motion, &target);
        let double = cast(&convert::<f64>(&mover), motion.map(f64::real), &convert::<f64>(&target));
        let sum = Sum::of(&mover, &target);
        let depth = sum.deepest(bits(motion));
        if depth.abs() > 1.0 {
            prop_assert_eq!(fixed.is_some(), double.is_some(), "{} deep", depth);
        }
        if let (Some(fixed), Some(double)) = (fixed, double) {
            let apart = |time: f64| sum.distance([bits(motion)[0] * time, bits(motion)[1] * time]).abs();
            prop_assert!(double.depth > 0.0 || apart(double.time) < 2.1, "f64 ends {} away, fixed {}", apart(double.time), fixed.time);
        }
        let single = cast(&convert::<f32>(&mover), motion.map(f32::real), &convert::<f32>(&target));
        // A few units of f32's last place at the ends of the world.
        let lost = 1024.0;
        if depth.abs() > lost {
            prop_assert_eq!(fixed.is_some(), single.is_some(), "{} deep", depth);
        }
    }
}

#[test]
fn touching_grazing_and_leaving_is_not_meeting() {
    let block = Outline::<Fixed> { centre: vec2(px(0), px(0)), half: vec2(px(10), px(10)), circle: false };
    let ball = Outline { half: vec2(px(5), px(5)), circle: true, ..block };
    let crate_ = Outline { half: vec2(px(5), px(5)), ..block };
    let at = |x: i16, y: i16| vec2(px(x), px(y));
    for mover in [ball, crate_] {
        let start = mover.at(at(0, -15));
        for way in [at(7, 0), at(-30, 0), at(3, -1), at(0, -9), at(0, 0)] {
            assert_eq!(cast(&start, way, &block), None, "{mover:?} {way:?}");
        }
        assert_eq!(cast(&mover.at(at(0, -20)), at(0, 5), &block), None, "touches at the end");
        assert_eq!(cast(&mover.at(at(-40, -15)), at(80, 0), &block), None, "passes in touch");
        let hit = cast(&start, at(0, 1), &block).expect("leads in");
        assert_eq!((hit.time.to_bits(), hit.depth), (0, px(0)));
    }
    // Corner to corner, a box meets the horizontal face; a disc passes where a box would be stopped.
    let hit = cast(&crate_.at(at(-20, -20)), at(10, 10), &block).expect("a corner");
    assert_eq!((hit.normal.x.to_num::<f64>(), hit.normal.y.to_num::<f64>()), (0.0, -1.0));
    assert_eq!(cast(&crate_.at(at(-20, -10)), at(10, -10), &block), None);
    assert_eq!(cast(&ball.at(at(-20, -14)), at(6, 0), &block), None);
    assert!(cast(&crate_.at(at(-20, -14)), at(6, 0), &block).is_some());
}

#[test]
fn a_ray_meets_the_near_side_and_what_it_starts_in() {
    let disc = Outline::<Fixed> { centre: vec2(px(100), px(0)), half: vec2(px(10), px(10)), circle: true };
    let way = vec2(px(200), px(0));
    let hit = ray(vec2(px(0), px(0)), way, &disc).expect("straight at it");
    assert_eq!(part::<Fixed>(way, hit.time), vec2(px(90), px(0)));
    assert_eq!((hit.normal.x.to_num::<f64>(), hit.depth), (-1.0, px(0)));
    let inside = ray(vec2(px(96), px(0)), way, &disc).expect("from within");
    assert_eq!((inside.time.to_bits(), inside.depth, inside.normal.x.to_num::<f64>()), (0, px(6), -1.0));
    assert_eq!(ray(vec2(px(90), px(0)), -way, &disc), None, "away from the edge");
    assert_eq!(ray(vec2(px(0), px(10)), way, &disc), None, "past its top");
}
