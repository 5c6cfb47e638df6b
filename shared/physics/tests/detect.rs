//! Nobody is lost: the contacts are those that an all-pairs search in f64 finds, whatever the world looks like.

use std::collections::BTreeSet;

use fixed::types::I16F16;
use flat_physics::scalar::px;
use flat_physics::{BodyDef, Effects, Fixed, Handle, Kind, Material, Shape, Stage, Storage, World, step, vec2};
use proptest::prelude::*;

type Pair = (u16, u16);

/// A definition in f64: the oracle's view.
struct Seen {
    centre: [f64; 2],
    half: [f64; 2],
    circle: bool,
    fixed: bool,
}

impl Seen {
    fn of(def: &BodyDef<Fixed>) -> Self {
        let half = def.shape.half_extents();
        Self {
            centre: [def.position.x.to_num(), def.position.y.to_num()],
            half: [half.x.to_num(), half.y.to_num()],
            circle: matches!(def.shape, Shape::Circle { .. }),
            fixed: def.kind == Kind::Static,
        }
    }

    /// Depth of overlap; below 0 apart. Boxes that share only a corner count as apart.
    fn depth(&self, other: &Self) -> f64 {
        let gap = |axis: usize| (self.centre[axis] - other.centre[axis]).abs() - self.half[axis] - other.half[axis];
        match (self.circle, other.circle) {
            (false, false) if gap(0) == 0.0 && gap(1) == 0.0 => -1.0,
            (false, false) => -gap(0).max(gap(1)),
            (true, true) => {
                let d = [self.centre[0] - other.centre[0], self.centre[1] - other.centre[1]];
                self.half[0] + other.half[0] - d[0].hypot(d[1])
            }
            _ => {
                let (circle, rect) = if self.circle { (self, other) } else { (other, self) };
                let d = [0, 1].map(|axis| {
                    let d = circle.centre[axis] - rect.centre[axis];
                    d - d.clamp(-rect.half[axis], rect.half[axis])
                });
                if d == [0.0, 0.0] { -gap(0).max(gap(1)) } else { circle.half[0] - d[0].hypot(d[1]) }
            }
        }
    }
    /// Whether one is a circle that overlaps a corner of the other, a static box, by so little that it isn't a contact if the
    /// circle lies on a face that is flush with it.
    fn may_graze(&self, other: &Self) -> bool {
        self.circle != other.circle && (self.fixed || other.fixed) && (0.0..=1.0 / 16.0).contains(&self.depth(other))
    }

    /// Whether they touch but for rounding: boxes are exact, the distance of round shapes is rounded to the last place, 2^-16 px.
    fn may_round(&self, other: &Self) -> bool {
        (self.circle || other.circle) && self.depth(other).abs() <= 1.6e-5
    }
}

fn found(world: &World<'_, Fixed>) -> BTreeSet<Pair> {
    let pairs: Vec<Pair> = world
        .contacts()
        .map(|contact| {
            let [a, b] = contact.bodies.map(Handle::slot);
            (a.min(b), a.max(b))
        })
        .collect();
    let set: BTreeSet<_> = pairs.iter().copied().collect();
    assert_eq!(set.len(), pairs.len(), "a pair was found twice");
    set
}

/// A length of any order of magnitude, bits.
fn length(max_px: i32) -> impl Strategy<Value = i32> {
    (0u32..16, 1..=max_px << 16).prop_map(|(shift, bits)| (bits >> shift).max(1))
}

prop_compose! {
    fn body(spread: i32, largest: i32)(
        x in -spread..=spread, y in -spread..=spread, fraction in prop_oneof![Just((0, 0)), (0..65_536i32, 0..65_536i32)],
        w in length(largest), h in length(largest), circle: bool, fixed in prop::bool::weighted(0.3),
    ) -> BodyDef<Fixed> {
        let at = |whole: i32, part| I16F16::from_bits((whole << 16) + part).clamp(px(-16_384), px(16_384));
        let [w, h] = [w, h].map(I16F16::from_bits);
        let shape = if circle { Shape::Circle { radius: w } } else { Shape::Box { half: vec2(w, h) } };
        let position = vec2(at(x, fraction.0), at(y, fraction.1));
        if fixed { BodyDef::fixed(shape, position) } else { BodyDef::rigid(shape, position) }
    }
}

/// Crowds and wide worlds, small and huge bodies.
fn scene() -> impl Strategy<Value = Vec<BodyDef<Fixed>>> {
    prop_oneof![
        prop::collection::vec(body(40, 8), 2..60),
        prop::collection::vec(body(200, 60), 2..60),
        prop::collection::vec(body(16_384, 4096), 2..60),
        prop::collection::vec(body(3, 2), 2..40),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn contacts_are_those_of_an_all_pairs_search(defs in scene()) {
        let mut storage = Box::new(Storage::<Fixed, 64, 2048>::new());
        let mut world = storage.world();
        for def in &defs {
            world.spawn(def).unwrap();
        }
        Stage::Detect.run(&mut world, Effects::NONE);
        let found = found(&world);
        prop_assert_eq!(world.statistics().contacts_lost, 0);
        let seen: Vec<_> = defs.iter().map(Seen::of).collect();
        for (a, first) in seen.iter().enumerate() {
            for (b, second) in seen.iter().enumerate().skip(a + 1) {
                if first.fixed && second.fixed {
                    continue;
                }
                let (depth, pair) = (first.depth(second), (a as u16, b as u16));
                if first.may_graze(second) {
                    continue;
                }
                if !first.may_round(second) {
                    prop_assert_eq!(found.contains(&pair), depth >= 0.0, "{:?}: depth {}", pair, depth);
                }
            }
        }
        for contact in world.contacts() {
            let [a, b] = contact.bodies.map(|body| &seen[usize::from(body.slot())]);
            let (depth, got) = (a.depth(b), contact.penetration.to_num::<f64>());
            prop_assert!((got - depth.min(100.0)).abs() < 4e-5 + depth * 1e-8, "penetration {got}, exact {depth}");
            let n = [contact.normal.x.to_num::<f64>(), contact.normal.y.to_num::<f64>()];
            prop_assert!((n[0].hypot(n[1]) - 1.0).abs() < 2e-8, "normal {n:?}");
            // The normal leads from the first to the second: parting along it by the depth leaves nothing but rounding.
            let parted = Seen { centre: [b.centre[0] + n[0] * depth, b.centre[1] + n[1] * depth], ..*b };
            prop_assert!(a.depth(&parted) < 4e-5 + depth * 1e-7, "still {} deep along {n:?}", a.depth(&parted));
        }
    }

    #[test]
    fn removed_and_added_bodies_are_noticed(defs in prop::collection::vec(body(30, 8), 4..40), changes in prop::collection::vec((any::<usize>(), body(30, 8)), 1..20)) {
        let mut storage = Box::new(Storage::<Fixed, 64, 2048>::new());
        let mut world = storage.world();
        let mut handles: Vec<_> = defs.iter().map(|def| (world.spawn(def).unwrap(), *def)).collect();
        for (victim, def) in changes {
            let (gone, _) = handles.swap_remove(victim % handles.len());
            world.despawn(gone).unwrap();
            handles.push((world.spawn(&def).unwrap(), def));
            Stage::Detect.run(&mut world, Effects::NONE);
            let found = found(&world);
            let (mut expected, mut open) = (BTreeSet::new(), BTreeSet::new());
            for (index, (a, first)) in handles.iter().enumerate() {
                for (b, second) in &handles[index + 1..] {
                    let (first, second) = (Seen::of(first), Seen::of(second));
                    let pair = (a.slot().min(b.slot()), a.slot().max(b.slot()));
                    if first.may_graze(&second) || first.may_round(&second) {
                        open.insert(pair);
                    } else if !(first.fixed && second.fixed) && first.depth(&second) >= 0.0 {
                        expected.insert(pair);
                    }
                }
            }
            let wrong: Vec<_> = expected.symmetric_difference(&found).filter(|pair| !open.contains(pair)).collect();
            prop_assert!(wrong.is_empty(), "{wrong:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(800))]

    #[test]
    fn pairs_are_those_that_may_meet_in_the_step(
        defs in prop_oneof![prop::collection::vec(body(60, 8), 2..40), prop::collection::vec(body(300, 40), 2..60)],
        drift in (-1500i16..1500, -1500i16..1500),
        speeds in prop::collection::vec((0u32..8, -6000i32..6000, -6000i32..6000), 60),
    ) {
        let mut storage = Box::new(Storage::<Fixed, 64, 2048>::new());
        let mut world = storage.world();
        let mut bodies = Vec::new();
        for (def, (slower, x, y)) in defs.iter().filter(|def| def.kind != Kind::Static).zip(speeds) {
            let velocity = vec2(px(drift.0 + (x >> slower) as i16), px(drift.1 + (y >> slower) as i16));
            let def = BodyDef { velocity, ..*def };
            world.spawn(&def).unwrap();
            let per_step = [velocity.x, velocity.y].map(|v| v.to_num::<f64>() / 60.0);
            bodies.push((Seen::of(&def), per_step));
        }
        Stage::Detect.run(&mut world, Effects::NONE);
        Stage::Events.run(&mut world, Effects::NONE); // counts them
        // From the lowest centre up, equal ones from the left: the upper one of two looks.
        bodies.sort_by(|(a, _), (b, _)| {
            b.centre[1].total_cmp(&a.centre[1]).then(a.centre[0].total_cmp(&b.centre[0]))
        });
        let fastest = bodies.iter().flat_map(|(_, speed)| *speed).fold(0.0, |most: f64, v| most.max(v.abs()));
        let margin = if fastest < 1.0 { 2.0 } else { 1.0 };
        let count = |leeway: f64| {
            let may_meet = |upper: usize, lower: usize| {
                let ((a, va), (b, vb)) = (&bodies[upper], &bodies[lower]);
                [0, 1].iter().all(|&axis| {
                    let space = (a.centre[axis] - b.centre[axis]).abs() - a.half[axis] - b.half[axis];
                    space <= margin + leeway + (va[axis] - vb[axis]).abs().max(va[axis].abs())
                })
            };
            (0..bodies.len()).map(|upper| (0..upper).filter(|&lower| may_meet(upper, lower)).count()).sum::<usize>()
        };
        let found = usize::from(world.statistics().contacts_peak);
        // As good as exact: what lies between depends on rounding alone.
        prop_assert!((count(-1e-3)..=count(1e-3)).contains(&found), "{found} of {}..={}", count(-1e-3), count(1e-3));
    }
}

/// `(offset of b from a, what a is, what b is)` to contact or none.
fn touching(a: Shape<Fixed>, b: Shape<Fixed>, offset: (i16, i16)) -> bool {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.spawn(&BodyDef::rigid(a, vec2(px(100), px(100)))).unwrap();
    world.spawn(&BodyDef::rigid(b, vec2(px(100 + offset.0), px(100 + offset.1)))).unwrap();
    Stage::Detect.run(&mut world, Effects::NONE);
    world.contacts().inspect(|contact| assert_eq!(contact.penetration, px(0))).count() == 1
}

#[test]
fn bodies_that_exactly_touch_are_in_contact_and_a_shared_corner_is_none() {
    let rect = Shape::Box { half: vec2(px(4), px(3)) };
    let disc = Shape::Circle { radius: px(5) };
    assert!(touching(rect, rect, (8, 2)) && touching(rect, rect, (-8, 2)), "side by side");
    assert!(touching(rect, rect, (3, 6)) && touching(rect, rect, (3, -6)), "one on the other");
    assert!(!touching(rect, rect, (8, 6)), "corner to corner");
    assert!(touching(disc, disc, (6, 8)) && touching(disc, disc, (0, -10)), "discs");
    assert!(touching(disc, rect, (9, 0)) && touching(rect, disc, (0, -8)), "disc and face");
    assert!(touching(disc, rect, (7, 7)), "disc and corner: 3, 4, 5");
}

#[test]
fn bodies_with_one_centre_part_each_on_its_own_way() {
    for shape in [Shape::Circle { radius: px(5) }, Shape::Box { half: vec2(px(5), px(5)) }] {
        let mut storage = Storage::<Fixed, 4, 8>::new();
        let mut world = storage.world();
        for _ in 0..4 {
            world.spawn(&BodyDef::<Fixed>::rigid(shape, vec2(px(0), px(0)))).unwrap();
        }
        Stage::Detect.run(&mut world, Effects::NONE);
        let mut ways = BTreeSet::new();
        for contact in world.contacts() {
            let n = [contact.normal.x.to_num::<f64>(), contact.normal.y.to_num::<f64>()];
            assert!((n[0].hypot(n[1]) - 1.0).abs() < 2e-8, "normal {n:?}");
            assert_eq!(contact.penetration, px(10));
            ways.insert(n.map(|n| (1e6 * n) as i64));
        }
        assert!(ways.len() > 1, "{ways:?}");
    }
}

#[test]
fn contacts_beyond_the_pool_are_counted_and_the_rest_is_kept() {
    let mut storage = Storage::<Fixed, 8, 3>::new();
    let mut world = storage.world();
    for x in 0..6 {
        world.spawn(&BodyDef::rigid(Shape::Circle { radius: px(3) }, vec2(px(6 * x), px(0)))).unwrap();
    }
    for steps in 1..=2 {
        Stage::Detect.run(&mut world, Effects::NONE);
        Stage::Events.run(&mut world, Effects::NONE);
        let statistics = world.statistics();
        assert_eq!((statistics.contacts, statistics.contacts_peak, statistics.contacts_lost), (3, 3, 2 * steps));
    }
}

#[test]
fn in_a_pool_that_is_too_small_what_bears_others_stays() {
    // Columns of crates side by side, with a contact downwards for each, and as many sideways as there is no room for.
    let mut storage = Storage::<Fixed, 64, 34>::new();
    let mut world = storage.world();
    let material = Material { bounce: false, ..Material::DEFAULT };
    world
        .spawn(&BodyDef { material, ..BodyDef::fixed(Shape::Box { half: vec2(px(200), px(8)) }, vec2(px(60), px(8))) })
        .unwrap();
    for (column, level) in (0..16).flat_map(|column| [(column, 0), (column, 1)]) {
        let place = vec2(px(10 * column), px(-5 - 10 * level));
        world.spawn(&BodyDef { material, ..BodyDef::rigid(Shape::Box { half: vec2(px(5), px(5)) }, place) }).unwrap();
    }
    for _ in 0..120 {
        step(&mut world, Effects::GRAVITY);
    }
    assert!(world.statistics().contacts_lost > 0);
    for body in world.bodies().skip(1) {
        let level = if body.position.y < px(-10) { -15.0 } else { -5.0 };
        assert!((body.position.y.to_num::<f64>() - level).abs() < 0.02, "{:?}", body.position);
    }
}
