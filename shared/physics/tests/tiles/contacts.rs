//! Contacts with the map: one surface however it is tiled, and what an all-tiles search in f64 finds.

use fixed::types::I16F16;
use flat_physics::geometry::Outline;
use flat_physics::scalar::px;
use flat_physics::tiles::{Side, TileContact, TileMap};
use flat_physics::{Fixed, Scalar, Vec2, vec2};
use proptest::prelude::*;

use crate::drawing::Drawing;

pub(crate) fn bits(x: i32, y: i32) -> Vec2<I16F16> {
    vec2(I16F16::from_bits(x), I16F16::from_bits(y))
}

fn contacts<S: Scalar>(map: &TileMap<'_>, outline: &Outline<S>, margin: S::Real) -> Vec<TileContact<S>> {
    let mut found = Vec::new();
    map.contacts(outline, margin, |contact| found.push(contact));
    found
}

fn deepest(found: &[TileContact<Fixed>]) -> Option<f64> {
    found.iter().map(|contact| contact.penetration.to_num()).reduce(f64::max)
}

/// 1000 solid tiles in a row, or in a column if they are to be touched on the left or the right.
pub(crate) fn run(side: Side) -> Drawing {
    let row = matches!(side, Side::Top | Side::Bottom);
    if row { Drawing::of(vec![1; 1000], 1000, 1) } else { Drawing::of(vec![1; 1000], 1, 1000) }
}

pub(crate) fn inward(side: Side) -> Vec2<i32> {
    match side {
        Side::Left => vec2(1, 0),
        Side::Right => vec2(-1, 0),
        Side::Top => vec2(0, 1),
        Side::Bottom => vec2(0, -1),
    }
}

pub(crate) const SIDES: [Side; 4] = [Side::Left, Side::Right, Side::Top, Side::Bottom];

/// A shape `along` the run and `depth` in it touches nothing but that side, that deep.
fn assert_one_surface(map: &TileMap<'_>, side: Side, circle: bool, along: i32, depth: i32) {
    let across = match side {
        Side::Left | Side::Top => -(6 << 16) + depth,
        Side::Right | Side::Bottom => (22 << 16) - depth,
    };
    let centre = if matches!(side, Side::Top | Side::Bottom) { bits(along, across) } else { bits(across, along) };
    let found = contacts(map, &Outline::<Fixed> { centre, half: bits(6 << 16, 6 << 16), circle }, px(1));
    let place = format!("{along} along the {side:?}, circle {circle}");
    let [contact] = &found[..] else { panic!("{found:?} at {place}") };
    assert_eq!(contact.normal.map(|n| n.to_num::<i32>()), inward(side), "{place}");
    assert_eq!(contact.penetration.to_bits(), depth, "{place}");
}

#[test]
fn a_run_of_tiles_is_one_surface_at_every_sub_pixel_phase() {
    for side in SIDES {
        let mut run = run(side);
        let map = run.map(vec2(0, 0), vec2(16, 16));
        for phase in 0..1 << 16 {
            // Just touching, resting within the slop, about to land.
            let depth = [0, 1300, -20_000][phase as usize % 3];
            for along in [160, 170] {
                assert_one_surface(&map, side, false, (along << 16) + phase, depth);
                assert_one_surface(&map, side, true, (along << 16) + phase, depth);
            }
        }
    }
}

#[test]
fn a_run_of_tiles_is_one_surface_over_1000_seams_at_any_speed() {
    for side in SIDES {
        let mut run = run(side);
        let map = run.map(vec2(0, 0), vec2(16, 16));
        for speed in [7, 60, 137, 500] {
            for along in (10 << 16..15_990 << 16).step_by((speed << 16) / 60) {
                assert_one_surface(&map, side, false, along, 1300);
                assert_one_surface(&map, side, true, along, 1300);
            }
        }
    }
}

fn sketch(rows: &[&str], outline: &Outline<Fixed>) -> Vec<(f64, f64, f64)> {
    let mut drawing = Drawing::new(rows);
    let found = contacts(&drawing.map(vec2(0, 0), vec2(16, 16)), outline, px(1));
    found.iter().map(|c| (c.normal.x.to_num(), c.normal.y.to_num(), c.penetration.to_num())).collect()
}

pub(crate) fn square(x: f64, y: f64, half: f64) -> Outline<Fixed> {
    let at = I16F16::from_num;
    Outline { centre: vec2(at(x), at(y)), half: vec2(at(half), at(half)), circle: false }
}

pub(crate) fn ball(x: f64, y: f64, radius: f64) -> Outline<Fixed> {
    Outline { circle: true, ..square(x, y, radius) }
}

#[test]
fn an_inner_corner_gives_two_contacts() {
    let corner = ["..#", "..#", "###"];
    let expected = [(1.0, 0.0, 0.25), (0.0, 1.0, 0.5)];
    assert_eq!(sketch(&corner, &square(26.25, 26.5, 6.0)), expected);
    assert_eq!(sketch(&corner, &ball(26.25, 26.5, 6.0)), expected);
}

#[test]
fn a_circle_rolls_off_an_outer_corner() {
    let ledge = ["...", "##.", "##."];
    // 3-4-5: the centre is 3 px beside the corner and 4 px above it.
    let [(x, y, depth)] = sketch(&ledge, &ball(35.0, 12.0, 5.5))[..] else { panic!("not one contact") };
    assert!((x + 0.6).abs() < 1e-8 && (y - 0.8).abs() < 1e-8 && (depth - 0.5).abs() < 1e-4);
    assert_eq!(sketch(&["...", "###", "###"], &ball(35.0, 12.0, 5.5)), [(0.0, 1.0, 1.5)], "no corner within a run");
}

#[test]
fn a_box_passes_a_corner_that_it_grazes() {
    let hole = ["....", "#..#", "####"];
    // Sunk into the floor by less than bodies rest at: the far edge of the hole doesn't stop it.
    assert_eq!(sketch(&hole, &square(41.5, 10.02, 6.0)), []);
    assert_eq!(sketch(&hole, &square(42.5, 10.02, 6.0)).len(), 1);
    assert_eq!(sketch(&hole, &square(41.5, 10.2, 6.0)).len(), 1, "deeper, it does");
    // Falling along a wall that it leans on: a ledge in line with the wall doesn't hold it.
    let notch = ["..#", "...", "..#"];
    assert_eq!(sketch(&notch, &square(26.02, 25.5, 6.0)), []);
}

#[test]
fn what_is_buried_finds_the_nearest_way_out() {
    let block = ["......", ".####.", ".####.", ".####.", "......"];
    assert_eq!(sketch(&block, &ball(44.0, 39.0, 2.0)), [(0.0, 1.0, 25.0)]);
    assert_eq!(sketch(&block, &square(33.0, 40.0, 2.0)), [(1.0, 0.0, 19.0)]);
}

#[test]
fn one_way_tiles_have_nothing_but_a_top() {
    let bridge = ["....", "====", "...."];
    assert_eq!(sketch(&bridge, &square(30.0, 10.5, 6.0)), [(0.0, 1.0, 0.5)]);
    assert_eq!(sketch(&bridge, &ball(32.0, 9.5, 6.0)), [(0.0, 1.0, -0.5)]);
    assert_eq!(sketch(&bridge, &square(30.0, 17.0, 6.0)), [], "from inside");
    assert_eq!(sketch(&bridge, &square(30.0, 37.9, 6.0)), [], "from below");
    let end = ["...", "==.", "..."];
    let [(x, y, depth)] = sketch(&end, &ball(35.0, 12.0, 5.5))[..] else { panic!("not one contact") };
    assert!((x + 0.6).abs() < 1e-8 && (y - 0.8).abs() < 1e-8 && (depth - 0.5).abs() < 1e-4);
    assert_eq!(sketch(&end, &square(39.0, 20.0, 6.0)), [], "beside its end");
    let ladder = ["..", "==", "==", ".."];
    assert_eq!(sketch(&ladder, &square(16.0, 14.0, 20.0)), [(0.0, 1.0, 18.0), (0.0, 1.0, 2.0)], "each level counts");
}

#[test]
fn a_floor_of_solid_and_one_way_tiles_is_one_surface_too() {
    for at in 0..64 * 64 {
        let x = 8.0 + f64::from(at) / 64.0;
        for outline in [square(x, 10.02, 6.0), ball(x, 10.02, 6.0)] {
            for (nx, ny, depth) in sketch(&["......", "##==##", "......"], &outline) {
                assert_eq!((nx, ny, (depth * 100.0).round()), (0.0, 1.0, 2.0), "at {x}, circle {}", outline.circle);
            }
        }
    }
}

#[test]
fn sensors_are_noticed_and_block_nothing() {
    let mut drawing = Drawing::new(&["...", ".$?", ".^#"]);
    let mut map = drawing.map(vec2(0, 0), vec2(16, 16));
    let noticed = |map: &TileMap<'_>, outline: &Outline<Fixed>| {
        let mut tiles = Vec::new();
        map.overlaps(outline, |tile| tiles.push((tile.column, tile.row)));
        tiles
    };
    let all = [(1, 1), (2, 1), (1, 2)];
    assert_eq!(noticed(&map, &square(32.0, 32.0, 6.0)), all);
    assert_eq!(contacts(&map, &square(26.0, 26.0, 5.0), px(1)), []);
    assert_eq!(noticed(&map, &square(10.0, 24.0, 6.0)), [(1, 1)], "touching counts");
    assert_eq!(noticed(&map, &square(10.0, 10.0, 6.0)), [], "a mere corner doesn't");
    assert_eq!(noticed(&map, &ball(12.0, 13.0, 5.0)), [(1, 1)], "a circle that touches the corner does");
    assert_eq!(noticed(&map, &ball(12.0, 13.0, 4.9)), []);
    map.consume(1, 1).unwrap();
    assert_eq!(noticed(&map, &square(32.0, 32.0, 6.0)), all[1..]);
}

/// A random level and a shape in it.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) tiles: Vec<u8>,
    pub(crate) origin: Vec2<i16>,
    pub(crate) size: Vec2<u8>,
    pub(crate) outline: Outline<Fixed>,
}

const COLUMNS: i32 = 6;
const ROWS: i32 = 5;

prop_compose! {
    pub(crate) fn case()(
        tiles in (0u32..=9).prop_flat_map(|tenths| {
            prop::collection::vec(prop::bool::weighted(f64::from(tenths) / 10.0).prop_map(u8::from), (COLUMNS * ROWS) as usize)
        }),
        size in prop_oneof![Just((16u8, 16u8)), (1u8..40, 1u8..40)],
        origin in prop_oneof![Just((0i16, 0i16)), (-16_000i16..16_000, -16_000i16..16_000)],
        // In 1/1000 of the map, and a little around it.
        place in (-100i32..1100, -100i32..1100), fraction in prop_oneof![Just((0, 0)), (0..1 << 16, 0..1 << 16)],
        extent in (1..30i32 << 16, 1..30i32 << 16), small: bool, circle: bool,
    ) -> Case {
        let at = |origin: i16, size: u8, count: i32, place: i32, fraction: i32| {
            ((i32::from(origin) + i32::from(size) * count * place / 1000) << 16) + fraction
        };
        let centre = bits(
            at(origin.0, size.0, COLUMNS, place.0, fraction.0),
            at(origin.1, size.1, ROWS, place.1, fraction.1),
        );
        let extent = if small { (extent.0 / 6, extent.1 / 6) } else { extent };
        let half = if circle { bits(extent.0.max(1), extent.0.max(1)) } else { bits(extent.0.max(1), extent.1.max(1)) };
        Case { tiles, origin: vec2(origin.0, origin.1), size: vec2(size.0, size.1), outline: Outline { centre, half, circle } }
    }
}

impl Case {
    pub(crate) fn drawing(&self) -> Drawing {
        Drawing::of(self.tiles.clone(), COLUMNS as u16, ROWS as u16)
    }

    fn contacts(&self, margin: i16) -> Vec<TileContact<Fixed>> {
        contacts(&self.drawing().map(self.origin, self.size), &self.outline, px(margin))
    }

    /// Edges of the solid tiles: left, right, top, bottom.
    pub(crate) fn solids(&self) -> impl Iterator<Item = [f64; 4]> {
        self.tiles.iter().enumerate().filter(|&(_, &tile)| tile == 1).map(|(place, _)| {
            let edge =
                |origin: i16, size: u8, index: usize| f64::from(i32::from(origin) + i32::from(size) * index as i32);
            let (column, row) = (place % COLUMNS as usize, place / COLUMNS as usize);
            [
                edge(self.origin.x, self.size.x, column),
                edge(self.origin.x, self.size.x, column + 1),
                edge(self.origin.y, self.size.y, row),
                edge(self.origin.y, self.size.y, row + 1),
            ]
        })
    }

    fn centre(&self) -> [f64; 2] {
        [self.outline.centre.x.to_num(), self.outline.centre.y.to_num()]
    }

    fn half(&self) -> [f64; 2] {
        [self.outline.half.x.to_num(), self.outline.half.y.to_num()]
    }

    /// Overlap of a box with a tile through each of the tile's sides.
    fn depths(&self, [left, right, top, bottom]: [f64; 4]) -> [f64; 4] {
        let ([x, y], [w, h]) = (self.centre(), self.half());
        [x + w - left, right - x + w, y + h - top, bottom - y + h]
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn a_circle_is_as_deep_as_the_closest_point_of_all_tiles_says(mut case in case(), margin in 0i16..8) {
        case.outline = Outline { half: vec2(case.outline.half.x, case.outline.half.x), circle: true, ..case.outline };
        let ([x, y], radius) = (case.centre(), case.half()[0]);
        let distance = |[left, right, top, bottom]: [f64; 4]| (x - x.clamp(left, right)).hypot(y - y.clamp(top, bottom));
        let closest = case.solids().map(distance).fold(f64::INFINITY, f64::min);
        let (found, depth) = (deepest(&case.contacts(margin)), radius - closest);
        if closest == 0.0 {
            prop_assert!(found.is_some_and(|found| found >= radius), "{:?} inside a tile", found);
        } else if depth > 1e-4 - f64::from(margin) {
            prop_assert!(found.is_some_and(|found| (found - depth).abs() < 1e-4), "{:?}, expected {}", found, depth);
        } else if depth < -1e-4 - f64::from(margin) {
            prop_assert_eq!(found, None, "expected {}", depth);
        }
    }

    #[test]
    fn a_box_beside_tiles_is_as_near_as_the_nearest_of_each_side(mut case in case(), margin in 0i16..8) {
        case.outline.circle = false;
        let margin = f64::from(margin);
        let found = case.contacts(margin as i16);
        let tiles: Vec<[f64; 4]> = case.solids().map(|tile| case.depths(tile)).collect();
        // What overlaps the tiles, or a tile's side by a sliver, is another matter.
        let clear = |[l, r, t, b]: &[f64; 4]| l.min(*r) <= 0.0 || t.min(*b) <= 0.0;
        let sliver = |&depth: &f64| depth > 0.0 && depth <= 1.0 / 16.0;
        if !tiles.iter().all(clear) || tiles.iter().flatten().any(sliver) {
            return Ok(());
        }
        for (index, side) in SIDES.into_iter().enumerate() {
            let beside = |depths: &&[f64; 4]| {
                let aside = if index < 2 { depths[2].min(depths[3]) } else { depths[0].min(depths[1]) };
                aside > 0.0 && depths[index] <= 0.0 && depths[index] >= -margin
            };
            let expected = tiles.iter().filter(beside).map(|depths| depths[index]).reduce(f64::max);
            let normal = inward(side);
            let of_side = |contact: &&TileContact<Fixed>| contact.normal.map(|n| n.to_num::<i32>()) == normal;
            let found: Option<f64> = found.iter().find(of_side).map(|contact| contact.penetration.to_num());
            prop_assert_eq!(found, expected, "on the {:?}", side);
        }
    }

    #[test]
    fn nothing_is_pushed_by_a_face_that_isn_t_there(case in case()) {
        let mut drawing = case.drawing();
        let map = drawing.map(case.origin, case.size);
        let found = contacts(&map, &case.outline, px(2));
        for contact in &found {
            let normal = contact.normal.map(|n| n.to_num::<f64>());
            let side = SIDES.into_iter().find(|&side| inward(side).map(f64::from) == normal);
            if let Some(side) = side {
                prop_assert!(map.has_face(contact.tile.column, contact.tile.row, side), "{:?} {:?}", side, contact);
            }
        }
        prop_assert!(found.len() <= 8);
    }

    #[test]
    fn what_overlaps_tiles_gets_out_push_by_push(mut case in case(), small in (1i32..100, 1i32..100)) {
        // A shape that fits into one tile, with its centre at a free place.
        let half = |size: u8, hundredths: i32| (i32::from(size) << 16) / 2 * hundredths / 100 - 1;
        let (w, h) = (half(case.size.x, small.0), half(case.size.y, small.1));
        case.outline.half = if case.outline.circle { bits(w.min(h).max(1), w.min(h).max(1)) } else { bits(w.max(1), h.max(1)) };
        let mut drawing = case.drawing();
        let map = drawing.map(case.origin, case.size);
        // Nothing fits through two tiles that meet in a corner.
        let tile = |column: usize, row: usize| case.tiles[row * COLUMNS as usize + column];
        let pinched = (0..ROWS as usize - 1).any(|row| (0..COLUMNS as usize - 1).any(|column| {
            let [a, b, c, d] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| tile(column + x, row + y));
            a == d && b == c && a != b
        }));
        if pinched || map.at::<Fixed>(case.outline.centre).is_some() {
            return Ok(());
        }
        for _ in 0..8 {
            let found = contacts(&map, &case.outline, px(0));
            let Some(worst) = found.iter().max_by_key(|contact| contact.penetration) else { break };
            case.outline.centre = case.outline.centre - worst.normal.map(|n| Fixed::length_times(worst.penetration, n));
        }
        let left = deepest(&contacts(&map, &case.outline, px(0)));
        prop_assert!(left.is_none_or(|left| left < 1e-3), "{:?}", left);
        if !case.outline.circle {
            let grazes = |tile| case.depths(tile).into_iter().fold(f64::INFINITY, f64::min) <= 1.0 / 16.0;
            prop_assert!(case.solids().all(grazes));
        }
    }

    #[test]
    fn a_mirrored_level_gives_mirrored_contacts(mut case in case(), margin in 0i16..8) {
        case.origin.x = -(i16::from(case.size.x) * COLUMNS as i16) / 2;
        prop_assume!(i32::from(case.size.x) * COLUMNS % 2 == 0);
        // Off all lines of symmetry: what is equally deep on the left and the right is pushed to one of them.
        case.outline.centre.x = I16F16::from_bits((case.outline.centre.x.to_bits() % (200 << 16)) | 1);
        let keys = |found: Vec<TileContact<Fixed>>, mirror: bool| {
            let mut keys: Vec<_> = found
                .iter()
                .map(|contact| (if mirror { -contact.normal.x } else { contact.normal.x }, contact.normal.y, contact.penetration))
                .collect();
            keys.sort();
            keys
        };
        let before = keys(case.contacts(margin), false);
        case.tiles = case.drawing().mirrored().bytes;
        case.outline.centre.x = -case.outline.centre.x;
        prop_assert_eq!(before, keys(case.contacts(margin), true));
    }

    #[test]
    fn a_level_may_lie_anywhere(mut case in case(), by in (-300i16..300, -300i16..300)) {
        case.origin = vec2(by.0, by.1);
        case.outline.centre = vec2(case.outline.centre.x % px(300), case.outline.centre.y % px(300));
        let before = case.contacts(1);
        case.origin = vec2(by.0 + 15_000, by.1 - 15_000);
        case.outline.centre = case.outline.centre + vec2(px(15_000), px(-15_000));
        prop_assert_eq!(before, case.contacts(1));
    }

    #[test]
    fn number_formats_agree(mut case in case()) {
        // Numbers that all formats hold.
        case.origin = vec2(-20, -20);
        let coarse = |v: Vec2<I16F16>| v.map(|n| I16F16::from_bits((n.to_bits() % (300 << 16)) & !0xff));
        case.outline = Outline { centre: coarse(case.outline.centre), half: case.outline.half.map(|h| I16F16::from_bits(h.to_bits() & !0xff)), ..case.outline };
        prop_assume!(case.outline.half.x > 0 && case.outline.half.y > 0);
        let mut drawing = case.drawing();
        let map = drawing.map(case.origin, case.size);
        let outline = Outline::<f64> {
            centre: case.outline.centre.map(I16F16::to_num), half: case.outline.half.map(I16F16::to_num), circle: case.outline.circle,
        };
        let fixed = contacts(&map, &case.outline, px(1));
        let float = contacts(&map, &outline, 1.0);
        prop_assert_eq!(fixed.len(), float.len());
        for (fixed, float) in fixed.iter().zip(&float) {
            prop_assert_eq!(fixed.tile, float.tile);
            prop_assert!((fixed.penetration.to_num::<f64>() - float.penetration).abs() < 1e-4);
            prop_assert!((fixed.normal.x.to_num::<f64>() - float.normal.x).abs() < 1e-7);
        }
    }
}
