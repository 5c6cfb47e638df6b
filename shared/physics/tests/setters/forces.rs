//! Masses, materials, layers, gravity and forces, of bodies that are in contact.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Config, Effects, Fixed, Handle, Kind, Material, Scalar, Storage, Vec2, World, step, vec2};

use crate::{DULL, at, at_rest, crate_at, falls, rect, run, speed};

/// Two crates lie side by side; one is pushed by an impulse of 60. Their common speed, px/s, with the right one's mass set first.
fn pushed_together(mass: I16F16) -> f64 {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.configure(Config { gravity: Vec2::default(), ..Config::default() }).unwrap();
    let [left, right] = [0, 10].map(|x| world.spawn(&crate_at(x, 0)).unwrap());
    run(&mut world, 5);
    world.set_mass(right, mass).unwrap();
    world.apply_impulse(left, vec2(px(60), px(0))).unwrap();
    run(&mut world, 5);
    assert!((speed(&world, left).x - speed(&world, right).x).abs() < 0.1);
    speed(&world, right).x
}

#[test]
fn a_mass_counts_in_contacts_that_were_there_before() {
    for (mass, common) in [(px(1), 30.0), (px(3), 15.0), (px(59), 1.0)] {
        let got = pushed_together(mass);
        assert!((got - common).abs() < 0.1, "mass {mass}: {got} px/s, expected {common}");
    }
}

#[test]
fn gravity_can_be_scaled_reversed_and_turned() {
    at_rest(|world, _, body| {
        world.set_gravity_scale(body, px(-1)).unwrap();
        run(world, 60);
        assert!((at(world, body).y + 105.0).abs() < 0.1, "{:?}", at(world, body));
    });
    at_rest(|world, floor, body| {
        let right =
            world.spawn(&BodyDef { material: DULL, ..BodyDef::fixed(rect(10, 100), vec2(px(60), px(-50))) }).unwrap();
        world.configure(Config { gravity: vec2(px(200), px(0)), ..Config::default() }).unwrap();
        let next = world.spawn(&crate_at(-20, -5)).unwrap();
        run(world, 240);
        let [near, far] = [body, next].map(|body| at(world, body).x);
        assert!((near - 50.0).abs() < 0.05 && (far - 40.0).abs() < 0.05, "{near} {far}");
        assert!(world.body(right).is_ok() && world.body(floor).is_ok());
    });
}

#[test]
fn friction_set_under_a_sliding_body_stops_it() {
    at_rest(|world, floor, body| {
        world.set_velocity(body, vec2(px(40), px(0))).unwrap();
        run(world, 60);
        assert!((at(world, body).x - 40.0).abs() < 0.01, "{:?}", at(world, body));
        world.set_friction(body, ratio(1, 2)).unwrap();
        run(world, 1);
        assert!((speed(world, body).x - 40.0).abs() < 0.01, "the lesser of two counts");
        world.set_friction(floor, ratio(1, 4)).unwrap();
        let start = at(world, body).x;
        run(world, 120);
        // v^2 / (2 mu g) = 1600 / 100
        assert!((at(world, body).x - start - 16.0).abs() < 0.2, "{}", at(world, body).x - start);
    });
}

#[test]
fn a_body_bounces_once_it_and_the_floor_are_let() {
    let rebound = |change: fn(&mut World<'_, Fixed>, Handle, Handle)| {
        let mut outcome = 0.0;
        at_rest(|world, floor, body| {
            change(world, floor, body);
            world.set_velocity(body, vec2(px(0), px(100))).unwrap();
            run(world, 1);
            outcome = speed(world, body).y;
        });
        outcome
    };
    let pull = 200.0 / 60.0;
    assert!(rebound(|_, _, _| ()).abs() < 0.1);
    assert!(rebound(|world, _, body| world.set_bounce(body, true).unwrap()).abs() < 0.1, "both must");
    let both = rebound(|world, floor, body| [floor, body].iter().for_each(|&one| world.set_bounce(one, true).unwrap()));
    assert!((both + 100.0 - pull).abs() < 0.2, "{both}");
    let half = rebound(|world, floor, body| {
        world.set_material(floor, Material::DEFAULT).unwrap();
        world.set_material(body, Material { restitution: ratio(1, 2), ..Material::DEFAULT }).unwrap();
    });
    assert!((half + 50.0 - pull).abs() < 0.2, "{half}");
}

#[test]
fn bodies_fall_through_what_they_no_longer_meet() {
    let changes: [fn(&mut World<'_, Fixed>, Handle, Handle); 7] = [
        |world, floor, body| {
            world.set_mask(floor, 0).unwrap();
            world.set_mask(body, 2).unwrap();
        },
        |world, floor, body| {
            world.set_mask(body, 0).unwrap();
            world.set_mask(floor, 2).unwrap();
            world.set_layer(floor, 2).unwrap();
        },
        |world, floor, _| world.set_sensor(floor, true).unwrap(),
        |world, _, body| world.set_sensor(body, true).unwrap(),
        |world, floor, _| world.set_visible(floor, false).unwrap(),
        |world, _, body| world.set_visible(body, false).unwrap(),
        |world, floor, _| world.set_enabled(floor, false).unwrap(),
    ];
    for (number, change) in changes.into_iter().enumerate() {
        at_rest(|world, floor, body| {
            change(world, floor, body);
            assert!(falls(world, body), "change {number}");
        });
    }
}

#[test]
fn bodies_land_again_on_what_they_meet_again() {
    at_rest(|world, floor, body| {
        for hide in [World::set_visible, World::set_enabled, |world: &mut World<'_, Fixed>, handle, on: bool| {
            world.set_sensor(handle, !on)
        }] {
            hide(world, floor, false).unwrap();
            run(world, 2);
            hide(world, floor, true).unwrap();
            run(world, 60);
            assert!((at(world, body).y + 5.0).abs() < 0.05, "{:?}", at(world, body));
        }
        world.set_layer(floor, 0).unwrap();
        world.set_mask(floor, 0).unwrap();
        world.set_mask(body, 0).unwrap();
        run(world, 2);
        world.set_mask(floor, 1).unwrap();
        run(world, 60);
        assert!((at(world, body).y + 5.0).abs() < 0.05, "{:?}", at(world, body));
    });
}

#[test]
fn a_hidden_body_moves_on_and_a_disabled_one_waits() {
    let mut storage = Storage::<Fixed, 3, 8>::new();
    let mut world = storage.world();
    let def = BodyDef { velocity: vec2(px(60), px(0)), ..crate_at(0, 0) };
    let [seen, hidden, disabled] =
        [BodyDef { layer: 2, mask: 0, ..def }, BodyDef { visible: false, ..def }, BodyDef { enabled: false, ..def }]
            .map(|def| world.spawn(&def).unwrap());
    run(&mut world, 60);
    assert_eq!(at(&world, hidden), at(&world, seen));
    assert!((at(&world, seen).y - 100.0).abs() < 0.05);
    assert_eq!((at(&world, disabled), speed(&world, disabled)), (vec2(0.0, 0.0), vec2(60.0, 0.0)));
    assert_eq!(world.statistics().contacts, 0);
    world.set_enabled(disabled, true).unwrap();
    run(&mut world, 60);
    assert!((at(&world, disabled).x - 60.0).abs() < 0.01 && (at(&world, disabled).y - 100.0).abs() < 0.05);
}

#[test]
fn an_impulse_changes_velocity_by_its_share_of_mass_and_never_beyond_the_limit() {
    let mut storage = Storage::<Fixed, 1, 1>::new();
    let mut world = storage.world();
    let body = world.spawn(&BodyDef { mass: px(4), ..crate_at(0, 0) }).unwrap();
    world.apply_impulse(body, vec2(px(120), px(-60))).unwrap();
    world.apply_impulse(body, vec2(px(120), px(0))).unwrap();
    let v = speed(&world, body);
    assert!((v.x - 60.0).abs() < 1e-3 && (v.y + 15.0).abs() < 1e-3, "{v:?}");
    world.set_mass(body, I16F16::from_bits(1)).unwrap();
    world.apply_impulse(body, vec2(px(-32_767), px(32_767))).unwrap();
    let stopped = vec2(Fixed::speed(px(60)) - Fixed::FASTEST, Fixed::FASTEST - Fixed::speed(px(15)));
    assert_eq!(world.body(body).unwrap().velocity, stopped);
    world.apply_impulse(body, vec2(px(-32_767), px(32_767))).unwrap();
    assert_eq!(world.body(body).unwrap().velocity, vec2(-Fixed::FASTEST, Fixed::FASTEST));
}

#[test]
fn a_steady_force_moves_a_body_as_the_closed_form_says() {
    let mut storage = Storage::<Fixed, 1, 1>::new();
    let mut world = storage.world();
    let body = world.spawn(&BodyDef { mass: px(3), velocity: vec2(px(-50), px(0)), ..crate_at(0, 0) }).unwrap();
    for n in 1..=300 {
        world.apply_force(body, vec2(px(70), px(-300))).unwrap();
        world.apply_force(body, vec2(px(20), px(0))).unwrap();
        step(&mut world, Effects::GRAVITY);
        let t = f64::from(n) / 60.0;
        let expected = vec2(-50.0 * t + 15.0 * t * t, 50.0 * t * t);
        let got = at(&world, body);
        assert!((got.x - expected.x).abs() < 1.0 / 64.0 && (got.y - expected.y).abs() < 1.0 / 64.0, "{n} {got:?}");
    }
}

#[test]
fn a_force_lasts_one_step_and_ends_with_its_body() {
    let mut storage = Storage::<Fixed, 1, 1>::new();
    let mut world = storage.world();
    let mut body = world.spawn(&crate_at(0, 0)).unwrap();
    world.apply_force(body, vec2(px(3600), px(0))).unwrap();
    assert_eq!(world.body(body).unwrap().velocity, Vec2::default());
    for _ in 0..3 {
        step(&mut world, Effects::NONE);
        assert!((speed(&world, body).x - 60.0).abs() < 1e-3);
    }
    world.apply_force(body, vec2(px(3600), px(0))).unwrap();
    world.despawn(body).unwrap();
    body = world.spawn(&crate_at(0, 0)).unwrap();
    step(&mut world, Effects::NONE);
    assert_eq!(world.body(body).unwrap().velocity, Vec2::default());
    world.apply_force(body, vec2(px(3600), px(0))).unwrap();
    world.set_kind(body, Kind::Static).unwrap();
    world.set_kind(body, Kind::Rigid).unwrap();
    step(&mut world, Effects::NONE);
    assert_eq!(world.body(body).unwrap().velocity, Vec2::default(), "what becomes static stops");
}

#[test]
fn a_body_that_left_can_be_brought_back() {
    let mut storage = Storage::<Fixed, 1, 1>::new();
    let mut world = storage.world();
    let body = world.spawn(&BodyDef { velocity: vec2(px(7000), px(0)), ..crate_at(16_300, 0) }).unwrap();
    run(&mut world, 3);
    assert!(!world.body(body).unwrap().enabled);
    world.set_position(body, vec2(px(0), px(0))).unwrap();
    world.set_velocity(body, vec2(px(0), px(0))).unwrap();
    world.set_enabled(body, true).unwrap();
    assert!(falls(&mut world, body));
}
