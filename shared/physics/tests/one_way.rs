//! One-way platforms: they hold what comes from above, and let pass what comes from elsewhere.

use flat_physics::scalar::{px, ratio};
use flat_physics::{
    BodyDef, Config, Effects, Fixed, Handle, Kind, Level, Material, Scalar, Shape, Storage, Vec2, World, step, vec2,
};

type Real = <Fixed as Scalar>::Real;

const HALF: i16 = 5;

/// Everything that doesn't brake.
const EFFECTS: Effects = Effects::ALL.without(Effects::DAMPING.and(Effects::SPEED_CAP));

fn real(value: f64) -> Real {
    Real::from_num(value)
}

/// 100 x 8 px, its top at y = 0.
fn platform() -> BodyDef<Fixed> {
    let shape = Shape::Box { half: vec2(px(50), px(4)) };
    BodyDef { one_way: true, ..BodyDef::fixed(shape, vec2(px(0), px(4))) }
}

fn lift(speed: Vec2<Real>) -> BodyDef<Fixed> {
    BodyDef { kind: Kind::Kinematic, velocity: speed, ..platform() }
}

/// A box or a circle whose lower edge is at `bottom`.
fn body(circle: bool, x: f64, bottom: f64) -> BodyDef<Fixed> {
    let shape = if circle { Shape::Circle { radius: px(HALF) } } else { Shape::Box { half: vec2(px(HALF), px(HALF)) } };
    let calm = Material { bounce: false, ..Material::DEFAULT };
    BodyDef { material: calm, ..BodyDef::rigid(shape, vec2(real(x), real(bottom - f64::from(HALF)))) }
}

fn bottom(world: &World<'_, Fixed>, handle: Handle) -> f64 {
    world.body(handle).unwrap().position.y.to_num::<f64>() + f64::from(HALF)
}

fn run(world: &mut World<'_, Fixed>, steps: usize) {
    for _ in 0..steps {
        step(world, EFFECTS);
    }
}

/// Where a body's lower edge is after some steps with a platform.
fn after(platform: &BodyDef<Fixed>, body: &BodyDef<Fixed>, steps: usize) -> f64 {
    let mut storage = Storage::<Fixed, 2, 8>::new();
    let mut world = storage.world();
    world.spawn(platform).unwrap();
    let handle = world.spawn(body).unwrap();
    run(&mut world, steps);
    bottom(&world, handle)
}

fn rests(bottom: f64) -> bool {
    bottom.abs() < 0.0625
}

// The eight cases of the original.

#[test]
fn from_above_it_holds() {
    for circle in [false, true] {
        assert!(rests(after(&platform(), &body(circle, 0.0, -30.0), 120)));
    }
}

#[test]
fn from_below_it_lets_pass_and_holds_on_the_way_down() {
    for circle in [false, true] {
        let jump = BodyDef { velocity: vec2(px(0), px(-160)), ..body(circle, 0.0, 30.0) };
        let mut storage = Storage::<Fixed, 2, 8>::new();
        let mut world = storage.world();
        world.spawn(&platform()).unwrap();
        let handle = world.spawn(&jump).unwrap();
        let mut apex = f64::MAX;
        for _ in 0..180 {
            run(&mut world, 1);
            apex = apex.min(bottom(&world, handle));
        }
        assert!((apex - (30.0 - 64.0)).abs() < 0.1, "{apex}: nothing slowed it down"); // v^2 / 2g
        assert!(rests(bottom(&world, handle)));
    }
}

#[test]
fn from_the_sides_it_lets_pass() {
    for (circle, side) in [(false, 1), (false, -1), (true, 1), (true, -1)] {
        let along = vec2(px(120 * side), px(0));
        let def = BodyDef { gravity_scale: px(0), velocity: along, ..body(circle, f64::from(-80 * side), 9.0) };
        let mut storage = Storage::<Fixed, 2, 8>::new();
        let mut world = storage.world();
        world.spawn(&platform()).unwrap();
        let handle = world.spawn(&def).unwrap();
        run(&mut world, 90);
        let body = world.body(handle).unwrap();
        assert_eq!((body.position, body.velocity.x), (vec2(px(100 * side), px(4)), Fixed::speed(px(120 * side))));
    }
}

#[test]
fn moving_upward_it_does_not_land() {
    let def = BodyDef { velocity: vec2(px(0), px(-60)), ..body(false, 0.0, 0.5) };
    let mut storage = Storage::<Fixed, 2, 8>::new();
    let mut world = storage.world();
    world.spawn(&platform()).unwrap();
    let handle = world.spawn(&def).unwrap();
    run(&mut world, 3);
    assert!((bottom(&world, handle) - (0.5 - 3.0 + 0.25)).abs() < 0.1, "{}", bottom(&world, handle));
    run(&mut world, 90);
    assert!(rests(bottom(&world, handle)));
}

#[test]
fn however_fast_it_falls_it_lands() {
    for circle in [false, true] {
        for speed in [500, 750, 1500, 3000, 5000, 7600] {
            for phase in 0..32 {
                let height = -40.0 - f64::from(speed) / 60.0 / 32.0 * f64::from(phase);
                let def = BodyDef { velocity: vec2(px(0), px(speed)), ..body(circle, 0.0, height) };
                let end = after(&platform(), &def, 60);
                assert!(rests(end), "{speed} px/s from {height}: {end}");
            }
        }
    }
}

#[test]
fn a_change_of_direction_within_it_does_not_land() {
    // Its apex lies inside the platform.
    for apex in [-0.5, 1.0, 4.0, 7.5, 9.0] {
        let rise = 20.0_f64;
        let speed = -(2.0 * 200.0 * rise).sqrt();
        let def = BodyDef { velocity: vec2(px(0), real(speed)), ..body(false, 0.0, apex + rise) };
        let end = after(&platform(), &def, 120);
        assert_eq!(rests(end), apex < 0.0, "apex {apex}: {end}");
    }
}

#[test]
fn resting_on_the_surface_it_stays_for_a_minute() {
    for circle in [false, true] {
        let end = after(&platform(), &body(circle, 0.0, 0.0), 3600);
        assert!(rests(end), "{end}");
    }
}

#[test]
fn what_is_not_one_way_holds_from_all_sides() {
    let wall = BodyDef { one_way: false, ..platform() };
    let jump = BodyDef { velocity: vec2(px(0), px(-160)), ..body(false, 0.0, 30.0) };
    assert!(after(&wall, &jump, 12) > 18.0);
    assert!(after(&wall, &jump, 180) > 60.0);
}

#[test]
fn it_carries_up_and_down_and_lets_slide_sideways() {
    for (speed, along) in [(0, 0), (60, 0), (-60, 0), (-500, 0), (120, 0), (0, 10), (0, -10)] {
        for circle in [false, true] {
            let mut storage = Storage::<Fixed, 2, 8>::new();
            let mut world = storage.world();
            let lift = world.spawn(&lift(vec2(px(along), px(speed)))).unwrap();
            let handle = world.spawn(&body(circle, 0.0, -2.0)).unwrap();
            run(&mut world, 120);
            let mut above = 0.0_f64;
            for _ in 0..90 {
                run(&mut world, 1);
                let top = world.body(lift).unwrap().position.y.to_num::<f64>() - 4.0;
                above = above.max((top - bottom(&world, handle)).abs());
            }
            assert!(above < 0.26, "{above} px off at {along}, {speed} px/s");
            assert_eq!(world.body(handle).unwrap().position.x, px(0), "there is no friction");
        }
    }
}

#[test]
fn it_takes_along_what_rubs() {
    let rough = Material { friction: px(1), bounce: false, ..Material::DEFAULT };
    let mut storage = Storage::<Fixed, 2, 8>::new();
    let mut world = storage.world();
    let lift = world.spawn(&BodyDef { material: rough, ..lift(vec2(px(30), px(0))) }).unwrap();
    let handle = world.spawn(&BodyDef { material: rough, ..body(false, 0.0, 0.0) }).unwrap();
    run(&mut world, 600);
    let [platform, body] = [lift, handle].map(|handle| world.body(handle).unwrap().position.x);
    assert!(platform - body < px(5) && rests(bottom(&world, handle)), "{platform} {body}");
}

#[test]
fn a_platform_that_comes_down_on_a_body_lets_it_pass() {
    let mut storage = Storage::<Fixed, 3, 8>::new();
    let mut world = storage.world();
    world.spawn(&lift(vec2(px(0), px(30)))).unwrap();
    world.spawn(&BodyDef { one_way: false, position: vec2(px(0), px(44)), ..platform() }).unwrap();
    let handle = world.spawn(&body(false, 0.0, 40.0)).unwrap();
    run(&mut world, 180);
    assert!((bottom(&world, handle) - 40.0).abs() < 0.0625);
}

#[test]
fn on_request_it_lets_drop_once() {
    for (circle, level) in [(false, Level::Grounded), (true, Level::Flat), (false, Level::Exact), (true, Level::Exact)]
    {
        let mut storage = Storage::<Fixed, 3, 8>::new();
        let mut world = storage.world();
        world.configure(Config::at(level)).unwrap();
        world.spawn(&platform()).unwrap();
        world.spawn(&BodyDef { position: vec2(px(0), px(44)), ..platform() }).unwrap();
        let handle = world.spawn(&body(circle, 0.0, 0.0)).unwrap();
        run(&mut world, 30);
        world.drop_through(handle).unwrap();
        run(&mut world, 120);
        assert!((bottom(&world, handle) - 40.0).abs() < 0.0625, "the next one holds it: {}", bottom(&world, handle));
        world.set_position(handle, vec2(px(0), px(-20))).unwrap();
        run(&mut world, 120);
        assert!(rests(bottom(&world, handle)), "the first one holds it again");
    }
}

#[test]
fn past_the_edge_a_body_falls_without_being_caught() {
    for circle in [false, true] {
        let start = body(circle, 40.0, 0.0);
        let mut storage = Storage::<Fixed, 2, 8>::new();
        let mut world = storage.world();
        world.spawn(&platform()).unwrap();
        let handle = world.spawn(&BodyDef { velocity: vec2(px(120), px(0)), ..start }).unwrap();
        let mut last = 0.0;
        for _ in 0..60 {
            run(&mut world, 1);
            let (x, low) = (world.body(handle).unwrap().position.x, bottom(&world, handle));
            assert!(low >= last - 0.03, "it doesn't rise: {last} {low}");
            if x > px(57) {
                assert!(low > last, "it falls beside the platform at {x}");
            }
            last = low;
        }
        assert!(last > 30.0);
    }
}

#[test]
fn corners_do_not_stop_what_comes_from_the_side() {
    for circle in [false, true] {
        for depth in [0.25, 0.5, 1.0, 3.0, 6.0, 9.5] {
            let along = vec2(px(180), px(0));
            let def = BodyDef { gravity_scale: px(0), velocity: along, ..body(circle, -70.0, depth) };
            let mut storage = Storage::<Fixed, 2, 8>::new();
            let mut world = storage.world();
            world.spawn(&platform()).unwrap();
            let handle = world.spawn(&def).unwrap();
            run(&mut world, 30);
            let body = world.body(handle).unwrap();
            let passed = body.position == vec2(px(20), def.position.y) && body.velocity.x == Fixed::speed(px(180));
            // A circle whose lower half meets the edge may roll up on it.
            let rolled = circle && depth <= 5.0 && bottom(&world, handle) < 0.0625 && body.position.x > px(0);
            assert!(passed || rolled, "{depth} px deep: {:?}", body.position);
        }
    }
}

#[test]
fn a_stack_stands_on_it_and_a_heavy_load_does_not_press_through() {
    for level in [Level::Flat, Level::Grounded, Level::Exact] {
        let mut storage = Storage::<Fixed, 8, 32>::new();
        let mut world = storage.world();
        world.configure(Config::at(level)).unwrap();
        world.spawn(&platform()).unwrap();
        let stack: [Handle; 6] = core::array::from_fn(|n| {
            let mass = if n == 5 && level != Level::Flat { px(500) } else { px(1) };
            world.spawn(&BodyDef { mass, ..body(false, 0.0, -10.5 * n as f64) }).unwrap()
        });
        let beside = world.spawn(&body(true, 30.0, 0.0)).unwrap();
        run(&mut world, 1800);
        let lowest = bottom(&world, stack[0]);
        // Flat lets stacks sink; they still stay on.
        assert!(lowest < if level == Level::Flat { 8.0 } else { 0.0625 }, "{level:?}: {lowest}");
        assert!(stack.iter().all(|&handle| bottom(&world, handle) < 10.0));
        assert!(rests(bottom(&world, beside)));
    }
}

#[test]
fn above_is_against_gravity() {
    let aside = |v: Vec2<Real>| [v, vec2(-v.x, -v.y), vec2(v.y, v.x), vec2(-v.y, -v.x)];
    let gravities = aside(vec2(px(0), px(200)));
    let halves = [vec2(px(50), px(4)), vec2(px(50), px(4)), vec2(px(4), px(50)), vec2(px(4), px(50))];
    let (starts, speeds) = (aside(vec2(px(0), px(-30))), aside(vec2(px(0), px(-160))));
    for (n, gravity) in gravities.into_iter().enumerate() {
        let mut storage = Storage::<Fixed, 3, 8>::new();
        let mut world = storage.world();
        world.configure(Config { gravity, ..Config::default() }).unwrap();
        let def = BodyDef { shape: Shape::Box { half: halves[n] }, position: vec2(px(0), px(0)), ..platform() };
        world.spawn(&def).unwrap();
        let falls = world.spawn(&BodyDef { position: starts[n], ..body(true, 0.0, 0.0) }).unwrap();
        let below = vec2(-starts[n].x, -starts[n].y);
        let across = if n < 2 { vec2(px(20), px(0)) } else { vec2(px(0), px(20)) };
        let jump = BodyDef { position: below + across, velocity: speeds[n], ..body(true, 0.0, 0.0) };
        let jumps = world.spawn(&jump).unwrap();
        run(&mut world, 240);
        for handle in [falls, jumps] {
            let at = world.body(handle).unwrap().position;
            let height =
                if n < 2 { at.y } else { at.x } * if starts[n].x + starts[n].y < px(0) { px(-1) } else { px(1) };
            assert!((height - px(9)).abs() < ratio(1, 16), "{gravity:?}: {height}");
        }
    }
}

#[test]
fn without_the_effect_it_is_a_plain_wall() {
    let mut storage = Storage::<Fixed, 2, 8>::new();
    let mut world = storage.world();
    world.spawn(&platform()).unwrap();
    let handle = world.spawn(&BodyDef { velocity: vec2(px(0), px(-160)), ..body(false, 0.0, 30.0) }).unwrap();
    for _ in 0..20 {
        step(&mut world, EFFECTS.without(Effects::ONE_WAY));
    }
    assert!(bottom(&world, handle) > 17.0);
}
