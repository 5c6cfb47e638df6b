//! Bodies that the game moves: what stops them, what they slide along, ride, push and notice.

use fixed::types::I16F16;
use flat_physics::geometry::{Outline, overlaps, penetration};
use flat_physics::scalar::{px, ratio};
use flat_physics::tiles::{BehaviorLayer, TileFlags};
use flat_physics::world::Terrain;
use flat_physics::{
    BodyDef, Collider, Effects, Error, Field, Fixed, Handle, Scalar, Shape, Slide, SlideOptions, Storage, Vec2, World,
    step, vec2,
};
use proptest::prelude::*;

type Real = I16F16;

const GRAVITY: i16 = 600;

fn rect(w: i16, h: i16) -> Shape<Fixed> {
    Shape::Box { half: vec2(px(w), px(h)) }
}
fn disc(r: i16) -> Shape<Fixed> {
    Shape::Circle { radius: px(r) }
}
fn at(x: i16, y: i16) -> Vec2<Real> {
    vec2(px(x), px(y))
}
fn wall(shape: Shape<Fixed>, x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef::fixed(shape, at(x, y))
}
fn player(shape: Shape<Fixed>, x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef::kinematic(shape, at(x, y))
}
fn ledge(shape: Shape<Fixed>, x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { one_way: true, ..wall(shape, x, y) }
}

/// Builds a world from definitions; the first one is the player.
macro_rules! world {
    ($world:ident, [$($body:ident = $def:expr),* $(,)?]) => {
        let mut storage = Box::new(Storage::<Fixed, 64, 128, 64>::new());
        #[allow(unused_mut)] // some tests only look
        let mut $world = storage.world();
        $(#[allow(unused_variables)] // named for the reader
        let $body = $world.spawn(&$def).unwrap();)*
    };
}

fn place(world: &World<'_, Fixed>, body: Handle) -> (f64, f64) {
    let position = world.body(body).unwrap().position;
    (position.x.to_num(), position.y.to_num())
}

fn height(world: &World<'_, Fixed>, body: Handle) -> Real {
    world.body(body).unwrap().position.y
}

/// A walker with gravity, as a game would drive it.
struct Walker {
    body: Handle,
    velocity: Vec2<Real>,
    options: SlideOptions<Fixed>,
}

impl Walker {
    fn new(body: Handle) -> Self {
        Self { body, velocity: at(0, 0), options: SlideOptions::default() }
    }

    /// A step of the world and one of the walker, who keeps to a horizontal speed.
    fn walk(&mut self, world: &mut World<'_, Fixed>, speed: i16) -> Slide<Fixed> {
        step(world, Effects::ALL);
        let fall = px(GRAVITY) / 60;
        let slide = world.move_and_slide(self.body, vec2(px(speed), self.velocity.y + fall), &self.options).unwrap();
        self.velocity = slide.velocity;
        self.options.footing = slide.footing;
        slide
    }
}

fn outlines(world: &World<'_, Fixed>, defs: &[(Handle, BodyDef<Fixed>)]) -> Vec<Outline<Fixed>> {
    defs.iter().map(|(body, def)| Outline::new(&def.shape, world.body(*body).unwrap().position)).collect()
}

#[test]
fn a_motion_ends_in_touch_with_what_is_met_first() {
    world!(
        world,
        [
            hero = player(rect(4, 4), 0, 0),
            far = wall(rect(5, 50), 200, 0),
            near = wall(rect(5, 50), 100, 0),
            beside = wall(rect(50, 5), 50, 9),
        ]
    );
    let collision = world.move_and_collide(hero, at(300, 0)).unwrap().expect("a wall");
    assert_eq!(collision.collider, Collider::Body(near));
    assert_eq!(collision.normal, vec2(-Fixed::UNIT, Fixed::UNIT - Fixed::UNIT));
    assert_eq!((collision.travel, collision.remainder, collision.depth), (at(91, 0), at(209, 0), px(0)));
    assert_eq!(place(&world, hero), (91.0, 0.0));
    // Touching doesn't block what leads along or away, and blocks at once what leads in.
    assert_eq!(world.move_and_collide(hero, at(0, -20)).unwrap(), None);
    let blocked = world.move_and_collide(hero, at(1, 0)).unwrap().expect("still there");
    assert_eq!((blocked.travel, blocked.remainder), (at(0, 0), at(1, 0)));
    assert_eq!(world.move_and_collide(hero, at(-91, 20)).unwrap(), None);
    assert_eq!(place(&world, hero), (0.0, 0.0));
}

#[test]
fn no_wall_is_too_thin_and_no_motion_too_long() {
    let thin = Real::from_bits(1);
    for shape in [rect(3, 3), disc(3), Shape::Circle { radius: thin }, Shape::Box { half: vec2(thin, thin) }] {
        world!(
            world,
            [
                hero = player(shape, -16_384, 0),
                film = BodyDef::fixed(Shape::Box { half: vec2(thin, px(40)) }, at(7, 0)),
            ]
        );
        let collision = world.move_and_collide(hero, at(32_767, 0)).unwrap().expect("a film");
        let right = world.body(hero).unwrap().position.x + shape.half_extents().x;
        let gap = px(7) - thin - right;
        assert!(gap >= px(0) && gap <= Real::from_bits(2), "{shape:?} stops {gap} before the film");
        assert_eq!(collision.collider, Collider::Body(film));
    }
}

#[test]
fn what_may_not_be_moved_is_refused_and_nothing_changes() {
    world!(world, [hero = player(rect(4, 4), 16_000, 0), crate_ = BodyDef::rigid(rect(4, 4), at(0, 0))]);
    let before = flat_physics::digest(&world);
    let options = SlideOptions::default();
    assert_eq!(world.move_and_collide(crate_, at(1, 0)), Err(Error::NotKinematic { handle: crate_ }));
    assert_eq!(world.move_and_slide(crate_, at(1, 0), &options).unwrap_err(), Error::NotKinematic { handle: crate_ });
    let range = (-16_384, 16_384);
    assert_eq!(
        world.move_and_collide(hero, at(400, 0)),
        Err(Error::OutOfRange { field: Field::PositionX, value: px(16_400), range })
    );
    let fast = world.move_and_slide(hero, at(0, 7621), &options).unwrap_err();
    assert_eq!(fast, Error::OutOfRange { field: Field::VelocityY, value: px(7621), range: (-7620, 7620) });
    let wrong = [
        (
            SlideOptions { snap: px(65), ..options },
            Error::OutOfRange { field: Field::Snap, value: px(65), range: (0, 64) },
        ),
        (
            SlideOptions { snap: -px(1), ..options },
            Error::OutOfRange { field: Field::Snap, value: px(-1), range: (0, 64) },
        ),
        (
            SlideOptions { up: at(0, 16_385), ..options },
            Error::OutOfRange { field: Field::UpY, value: px(16_385), range },
        ),
    ];
    for (options, error) in wrong {
        assert_eq!(world.move_and_slide(hero, at(0, 0), &options).unwrap_err(), error);
    }
    assert_eq!(flat_physics::digest(&world), before);
    world.despawn(hero).unwrap();
    assert_eq!(world.move_and_collide(hero, at(0, 0)), Err(Error::NoSuchBody { handle: hero }));
}

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

/// A map of 16 px tiles from its picture: `#` solid, `=` one-way, `o` coin.
fn level<const COLUMNS: usize>(world: &mut World<'_, Fixed>, picture: &[&[u8; COLUMNS]], terrain: &Terrain<Fixed>) {
    let flags = |tile: &u8| match tile {
        b'#' => TileFlags::SOLID,
        b'=' => TileFlags::ONE_WAY,
        b'o' => TileFlags::COLLECTIBLE,
        _ => TileFlags::NONE,
    };
    let bytes: Vec<u8> = picture.iter().flat_map(|row| row.iter().map(|tile| flags(tile).bits())).collect();
    let layer = BehaviorLayer::new(&bytes, COLUMNS as u16, picture.len() as u16).unwrap();
    world.set_tiles(&layer, terrain).unwrap();
}

#[test]
fn tiles_are_floors_walls_ledges_and_coins() {
    world!(world, [hero = player(rect(4, 6), 40, 20)]);
    let picture = [b"            ", b"            ", b"  ==   oo  #", b"           #", b"############"];
    level(&mut world, &picture, &Terrain::DEFAULT);
    let mut walker = Walker::new(hero);
    while !walker.walk(&mut world, 0).floor {}
    assert_eq!(place(&world, hero), (40.0, 26.0), "on the ledge");
    walker.options.drop_through = true;
    while place(&world, hero).1 < 40.0 {
        walker.walk(&mut world, 0);
    }
    walker.options.drop_through = false;
    while !walker.walk(&mut world, 0).floor {}
    assert_eq!(place(&world, hero), (40.0, 58.0), "on the ground");
    loop {
        let slide = walker.walk(&mut world, 150);
        assert!(slide.floor);
        if slide.wall {
            break;
        }
        assert_eq!(slide.velocity, at(150, 0), "at {:?}", place(&world, hero));
    }
    assert_eq!(place(&world, hero), (172.0, 58.0), "at the wall");
    // Up through the coins and back.
    let mut coins = Vec::new();
    walker.velocity.y = px(-150);
    while place(&world, hero).0 > 60.0 {
        for sensor in walker.walk(&mut world, -150).sensors() {
            let Collider::Tile(tile) = sensor else { panic!("no body here") };
            if !coins.contains(&(tile.column, tile.row)) {
                coins.push((tile.column, tile.row));
            }
        }
    }
    assert_eq!(coins, [(8, 2), (7, 2)]);
    // Up through the ledge from below, onto it from above.
    walker.velocity.y = px(-300);
    while !walker.walk(&mut world, -20).floor {}
    assert_eq!(height(&world, hero), px(26));
}

#[test]
fn tiles_let_out_what_is_inside_them_and_through_whom_they_do_not_meet() {
    let picture = [b"     ", b"     ", b"#####"];
    world!(world, [hero = player(rect(4, 6), 40, 29)]);
    level(&mut world, &picture, &Terrain::DEFAULT);
    let slide = world.move_and_slide(hero, at(0, 60), &SlideOptions::default()).unwrap();
    assert!(slide.floor);
    assert_eq!(place(&world, hero), (40.0, 26.0));
    assert!(world.move_and_collide(hero, at(0, 90)).unwrap().is_some());
    let elsewhere = Terrain { layer: 2, mask: 2, ..Terrain::DEFAULT };
    world!(world, [hero = BodyDef { mask: 1, ..player(rect(4, 6), 40, 20) }]);
    level(&mut world, &picture, &elsewhere);
    assert_eq!(world.move_and_collide(hero, at(0, 90)).unwrap(), None);
}

/// A shape of some px, not always whole.
fn shape() -> impl Strategy<Value = Shape<Fixed>> {
    (1 << 14..20 << 16, 1 << 14..20 << 16, any::<bool>()).prop_map(|(w, h, circle)| {
        let (w, h) = (Real::from_bits(w), Real::from_bits(h));
        if circle { Shape::Circle { radius: w } } else { Shape::Box { half: vec2(w, h) } }
    })
}

fn spot(spread: i32) -> impl Strategy<Value = Vec2<Real>> {
    let coordinate = move || prop_oneof![-spread..spread, (-spread >> 16..spread >> 16).prop_map(|whole| whole << 16)];
    (coordinate(), coordinate()).prop_map(|(x, y)| vec2(Real::from_bits(x), Real::from_bits(y)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn nothing_solid_is_ever_entered(
        hero in shape(),
        solids in prop::collection::vec((shape(), spot(150 << 16)), 1..20),
        velocities in prop::collection::vec(spot(4000 << 16), 1..30),
    ) {
        let mut storage = Box::new(Storage::<Fixed, 32, 64>::new());
        let mut world = storage.world();
        let body = world.spawn(&BodyDef::kinematic(hero, at(0, 0))).unwrap();
        let start = Outline::new(&hero, at(0, 0));
        let solids: Vec<_> = solids.iter().map(|(shape, at)| Outline::new(shape, *at)).filter(|solid| !overlaps(&start, solid)).collect();
        for solid in &solids {
            let shape = if solid.circle { Shape::Circle { radius: solid.half.x } } else { Shape::Box { half: solid.half } };
            world.spawn(&BodyDef::fixed(shape, solid.centre)).unwrap();
        }
        // The same, the other way round.
        let mut other_storage = Box::new(Storage::<Fixed, 32, 64>::new());
        let mut other_world = other_storage.world();
        for solid in solids.iter().rev() {
            let shape = if solid.circle { Shape::Circle { radius: solid.half.x } } else { Shape::Box { half: solid.half } };
            other_world.spawn(&BodyDef::fixed(shape, solid.centre)).unwrap();
        }
        let other_body = other_world.spawn(&BodyDef::kinematic(hero, at(0, 0))).unwrap();
        let (mut options, mut other_options) = (SlideOptions::default(), SlideOptions::default());
        for velocity in velocities {
            let slide = world.move_and_slide(body, velocity, &options).unwrap();
            let other = other_world.move_and_slide(other_body, velocity, &other_options).unwrap();
            other_options.footing = other.footing;
            prop_assert_eq!((slide.travel, slide.velocity), (other.travel, other.velocity), "order matters");
            options.footing = slide.footing;
            let position = world.body(body).unwrap().position;
            for solid in &solids {
                // A place beside the way, rounded, may be off by the last place; so may the direction out.
                let depth = penetration(&start.at(position), solid).map_or(px(0), |overlap| overlap.depth);
                prop_assert!(depth <= Real::from_bits(2), "{depth} deep in {solid:?} at {position:?}");
            }
            // What is left of the velocity leads nowhere in.
            let longer = slide.velocity.x.abs() > velocity.x.abs() + velocity.y.abs() || slide.velocity.y.abs() > velocity.x.abs() + velocity.y.abs();
            prop_assert!(!longer, "{velocity:?} became {:?}", slide.velocity);
        }
    }
}

prop_compose! {
    /// Any body at all: small and huge, in the middle and at the ends of the world.
    fn anything()(
        kind in 0..4u8, x in edgy(16_384), y in edgy(16_384), w in edgy(4096), h in edgy(4096), circle: bool, flags in 0..16u8,
    ) -> BodyDef<Fixed> {
        let [w, h] = [w, h].map(|extent| extent.abs().max(Real::from_bits(1)));
        let shape = if circle { Shape::Circle { radius: w } } else { Shape::Box { half: vec2(w, h) } };
        let def = match kind {
            0 => BodyDef::rigid(shape, vec2(x, y)),
            1 => BodyDef::fixed(shape, vec2(x, y)),
            _ => BodyDef::kinematic(shape, vec2(x, y)),
        };
        BodyDef { sensor: flags % 4 == 0, one_way: kind > 0 && flags & 4 != 0, visible: flags != 15, ..def }
    }
}

/// A number up to a limit, often the limit itself or close to 0.
fn edgy(limit: i16) -> impl Strategy<Value = Real> {
    let most = i32::from(limit) << 16;
    prop_oneof![Just(most), Just(-most), -most..=most, (-(8 << 16)..8 << 16), (0u32..30).prop_map(move |n| most >> n)]
        .prop_map(Real::from_bits)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_walk_overflows_at_the_ends_of_the_world(
        defs in prop::collection::vec(anything(), 2..12),
        walks in prop::collection::vec(
            (any::<usize>(), edgy(7620), edgy(7620), edgy(16_384), edgy(16_384), edgy(64), any::<[bool; 2]>()), 1..20,
        ),
    ) {
        let mut storage = Box::new(Storage::<Fixed, 16, 64>::new());
        let mut world = storage.world();
        let bodies: Vec<_> = defs.iter().map(|def| world.spawn(def).unwrap()).collect();
        let mut footing = None;
        for (who, vx, vy, ux, uy, snap, [push, drop_through]) in walks {
            let body = bodies[who % bodies.len()];
            let options = SlideOptions { up: vec2(ux, uy), snap: snap.abs(), push, drop_through, footing };
            if let Ok(slide) = world.move_and_slide(body, vec2(vx, vy), &options) {
                footing = slide.footing;
            }
            let _ = world.move_and_collide(body, vec2(ux, uy));
        }
    }
}
