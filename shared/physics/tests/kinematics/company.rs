//! Whom a walker rides, pushes, notices and gets past.

use flat_physics::geometry::overlaps;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Collider, Fixed, SlideOptions, Storage, World, vec2};

use crate::{Walker, at, disc, height, outlines, place, player, rect, wall};

#[test]
fn what_moves_into_a_walker_pushes_it() {
    world!(
        world,
        [
            hero = player(rect(4, 4), 0, -4),
            floor = wall(rect(200, 10), 0, 10),
            press = BodyDef { velocity: at(60, 0), ..player(rect(4, 20), -20, -20) },
        ]
    );
    let mut walker = Walker::new(hero);
    for _ in 0..120 {
        assert!(walker.walk(&mut world, 0).floor);
    }
    assert_eq!(height(&world, hero), px(-4));
    let gap = world.body(hero).unwrap().position.x - world.body(press).unwrap().position.x;
    assert_eq!(gap, px(8));
}

/// Platforms that move along, down and up, solid and one-way.
#[test]
fn a_moving_platform_carries_what_stands_on_it_and_gives_its_speed_to_what_leaves() {
    for one_way in [false, true] {
        for velocity in [at(37, 0), at(0, 41), at(0, -41), at(-90, -90), at(33, 120)] {
            world!(
                world,
                [hero = player(rect(4, 4), 5, -30), lift = BodyDef { one_way, velocity, ..player(rect(20, 3), 0, 0) },]
            );
            let mut walker = Walker::new(hero);
            while !walker.walk(&mut world, 0).floor {}
            let offset =
                |world: &World<'_, Fixed>| world.body(hero).unwrap().position - world.body(lift).unwrap().position;
            let stand = offset(&world);
            assert_eq!(stand.y, px(-7), "lands on {velocity:?}");
            for _ in 0..240 {
                assert!(walker.walk(&mut world, 0).floor);
                assert_eq!(offset(&world), stand, "on {velocity:?}");
            }
            walker.velocity.y = px(-300);
            let jump = walker.walk(&mut world, 0);
            let expected = velocity.y.to_num::<f64>() - 290.0;
            assert!(!jump.floor && (jump.velocity.y.to_num::<f64>() - expected).abs() < 0.01, "{:?}", jump.velocity);
        }
    }
}

#[test]
fn a_platform_that_turns_keeps_its_passenger() {
    world!(world, [hero = player(rect(4, 4), 0, -7), lift = BodyDef { one_way: true, ..player(rect(20, 3), 0, 0) }]);
    let mut walker = Walker::new(hero);
    walker.walk(&mut world, 0);
    for turn in 0..600 {
        let speed = if turn / 30 % 2 == 0 { 120 } else { -120 };
        let way = vec2(px(speed) / 60, -px(speed) / 60);
        assert_eq!(world.move_and_collide(lift, way).unwrap(), None, "a one-way platform pushes nothing");
        assert!(walker.walk(&mut world, 0).floor, "lost in turn {turn}");
        assert_eq!(world.body(hero).unwrap().position - world.body(lift).unwrap().position, at(0, -7));
    }
}

#[test]
fn crates_are_pushed_in_a_row_and_never_entered() {
    let mut storage = Box::new(Storage::<Fixed, 16, 64>::new());
    let mut world = storage.world();
    let mut defs = vec![player(rect(5, 8), 0, -8), wall(rect(200, 10), 100, 10), wall(rect(10, 50), 250, -50)];
    defs.extend((0..4).map(|n| BodyDef::rigid(rect(6, 6), at(30 + 30 * n, -6))));
    defs.push(BodyDef::rigid(disc(5), at(170, -5)));
    let all: Vec<_> = defs.iter().map(|def| (world.spawn(def).unwrap(), *def)).collect();
    let hero = all[0].0;
    let mut walker = Walker::new(hero);
    let mut pushed = false;
    for _ in 0..600 {
        let slide = walker.walk(&mut world, 60);
        pushed |= slide.collisions().any(|collision| matches!(collision.collider, Collider::Body(body) if all[3..].iter().any(|(other, _)| *other == body)));
        let outlines = outlines(&world, &all);
        for other in &outlines[1..] {
            assert!(!overlaps(&outlines[0], other), "overlaps {other:?}");
        }
    }
    assert!(pushed);
    // All stand in a row before the wall: 240 - 10 - 4 x 12 - 5.
    let (x, _) = place(&world, hero);
    assert!((x - 177.0).abs() < 0.1, "stopped at {x}");
    // On the way back nothing sticks.
    walker.walk(&mut world, -60);
    assert!((place(&world, hero).0 - x + 1.0).abs() < 1e-3);
    // Pushing is for the game to allow.
    walker.options.push = false;
    for _ in 0..30 {
        walker.walk(&mut world, 60);
    }
    assert!(walker.walk(&mut world, 60).wall);
}

#[test]
fn a_row_of_crates_is_a_floor() {
    let mut storage = Box::new(Storage::<Fixed, 32, 64>::new());
    let mut world = storage.world();
    // What rests is as deep in what bears it as the solver lets it: not all to the last place.
    for n in 0..8 {
        let height = px(-8) + ratio(n * 5 % 8, 200) - ratio(1, 50);
        let hanging = BodyDef { gravity_scale: px(0), ..BodyDef::rigid(rect(8, 8), vec2(px(16 * n), height)) };
        world.spawn(&hanging).unwrap();
    }
    let hero = world.spawn(&player(rect(4, 6), 0, -30)).unwrap();
    let mut walker = Walker::new(hero);
    while !walker.walk(&mut world, 0).floor {}
    for _ in 0..60 {
        let slide = walker.walk(&mut world, 90);
        assert!(
            slide.floor && !slide.wall,
            "stopped at {:?} {:?}",
            place(&world, hero),
            world.bodies().map(|b| b.position).collect::<Vec<_>>()
        );
    }
    assert!((place(&world, hero).0 - 90.0).abs() < 0.1);
}

#[test]
fn sensors_are_reported_and_block_nothing() {
    world!(
        world,
        [
            hero = BodyDef { mask: 1, ..player(rect(4, 4), 0, 0) },
            coin = BodyDef { sensor: true, ..wall(disc(1), 50, 0) },
            gem = BodyDef { sensor: true, ..wall(disc(1), 90, 3) },
            high = BodyDef { sensor: true, ..wall(disc(1), 60, -20) },
            other = BodyDef { sensor: true, layer: 2, mask: 2, ..wall(disc(1), 70, 0) },
        ]
    );
    let options = SlideOptions::default();
    assert_eq!(world.move_and_slide(hero, at(0, 0), &options).unwrap().sensors().count(), 0);
    let slide = world.move_and_slide(hero, at(7200, 0), &options).unwrap();
    let seen: Vec<_> = slide.sensors().collect();
    assert_eq!(seen, [Collider::Body(coin), Collider::Body(gem)]);
    assert_eq!((slide.travel, slide.collisions().count(), slide.sensors_lost), (at(120, 0), 0, 0));
}

#[test]
fn layers_and_visibility_decide_who_is_met() {
    let cases = [
        ((1, u16::MAX), (1, u16::MAX), true),
        ((1, 0), (1, 0), false),
        ((1, 0), (2, 1), true),
        ((1, 2), (2, 0), true),
        ((4, 2), (8, 1), false),
    ];
    for ((layer, mask), (other_layer, other_mask), met) in cases {
        world!(
            world,
            [
                hero = BodyDef { layer, mask, ..player(rect(4, 4), 0, 0) },
                bar = BodyDef { layer: other_layer, mask: other_mask, ..wall(rect(4, 40), 20, 0) },
            ]
        );
        assert_eq!(world.move_and_collide(hero, at(40, 0)).unwrap().is_some(), met);
    }
    for (hero_visible, bar_visible, bar_enabled, met) in
        [(true, true, true, true), (false, true, true, false), (true, false, true, false), (true, true, false, false)]
    {
        world!(
            world,
            [
                hero = BodyDef { visible: hero_visible, ..player(rect(4, 4), 0, 0) },
                bar = BodyDef { visible: bar_visible, enabled: bar_enabled, ..wall(rect(4, 40), 20, 0) },
            ]
        );
        assert_eq!(world.move_and_collide(hero, at(40, 0)).unwrap().is_some(), met);
    }
    world!(world, [hero = BodyDef { enabled: false, ..player(rect(4, 4), 0, 0) }]);
    assert_eq!(world.move_and_collide(hero, at(40, 0)).unwrap(), None);
    assert_eq!(place(&world, hero), (0.0, 0.0));
}

#[test]
fn overlap_is_reported_and_left() {
    world!(world, [hero = player(rect(4, 4), 0, 0), block = wall(rect(20, 20), 0, 22)]);
    let deeper = world.move_and_collide(hero, at(0, 5)).unwrap().expect("it leads deeper");
    assert_eq!((deeper.depth, deeper.travel), (px(2), at(0, 0)));
    assert_eq!(world.move_and_collide(hero, at(10, -1)).unwrap(), None);
    assert_eq!(place(&world, hero), (10.0, -1.0));
    let slide = world.move_and_slide(hero, at(0, 60), &SlideOptions::default()).unwrap();
    assert!(slide.floor);
    assert_eq!(place(&world, hero), (10.0, -2.0));
}
