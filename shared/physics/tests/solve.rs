//! What bodies do when they meet.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{
    BodyDef, BodyView, Config, Effects, Fixed, Handle, Material, Scalar, Shape, Stage, Storage, Vec2, World, digest,
    step, vec2,
};
use proptest::prelude::*;

const USUAL: Effects = Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::FRICTION);
const ELASTIC: Material<Fixed> = Material::DEFAULT;
const DULL: Material<Fixed> = Material { bounce: false, ..ELASTIC };

fn disc(x: I16F16, y: I16F16) -> BodyDef<Fixed> {
    BodyDef::rigid(Shape::Circle { radius: px(5) }, vec2(x, y))
}

fn floor() -> BodyDef<Fixed> {
    BodyDef::fixed(Shape::Box { half: vec2(px(500), px(8)) }, vec2(px(0), px(8)))
}

fn velocity(body: &BodyView<Fixed>) -> Vec2<f64> {
    body.velocity.map(|v| Fixed::px_per_second(v).to_num())
}

/// Two discs meet head on; their speeds afterwards, px/s.
fn collide(material: Material<Fixed>, masses: (I16F16, I16F16), speeds: (i16, i16), effects: Effects) -> (f64, f64) {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    let left = BodyDef { mass: masses.0, velocity: vec2(px(speeds.0), px(0)), material, ..disc(px(0), px(0)) };
    let right = BodyDef { mass: masses.1, velocity: vec2(px(speeds.1), px(0)), material, ..disc(px(12), px(0)) };
    let handles = [left, right].map(|def| world.spawn(&def).unwrap());
    for _ in 0..20 {
        step(&mut world, effects);
    }
    let [a, b] = handles.map(|handle| velocity(&world.body(handle).unwrap()).x);
    (a, b)
}

fn assert_close(got: f64, expected: f64) {
    assert!((got - expected).abs() < 1e-3, "got {got}, expected {expected}");
}

#[test]
fn equal_masses_swap_speeds_in_an_elastic_collision() {
    let (a, b) = collide(ELASTIC, (px(1), px(1)), (60, -30), USUAL);
    assert_close(a, -30.0);
    assert_close(b, 60.0);
}

#[test]
fn masses_decide_who_gives_way() {
    let (a, b) = collide(ELASTIC, (px(3), px(1)), (60, 0), USUAL);
    assert_close(a, 30.0);
    assert_close(b, 90.0);
    let (a, b) = collide(DULL, (px(3), px(1)), (60, 0), USUAL);
    assert_close(a, 45.0);
    assert_close(b, 45.0);
}

#[test]
fn restitution_returns_its_part_of_the_speed_and_both_must_bounce() {
    let half = Material { restitution: ratio(1, 2), ..ELASTIC };
    let (a, b) = collide(half, (px(1), px(1)), (60, 0), USUAL);
    assert_close(b - a, 30.0);
    let (a, b) = collide(Material { bounce: false, ..half }, (px(1), px(1)), (60, 0), USUAL);
    assert_close(b - a, 0.0);
}

#[test]
fn slow_contacts_do_not_bounce() {
    let config =
        |threshold| Config { velocity_threshold: px(threshold), gravity: Vec2::default(), ..Config::default() };
    let rebound = |threshold| {
        let mut storage = Storage::<Fixed, 2, 4>::new();
        let mut world = storage.world();
        world.configure(config(threshold)).unwrap();
        world.spawn(&floor()).unwrap();
        let ball = world.spawn(&BodyDef { velocity: vec2(px(0), px(20)), ..disc(px(0), px(-5)) }).unwrap();
        step(&mut world, USUAL);
        velocity(&world.body(ball).unwrap()).y
    };
    assert_close(rebound(19), -20.0);
    assert_close(rebound(21), 0.0);
}

/// A ball hits the floor under gravity 600 px/s2; its velocity right after, px/s.
fn rebound_under_gravity(speed: i16) -> f64 {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.configure(Config { gravity: vec2(px(0), px(600)), ..Config::default() }).unwrap();
    world.spawn(&floor()).unwrap();
    let ball = world.spawn(&BodyDef { velocity: vec2(px(0), px(speed)), ..disc(px(0), px(-5)) }).unwrap();
    step(&mut world, USUAL);
    velocity(&world.body(ball).unwrap()).y
}

/// What gravity 600 px/s2 adds in a step, px/s.
const PULL: f64 = 10.0;

#[test]
fn a_bounce_returns_the_speed_from_before_gravity() {
    assert_close(rebound_under_gravity(100), -100.0 + PULL);
}

#[test]
fn what_gravity_adds_in_two_steps_never_bounces() {
    assert_close(rebound_under_gravity(19), 0.0);
    assert_close(rebound_under_gravity(0), 0.0);
    assert_close(rebound_under_gravity(21), -21.0 + PULL);
}

#[test]
fn friction_stops_a_box_after_v_squared_over_2_mu_g() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.configure(Config { gravity: vec2(px(0), px(600)), ..Config::default() }).unwrap();
    let material = Material { friction: ratio(3, 10), ..DULL };
    world.spawn(&BodyDef { material, ..floor() }).unwrap();
    let shape = Shape::Box { half: vec2(px(6), px(6)) };
    let start = BodyDef { material, velocity: vec2(px(100), px(0)), ..BodyDef::rigid(shape, vec2(px(0), px(-6))) };
    let sliding = world.spawn(&start).unwrap();
    for _ in 0..120 {
        step(&mut world, USUAL);
    }
    let body = world.body(sliding).unwrap();
    let distance: f64 = body.position.x.to_num();
    assert_eq!(body.velocity, Vec2::default());
    // v^2 / (2 mu g) = 27.78 px; a step's worth of the first speed, 1.67 px, comes off in whole steps.
    assert!((distance - 27.78).abs() < 1.0, "{distance}");
}

#[test]
fn penetration_shrinks_by_the_bias_down_to_the_slop() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    let config = Config { gravity: Vec2::default(), bias: ratio(1, 4), slop: ratio(1, 2), ..Config::default() };
    world.configure(config).unwrap();
    world.spawn(&floor()).unwrap();
    let ball = world.spawn(&disc(px(0), px(-3))).unwrap(); // 2 px deep
    let depth = |world: &World<'_, Fixed>| 5.0 + world.body(ball).unwrap().position.y.to_num::<f64>();
    step(&mut world, USUAL);
    // Towards half of the slop, so that the correction comes to an end.
    assert_close(depth(&world), 2.0 - 0.25 * 1.75);
    for _ in 0..100 {
        step(&mut world, USUAL);
    }
    let end = depth(&world);
    assert!(end > 0.25 && end <= 0.5, "{end}");
    step(&mut world, USUAL);
    assert_close(depth(&world), end);
}

#[test]
fn more_iterations_leave_less_approach_speed_in_a_row() {
    let approach = |iterations| {
        let mut storage = Storage::<Fixed, 8, 16>::new();
        let mut world = storage.world();
        world.configure(Config { velocity_iterations: iterations, ..Config::default() }).unwrap();
        for place in 0..6 {
            let speed = px(if place == 0 { 60 } else { 0 });
            let def = disc(px(10 * place), px(0));
            world.spawn(&BodyDef { velocity: vec2(speed, px(0)), material: DULL, ..def }).unwrap();
        }
        Stage::Detect.run(&mut world, Effects::NONE);
        Stage::SolveVelocity.run(&mut world, Effects::NONE);
        let speeds: Vec<f64> = world.bodies().map(|body| velocity(&body).x).collect();
        speeds.windows(2).map(|pair| (pair[0] - pair[1]).max(0.0)).sum::<f64>()
    };
    assert!(approach(8) < 0.6 * approach(2), "{} {}", approach(8), approach(2));
}

#[test]
fn gravity_scale_multiplies_gravity() {
    let fall = |scale| {
        let mut storage = Storage::<Fixed, 1, 1>::new();
        let mut world = storage.world();
        let ball = world.spawn(&BodyDef { gravity_scale: scale, ..disc(px(0), px(0)) }).unwrap();
        for _ in 0..60 {
            step(&mut world, Effects::GRAVITY);
        }
        velocity(&world.body(ball).unwrap()).y
    };
    for (scale, expected) in [(px(1), 200.0), (px(0), 0.0), (ratio(-1, 2), -100.0), (px(2), 400.0)] {
        assert_close(fall(scale), expected);
    }
}

/// Bodies that are thrown together: numbers, whole and fractional.
fn crowd() -> impl Strategy<Value = Vec<BodyDef<Fixed>>> {
    let body = (
        -2_000_000..2_000_000i32,
        -2_000_000..2_000_000i32,
        -300..300i16,
        -300..300i16,
        1..20i16,
        any::<bool>(),
        0..4i16,
    );
    prop::collection::vec(body, 2..24).prop_map(|bodies| {
        let define = |(x, y, vx, vy, size, circle, kind): (i32, i32, i16, i16, i16, bool, i16)| {
            let shape = if circle {
                Shape::Circle { radius: px(size) }
            } else {
                Shape::Box { half: vec2(px(size), px(21 - size)) }
            };
            let position = vec2(I16F16::from_bits(x), I16F16::from_bits(y));
            let material = Material { restitution: ratio(kind, 4), friction: ratio(kind, 5), bounce: kind != 3 };
            if kind == 0 && circle {
                BodyDef { material, ..BodyDef::fixed(shape, position) }
            } else {
                let (velocity, mass) = (vec2(px(vx), px(vy)), px(kind + 1));
                BodyDef { velocity, mass, material, ..BodyDef::rigid(shape, position) }
            }
        };
        bodies.into_iter().map(define).collect()
    })
}

/// Runs a crowd inserted in the given order; bits of every body, by its place in `defs`.
fn outcome(
    defs: &[BodyDef<Fixed>],
    order: &[usize],
    steps: u32,
    switches: impl flat_physics::Switches,
) -> Vec<[i64; 4]> {
    use flat_physics::Quantity;
    let mut storage = Box::new(Storage::<Fixed, 24, 512>::new());
    let mut world = storage.world();
    let mut handles: Vec<Option<Handle>> = vec![None; defs.len()];
    for &place in order {
        handles[place] = Some(world.spawn(&defs[place]).unwrap());
    }
    for _ in 0..steps {
        step(&mut world, switches);
    }
    let bits = |body: BodyView<Fixed>| {
        [body.position.x.bits(), body.position.y.bits(), body.velocity.x.bits(), body.velocity.y.bits()]
    };
    handles.iter().map(|handle| bits(world.body(handle.unwrap()).unwrap())).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_order_of_insertion_changes_no_bit(defs in crowd(), seed: u64) {
        let forward: Vec<_> = (0..defs.len()).collect();
        let mut shuffled = forward.clone();
        shuffled.sort_by_key(|&place| (place as u64 + 1).wrapping_mul(seed | 1).rotate_left(17));
        prop_assert_eq!(outcome(&defs, &forward, 60, USUAL), outcome(&defs, &shuffled, 60, USUAL));
    }

    #[test]
    fn moving_the_world_by_whole_px_changes_no_bit(defs in crowd(), dx in -16_000..16_000i16, dy in -16_000..16_000i16) {
        let order: Vec<_> = (0..defs.len()).collect();
        let moved: Vec<_> = defs
            .iter()
            .map(|def| BodyDef { position: vec2(def.position.x + px(dx), def.position.y + px(dy)), ..*def })
            .collect();
        let here = outcome(&defs, &order, 30, Effects::BOUNCE | Effects::FRICTION);
        let there = outcome(&moved, &order, 30, Effects::BOUNCE | Effects::FRICTION);
        for (here, there) in here.iter().zip(there) {
            let shift = |axis: usize, by: i16| here[axis] + (i64::from(by) << 16);
            prop_assert_eq!([shift(0, dx), shift(1, dy), here[2], here[3]], there);
        }
    }

    #[test]
    fn collisions_keep_momentum_to_a_unit_of_the_last_place_a_contact(defs in crowd()) {
        let mut storage = Box::new(Storage::<Fixed, 24, 512>::new());
        let mut world = storage.world();
        // Static bodies would take momentum away.
        let rigid: Vec<_> = defs.iter().map(|def| BodyDef { kind: flat_physics::Kind::Rigid, mass: px(1), ..*def }).collect();
        for def in &rigid {
            world.spawn(def).unwrap();
        }
        let momentum = |world: &World<'_, Fixed>| {
            world.bodies().fold([0i64; 2], |sum, body| {
                [sum[0] + i64::from(body.velocity.x.to_bits()), sum[1] + i64::from(body.velocity.y.to_bits())]
            })
        };
        for _ in 0..30 {
            Stage::Detect.run(&mut world, USUAL);
            let before = momentum(&world);
            Stage::SolveVelocity.run(&mut world, USUAL);
            let after = momentum(&world);
            let visits = i64::from(world.config().velocity_iterations) * i64::from(world.statistics().contacts);
            prop_assert!((after[0] - before[0]).abs() <= visits && (after[1] - before[1]).abs() <= visits);
            Stage::IntegratePosition.run(&mut world, USUAL);
        }
    }

    #[test]
    fn an_effect_that_is_off_equals_neutral_inputs(defs in crowd()) {
        let order: Vec<_> = (0..defs.len()).collect();
        let smooth = |def: &BodyDef<Fixed>| Material { friction: px(0), ..def.material };
        let neutral: Vec<_> = defs.iter().map(|def| BodyDef { material: smooth(def), ..*def }).collect();
        let off = Effects::GRAVITY | Effects::BOUNCE;
        prop_assert_eq!(outcome(&defs, &order, 40, off), outcome(&neutral, &order, 40, USUAL));

        let dead = |def: &BodyDef<Fixed>| Material { restitution: px(0), ..def.material };
        let neutral: Vec<_> = defs.iter().map(|def| BodyDef { material: dead(def), ..*def }).collect();
        let off = Effects::GRAVITY | Effects::FRICTION;
        prop_assert_eq!(outcome(&defs, &order, 40, off), outcome(&neutral, &order, 40, USUAL));
    }
}

#[test]
fn a_digest_tells_any_bit_of_any_body() {
    let mut storage = Storage::<Fixed, 4, 8>::new();
    let mut world = storage.world();
    for place in 0..4 {
        world.spawn(&disc(px(30 * place), px(0))).unwrap();
    }
    let before = digest(&world);
    for slot in 0..4 {
        for bit in 0..32 {
            world.flip_velocity_bit(slot, bit).unwrap();
            assert_ne!(digest(&world), before, "slot {slot} bit {bit}");
            world.flip_velocity_bit(slot, bit).unwrap();
        }
    }
    assert_eq!(digest(&world), before);
}

#[test]
fn a_circle_rolls_over_seams_between_static_boxes_as_over_one() {
    for (speed, gravity) in [(30, 200), (240, 200), (480, 600)] {
        let mut storage = Storage::<Fixed, 128, 512>::new();
        let mut world = storage.world();
        world.configure(Config { gravity: vec2(px(0), px(gravity)), ..Config::default() }).unwrap();
        let half = vec2(px(8), px(4));
        for number in 0..100 {
            let tile = BodyDef::fixed(Shape::Box { half }, vec2(px(8 + 16 * number), px(4)));
            world.spawn(&BodyDef { material: DULL, ..tile }).unwrap();
        }
        let circle = BodyDef::rigid(Shape::Circle { radius: px(6) }, vec2(px(20), px(-6)));
        let circle = world.spawn(&BodyDef { material: DULL, velocity: vec2(px(speed), px(0)), ..circle }).unwrap();
        let before = world.body(circle).unwrap();
        for n in 0..180 {
            step(&mut world, Effects::GRAVITY);
            let now = world.body(circle).unwrap();
            assert_eq!(
                (now.velocity, now.position.y),
                (before.velocity, before.position.y),
                "{speed} px/s, gravity {gravity}, step {n}"
            );
        }
    }
}

#[test]
fn a_column_knows_its_load_from_the_second_step_on() {
    let mut storage = Storage::<Fixed, 16, 64>::new();
    let mut world = storage.world();
    let square = Shape::Box { half: vec2(px(6), px(6)) };
    let floor = BodyDef { material: DULL, ..BodyDef::fixed(square, vec2(px(0), px(6))) };
    let floor = world.spawn(&floor).unwrap();
    for level in 0..10 {
        let member = BodyDef::rigid(square, vec2(px(0), px(-6 - 12 * level)));
        world.spawn(&BodyDef { material: DULL, ..member }).unwrap();
    }
    for n in 1..=4 {
        step(&mut world, Effects::GRAVITY);
        let contact = world.contacts().find(|contact| contact.bodies.contains(&floor)).unwrap();
        // 10 m g dt, as a speed in px per step.
        let part = contact.impulse.x.to_num::<f64>() / (10.0 * 200.0 / 3600.0);
        assert!(n == 1 || (part - 1.0).abs() < 1e-3, "step {n}: {part} of the load");
    }
}
