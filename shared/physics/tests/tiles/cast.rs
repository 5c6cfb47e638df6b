//! Sweeps through the map: the first hit that an all-tiles search in f64 finds, and no internal edges.

use fixed::types::I16F16;
use flat_physics::geometry::{self, Outline, part};
use flat_physics::scalar::px;
use flat_physics::tiles::{Side, TileFlags, TileHit, TileMap};
use flat_physics::{Fixed, Quantity, Scalar, Vec2, vec2};
use proptest::prelude::*;

use crate::contacts::{Case, SIDES, ball, bits, case, inward, run, square};
use crate::drawing::Drawing;

type Found = Option<TileHit<Fixed>>;

fn way(x: f64, y: f64) -> Vec2<I16F16> {
    vec2(I16F16::from_num(x), I16F16::from_num(y))
}

/// Which tile, with which normal, after how many px of the longer way.
type Told = Option<((u16, u16), (f64, f64), f64)>;

fn told(found: Found, motion: Vec2<I16F16>) -> Told {
    found.map(|TileHit { hit, tile }| {
        let done = part::<Fixed>(motion, hit.time).map(|n| n.to_num::<f64>().abs());
        ((tile.column, tile.row), (hit.normal.x.to_num(), hit.normal.y.to_num()), done.x.max(done.y))
    })
}

fn sketch(rows: &[&str], outline: &Outline<Fixed>, motion: Vec2<I16F16>) -> Told {
    let mut drawing = Drawing::new(rows);
    let map = drawing.map(vec2(0, 0), vec2(16, 16));
    told(map.cast(outline, motion, |_| true), motion)
}

#[test]
fn the_first_tile_in_time_stops_a_shape() {
    let level = ["......", "....#.", "......", "######"];
    assert_eq!(sketch(&level, &square(8.0, 24.0, 6.0), way(300.0, 0.0)), Some(((4, 1), (-1.0, 0.0), 50.0)));
    assert_eq!(sketch(&level, &square(8.0, 24.0, 6.0), way(30.0, 30.0)), Some(((1, 3), (0.0, -1.0), 18.0)));
    assert_eq!(sketch(&level, &ball(90.0, 24.0, 6.0), way(-300.0, 0.0)), Some(((4, 1), (1.0, 0.0), 4.0)));
    assert_eq!(sketch(&level, &square(8.0, 24.0, 6.0), way(49.9, 0.0)), None, "not far enough");
    assert_eq!(sketch(&level, &square(8.0, 24.0, 6.0), way(-999.0, -999.0)), None, "out of the map");
    assert_eq!(sketch(&level, &square(200.0, 300.0, 6.0), way(-140.0, -270.0)), Some(((4, 3), (0.0, 1.0), 230.0)));
}

/// The normal of what a sweep meets, in any number format.
fn normal<S: Scalar>(map: &TileMap<'_>, mover: &Outline<Fixed>, motion: Vec2<I16F16>) -> Option<Vec2<i32>> {
    let real = |v: Vec2<I16F16>| v.map(S::real);
    let mover = Outline::<S> { centre: real(mover.centre), half: real(mover.half), circle: mover.circle };
    let whole = |n: S::Unit| {
        [-1, 0, 1].into_iter().find(|&whole| n == [-S::UNIT, S::Unit::ZERO, S::UNIT][(whole + 1) as usize])
    };
    map.cast(&mover, real(motion), |_| true)
        .map(|found: TileHit<S>| found.hit.normal.map(whole).map(|n| n.unwrap_or(9)))
}

/// What all number formats say alike.
fn normals(map: &TileMap<'_>, mover: &Outline<Fixed>, motion: Vec2<I16F16>) -> Option<Vec2<i32>> {
    let all = [normal::<Fixed>, normal::<f32>, normal::<f64>].map(|normal| normal(map, mover, motion));
    assert!(all[0] == all[1] && all[1] == all[2], "{all:?}: {mover:?} moves by {motion:?}");
    all[0]
}

#[test]
fn along_a_run_of_tiles_nothing_is_met() {
    for side in SIDES {
        let mut run = run(side);
        let map = run.map(vec2(0, 0), vec2(16, 16));
        let row = matches!(side, Side::Top | Side::Bottom);
        let turned = |along: i32, across: i32| if row { bits(along, across) } else { bits(across, along) };
        // Apart, touching, and sunk in as deep as bodies rest.
        for depth in [-1, 0, 1, 2, 40, 1300] {
            let across = match side {
                Side::Left | Side::Top => -(6 << 16) + depth,
                Side::Right | Side::Bottom => (22 << 16) - depth,
            };
            for phase in (0..1 << 16).step_by(6553) {
                for (start, way) in [(20, 15_900), (15_920, -15_900)] {
                    for circle in [false, true] {
                        let centre = turned((start << 16) + phase, across);
                        let mover = Outline::<Fixed> { centre, half: bits(6 << 16, 6 << 16), circle };
                        assert_eq!(normals(&map, &mover, turned(way << 16, 0)), None, "{depth} deep in the {side:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn what_falls_on_a_run_of_tiles_lands_on_its_face() {
    for side in SIDES {
        let mut run = run(side);
        let map = run.map(vec2(0, 0), vec2(16, 16));
        let into = inward(side);
        let turned = |along: i32, across: i32| if into.y == 0 { bits(across, along) } else { bits(along, across) };
        for step in 0..5_000 {
            let start = turned((20 << 16) + step * 4079, (8 - 30 * (into.x + into.y)) << 16);
            let motion = turned((20 - step % 41) << 17, (into.x + into.y) << 21);
            for circle in [false, true] {
                let mover = Outline::<Fixed> { centre: start, half: bits(6 << 16, 6 << 16), circle };
                assert_eq!(normals(&map, &mover, motion), Some(-into), "{mover:?} moves by {motion:?}");
            }
        }
    }
}

#[test]
fn what_overlaps_a_tile_may_leave_it_and_not_go_deeper() {
    let level = ["...", "...", "###"];
    let sunk = square(24.0, 26.5, 6.0);
    assert_eq!(sketch(&level, &sunk, way(0.0, -9.0)), None);
    assert_eq!(sketch(&level, &sunk, way(9.0, 0.0)), None);
    assert_eq!(sketch(&level, &sunk, way(9.0, 1.0)), Some(((1, 2), (0.0, -1.0), 0.0)));
    let mut drawing = Drawing::new(&level);
    let found = drawing.map(vec2(0, 0), vec2(16, 16)).cast(&sunk, way(0.0, 5.0), |_| true).unwrap();
    assert_eq!(found.hit.depth, I16F16::from_num(0.5));
}

#[test]
fn one_way_tiles_stop_only_what_comes_from_above() {
    let level = ["....", "....", "====", "...."];
    let floor = |x: u16, way| Some(((x, 2), (0.0, -1.0), way));
    assert_eq!(sketch(&level, &square(24.0, 10.0, 6.0), way(0.0, 99.0)), floor(1, 16.0));
    assert_eq!(sketch(&level, &square(24.0, 26.0, 6.0), way(0.0, 1.0)), floor(1, 0.0), "standing on it");
    assert_eq!(sketch(&level, &square(24.0, 26.02, 6.0), way(0.0, 1.0)), floor(1, 0.0), "and a little in it");
    assert_eq!(sketch(&level, &square(24.0, 26.1, 6.0), way(0.0, 1.0)), None, "halfway through");
    assert_eq!(sketch(&level, &ball(24.0, 50.0, 6.0), way(0.0, -99.0)), None, "from below");
    assert_eq!(sketch(&level, &ball(-24.0, 36.0, 6.0), way(99.0, 0.0)), None, "from the side");
    assert_eq!(sketch(&level, &square(-24.0, 10.0, 6.0), way(36.0, 24.0)), floor(0, 24.0), "askew");
    let mut drawing = Drawing::new(&level);
    let map = drawing.map(vec2(0, 0), vec2(16, 16));
    let dropping = map.cast(&square(24.0, 26.0, 6.0), way(0.0, 40.0), |tile| !tile.flags.is_one_way());
    assert_eq!(dropping, None, "dropping through on request");
}

#[test]
fn sensors_and_what_is_switched_off_stop_nothing() {
    let mut drawing = Drawing::new(&[".$^?*#"]);
    let mut map = drawing.map(vec2(0, 0), vec2(16, 16));
    let motion = way(200.0, 0.0);
    let hit = |map: &TileMap<'_>| told(map.cast(&ball(-8.0, 8.0, 4.0), motion, |_| true), motion);
    assert_eq!(hit(&map), Some(((4, 0), (-1.0, 0.0), 68.0)));
    map.consume(4, 0).unwrap();
    assert_eq!(hit(&map), Some(((5, 0), (-1.0, 0.0), 84.0)));
}

#[test]
fn a_ray_meets_the_first_tile() {
    let mut drawing = Drawing::new(&["....", ".#..", "...#"]);
    let map = drawing.map(vec2(0, 0), vec2(16, 16));
    let ray = |x, y, to: (f64, f64)| told(map.ray(way(x, y), way(to.0, to.1), |_| true), way(to.0, to.1));
    assert_eq!(ray(0.0, 20.0, (100.0, 0.0)), Some(((1, 1), (-1.0, 0.0), 16.0)));
    assert_eq!(ray(0.0, 31.99, (100.0, 0.0)), Some(((1, 1), (-1.0, 0.0), 16.0)), "close to a corner");
    assert_eq!(ray(0.0, 32.0, (100.0, 0.0)), None, "along an edge");
    assert_eq!(ray(0.0, 33.0, (100.0, 0.0)), Some(((3, 2), (-1.0, 0.0), 48.0)));
    assert_eq!(ray(20.0, 26.0, (100.0, 0.0)), Some(((1, 1), (-1.0, 0.0), 0.0)), "from inside");
    assert_eq!(ray(24.0, 16.0, (0.0, -9.0)), None, "off an edge");
    assert_eq!(ray(24.0, 16.0, (0.0, 9.0)), Some(((1, 1), (0.0, -1.0), 0.0)), "into an edge");
    let spared: Found = map.ray(way(0.0, 20.0), way(100.0, 30.0), |tile| tile.column != 1);
    assert_eq!(spared.map(|found| found.tile.flags), Some(TileFlags::SOLID));
}

/// When the earliest of all solid tiles is met, searched one by one, by a shape larger by `more` all round.
fn earliest(case: &Case, motion: Vec2<I16F16>, more: f64) -> Option<f64> {
    let mover = Outline::<f64> {
        centre: case.outline.centre.map(I16F16::to_num),
        half: case.outline.half.map(|h| (h.to_num::<f64>() + more).max(0.0)),
        circle: case.outline.circle,
    };
    let meet = |[left, right, top, bottom]: [f64; 4]| {
        let half = vec2((right - left) / 2.0, (bottom - top) / 2.0);
        let tile = Outline::<f64> { centre: vec2(left + half.x, top + half.y), half, circle: false };
        geometry::cast(&mover, motion.map(I16F16::to_num), &tile).map(|hit| hit.time)
    };
    case.solids().filter_map(meet).reduce(f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn a_sweep_finds_what_an_all_tiles_search_finds(
        case in case(), to in prop_oneof![(-300i32 << 16..300 << 16, -300i32 << 16..300 << 16), (-30i32..30, -30i32..30).prop_map(|(x, y)| (x << 16, y << 16))],
    ) {
        let motion = bits(to.0, to.1);
        // What overlaps from the start has its own rules.
        if earliest(&case, bits(0, 0), 1e-3).is_some() {
            return Ok(());
        }
        let mut drawing = case.drawing();
        let map = drawing.map(case.origin, case.size);
        let found = map.cast(&case.outline, motion, |_| true);
        let length = motion.x.to_num::<f64>().hypot(motion.y.to_num());
        // Grazing is a matter of rounding: the truth lies between a slightly larger and a slightly smaller shape.
        let [soonest, latest] = [1e-3, -1e-3].map(|more| earliest(&case, motion, more));
        if let Some(TileHit { hit, tile }) = found {
            let time = hit.time.to_num::<f64>();
            let soonest = soonest.expect("no tile is near") - 1e-3 / length;
            prop_assert!(time >= soonest, "{} before {}", time, soonest);
            prop_assert!(latest.is_none_or(|latest| time <= latest + 1e-3 / length), "{} after {:?}", time, latest);
            prop_assert!(map.flags(tile.column, tile.row).is_solid());
            prop_assert_eq!(hit.depth, px(0));
            // It ends free.
            let end = Case { outline: case.outline.at(case.outline.centre + part::<Fixed>(motion, hit.time)), ..case.clone() };
            prop_assert_eq!(earliest(&end, bits(0, 0), -1e-4), None, "overlaps a tile in the end");
        } else {
            prop_assert!(latest.is_none(), "missed what is met at {:?}", latest);
        }
    }

    #[test]
    fn the_ends_of_the_world_are_no_trouble(
        corner: (bool, bool), x in -16_384i32 << 16..=16_384 << 16, y in -16_384i32 << 16..=16_384 << 16,
        extent in 1i32..=4096 << 16, margin in 0i32..=4096 << 16, motion: (i32, i32), circle: bool,
    ) {
        let mut drawing = Drawing::of(vec![1; 16], 4, 4);
        let origin = |far: bool| if far { 16_384 - 4 * 255 } else { -16_384 };
        let map = drawing.map(vec2(origin(corner.0), origin(corner.1)), vec2(255, 255));
        let outline = Outline::<Fixed> { centre: bits(x, y), half: bits(extent, extent), circle };
        map.contacts(&outline, I16F16::from_bits(margin), |_| ());
        map.overlaps(&outline, |_| ());
        if let Some(TileHit { hit, .. }) = map.cast(&outline, bits(motion.0, motion.1), |_| true) {
            prop_assert!(hit.time >= 0 && hit.time <= 1);
        }
        map.ray(outline.centre, bits(motion.0, motion.1), |_| true).map(|found: TileHit<Fixed>| found.hit);
    }
}
