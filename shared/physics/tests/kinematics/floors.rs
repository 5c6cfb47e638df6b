//! Floors, walls, slopes, seams and ledges under a walker.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Fixed, Scalar, Shape, SlideOptions, Storage, vec2};

use crate::{Real, Walker, at, disc, height, ledge, place, player, rect, wall};

#[test]
fn floors_walls_and_ceilings_are_told_apart() {
    let options = SlideOptions::default();
    for (velocity, floor, wall_met, ceiling) in [
        (at(0, 600), true, false, false),
        (at(600, 0), false, true, false),
        (at(-600, 0), false, true, false),
        (at(0, -600), false, false, true),
        (at(600, 600), true, true, false),
    ] {
        world!(
            world,
            [
                hero = player(rect(4, 4), 0, 0),
                below = wall(rect(50, 5), 0, 10),
                above = wall(rect(50, 5), 0, -10),
                left = wall(rect(5, 50), -10, 0),
                right = wall(rect(5, 50), 10, 0),
            ]
        );
        let slide = world.move_and_slide(hero, velocity, &options).unwrap();
        assert_eq!((slide.floor, slide.wall, slide.ceiling), (floor, wall_met, ceiling), "{velocity:?}");
        assert_eq!(slide.velocity, at(0, 0), "{velocity:?}");
        // As seen from above there are only walls.
        let slide = world.move_and_slide(hero, velocity, &SlideOptions { up: at(0, 0), ..options }).unwrap();
        assert_eq!((slide.floor, slide.wall, slide.ceiling), (false, true, false));
        // What is up is for the game to say.
        let slide = world.move_and_slide(hero, velocity, &SlideOptions { up: at(0, 9), ..options }).unwrap();
        assert_eq!((slide.floor, slide.ceiling), (ceiling, floor));
    }
}

#[test]
fn a_slope_is_a_floor_up_to_45_degrees() {
    for (x, floor) in [(0, true), (60, true), (70, true), (72, false), (90, false)] {
        // Touches a disc of radius 100 at an angle whose sine is x / 100.
        let height = (10_000.0 - f64::from(x * x)).sqrt();
        world!(
            world,
            [
                hero = BodyDef::kinematic(
                    disc(5),
                    vec2(Real::from_num(f64::from(x) * 1.05), Real::from_num(-height * 1.05 - 1.0))
                ),
                hill = wall(disc(100), 0, 0),
            ]
        );
        let slide = world.move_and_slide(hero, at(0, 120), &SlideOptions::default()).unwrap();
        assert_eq!((slide.floor, slide.wall), (floor, !floor), "at {x}");
    }
}

#[test]
fn seams_between_floors_cannot_be_felt() {
    for shape in [rect(4, 6), disc(6)] {
        for phase in 0..16 {
            let mut storage = Box::new(Storage::<Fixed, 64, 16>::new());
            let mut world = storage.world();
            for tile in 0..40 {
                world.spawn(&wall(rect(8, 8), 16 * tile, 14)).unwrap();
            }
            let start = vec2(px(phase) + ratio(phase, 16), px(0));
            let mut walker = Walker::new(world.spawn(&BodyDef::kinematic(shape, start)).unwrap());
            for speed in [15, 60, 150, 480] {
                for _ in 0..50 {
                    let slide = walker.walk(&mut world, speed);
                    assert!(slide.floor && !slide.wall);
                    assert_eq!((slide.travel, slide.velocity), (vec2(px(speed) / 60, px(0)), at(speed, 0)));
                }
            }
        }
    }
}

/// Walks a box over seams and off the end, in any number format; where it ends.
fn stroll<S: Scalar>() -> (S::Real, S::Real) {
    let pair = |x: i16, y: i16| vec2(S::real(px(x)), S::real(px(y)));
    let mut storage = Box::new(Storage::<S, 64, 16>::new());
    let mut world = storage.world();
    let tile = Shape::Box { half: pair(8, 8) };
    for column in 0..30 {
        world.spawn(&BodyDef::fixed(tile, pair(16 * column, 100 + 16 * (column / 20)))).unwrap();
    }
    let walker = Shape::Box { half: pair(4, 6) };
    let hero = world.spawn(&BodyDef::kinematic(walker, vec2(S::real(ratio(1, 3)), S::real(px(80))))).unwrap();
    let (mut options, mut velocity) = (SlideOptions::default(), pair(0, 0));
    for count in 0..150 {
        velocity = vec2(S::real(px(150)), velocity.y + S::real(px(10)));
        let slide = world.move_and_slide(hero, velocity, &options).unwrap();
        assert!(!slide.wall, "stopped in step {count} at {:?}", world.body(hero).unwrap().position);
        (velocity, options.footing) = (slide.velocity, slide.footing);
    }
    let end = world.body(hero).unwrap().position;
    (end.x, end.y)
}

#[test]
fn floats_walk_as_fixed_point_does() {
    let (fixed, single, double) = (stroll::<Fixed>(), stroll::<f32>(), stroll::<f64>());
    assert_eq!(fixed.1, px(102));
    assert!((single.0 - fixed.0.to_num::<f32>()).abs() < 0.01 && (single.1 - 102.0).abs() < 0.01, "{single:?}");
    assert!((double.0 - fixed.0.to_num::<f64>()).abs() < 0.01 && (double.1 - 102.0).abs() < 1e-9, "{double:?}");
}

#[test]
fn a_floor_that_falls_away_is_followed_unless_the_body_jumps() {
    world!(
        world,
        [hero = player(rect(4, 4), 0, -4), upper = wall(rect(10, 10), 0, 10), lower = wall(rect(50, 10), 60, 12),]
    );
    let mut walker = Walker::new(hero);
    for _ in 0..60 {
        assert!(walker.walk(&mut world, 60).floor, "left the floor at {:?}", place(&world, hero));
    }
    assert_eq!(height(&world, hero), px(-2));
    // Without a floor under it before, nothing snaps: it falls.
    let unfooted = SlideOptions::default();
    world.move_and_collide(hero, at(0, -1)).unwrap();
    assert!(!world.move_and_slide(hero, at(60, 0), &unfooted).unwrap().floor);
    walker.options.footing = None;
    walker.walk(&mut world, 0);
    while !walker.walk(&mut world, 0).floor {}
    walker.velocity.y = px(-50);
    let jump = walker.walk(&mut world, 0);
    assert!(!jump.floor && jump.travel.y < px(0));
}

#[test]
fn a_ledge_holds_what_lands_on_it_and_nothing_else() {
    world!(
        world,
        [hero = player(rect(4, 4), 0, 60), shelf = ledge(rect(20, 2), 0, 0), floor = wall(rect(90, 9), 0, 99)]
    );
    let mut walker = Walker::new(hero);
    // From below: through it, at any height of the jump, also with the apex inside.
    for rise in 1..140 {
        let up = world.move_and_collide(hero, at(0, -rise)).unwrap();
        assert_eq!(up, None, "blocked from below at {rise}");
        let (_, top) = place(&world, hero);
        let down = world.move_and_collide(hero, at(0, rise)).unwrap();
        assert_eq!(down.is_some(), top <= -6.0, "from {top}");
        if down.is_some() {
            assert_eq!(height(&world, hero), px(-6));
            assert_eq!(world.move_and_collide(hero, at(30, 0)).unwrap(), None);
            world.move_and_collide(hero, at(0, 66)).unwrap();
            world.move_and_collide(hero, at(-30, 0)).unwrap();
        }
        assert_eq!(place(&world, hero), (0.0, 60.0));
    }
    // However fast.
    world.move_and_collide(hero, at(0, -8000)).unwrap();
    assert!(world.move_and_collide(hero, at(0, 8056)).unwrap().is_some());
    assert_eq!(height(&world, hero), px(-6));
    world.move_and_collide(hero, at(30, 0)).unwrap();
    world.move_and_collide(hero, at(-30, 66)).unwrap();
    // From the side: through it.
    world.move_and_collide(hero, at(-60, -60)).unwrap();
    assert_eq!(world.move_and_collide(hero, at(120, 0)).unwrap(), None);
    world.move_and_collide(hero, at(-60, -40)).unwrap();
    // It stays for a minute, then drops on request, and only then.
    for _ in 0..3600 {
        walker.walk(&mut world, 0);
    }
    assert_eq!(place(&world, hero), (0.0, -6.0));
    walker.options.drop_through = true;
    walker.walk(&mut world, 0);
    walker.options.drop_through = false;
    while !walker.walk(&mut world, 0).floor {}
    assert_eq!(height(&world, hero), px(86));
}

#[test]
fn the_end_of_a_ledge_is_no_wall() {
    for shape in [rect(4, 4), disc(4)] {
        for side in [-1, 1] {
            for y in -5..8 {
                world!(world, [hero = player(shape, 40 * side, y), shelf = ledge(rect(20, 2), 0, 0)]);
                assert_eq!(world.move_and_collide(hero, at(-80 * side, 0)).unwrap(), None, "{shape:?} at {y}");
            }
        }
    }
    // What stands on it may stick out, and falls where its middle, or for a box its last px, has left it.
    world!(
        world,
        [hero = player(rect(4, 4), 23, -40), ball = player(disc(4), -21, -40), shelf = ledge(rect(20, 2), 0, 0)]
    );
    let (mut walker, mut roller) = (Walker::new(hero), Walker::new(ball));
    for _ in 0..120 {
        walker.walk(&mut world, 0);
        roller.walk(&mut world, 0);
    }
    assert_eq!(place(&world, hero), (23.0, -6.0));
    assert!(place(&world, ball).1 > 20.0, "rolls off");
    for _ in 0..60 {
        walker.walk(&mut world, 4);
    }
    assert!(place(&world, hero).1 > 20.0, "steps off");
}
