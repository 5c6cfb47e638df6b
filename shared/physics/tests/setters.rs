//! Bodies change between steps: every property can be set, what is set is in effect at once, and wrong values change nothing.

mod meddling;

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{
    BodyDef, Config, Effects, Error, Fixed, Handle, Kind, Material, Scalar, Shape, Storage, Vec2, World, digest, step,
    vec2,
};
use proptest::prelude::*;

const ON: Effects =
    Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::FRICTION).and(Effects::SENSORS).and(Effects::KINEMATIC);
const DULL: Material<Fixed> = Material { bounce: false, ..Material::DEFAULT };

fn rect(width: i16, height: i16) -> Shape<Fixed> {
    Shape::Box { half: vec2(px(width) / 2, px(height) / 2) }
}

fn crate_at(x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { material: DULL, ..BodyDef::rigid(rect(10, 10), vec2(px(x), px(y))) }
}

fn floor() -> BodyDef<Fixed> {
    BodyDef { material: DULL, ..BodyDef::fixed(rect(400, 10), vec2(px(0), px(5))) }
}

fn run(world: &mut World<'_, Fixed>, steps: usize) {
    for _ in 0..steps {
        step(world, ON);
    }
}

fn at(world: &World<'_, Fixed>, handle: Handle) -> Vec2<f64> {
    world.body(handle).unwrap().position.map(|c| c.to_num())
}

fn speed(world: &World<'_, Fixed>, handle: Handle) -> Vec2<f64> {
    world.body(handle).unwrap().velocity.map(|v| Fixed::px_per_second(v).to_num())
}

/// A crate has come to rest on a floor: its contact is in the pool and nothing moves. Then the world is changed.
fn at_rest(change: impl FnOnce(&mut World<'_, Fixed>, Handle, Handle)) {
    let mut storage = Storage::<Fixed, 8, 32>::new();
    let mut world = storage.world();
    let below = world.spawn(&floor()).unwrap();
    let above = world.spawn(&crate_at(0, -5)).unwrap();
    run(&mut world, 60);
    assert!((at(&world, above).y + 5.0).abs() < 0.03);
    change(&mut world, below, above);
}

fn falls(world: &mut World<'_, Fixed>, handle: Handle) -> bool {
    let before = at(world, handle).y;
    run(world, 30);
    at(world, handle).y > before + 20.0
}

#[test]
fn what_is_set_is_what_the_definition_says() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    let body = world.spawn(&crate_at(0, 0)).unwrap();
    let wanted = BodyDef {
        kind: Kind::Kinematic,
        shape: Shape::Circle { radius: px(7) },
        position: vec2(px(-3), ratio(7, 2)),
        velocity: vec2(px(60), px(-120)),
        mass: px(9),
        gravity_scale: ratio(-3, 2),
        material: Material { restitution: ratio(3, 4), bounce: false, friction: ratio(1, 4) },
        layer: 0x8001,
        mask: 0x10,
        sensor: true,
        one_way: true,
        visible: false,
        enabled: false,
        user_data: 0xdead_beef,
    };
    world.set_kind(body, wanted.kind).unwrap();
    world.set_shape(body, wanted.shape).unwrap();
    world.set_position(body, wanted.position).unwrap();
    world.set_velocity(body, wanted.velocity).unwrap();
    world.set_mass(body, wanted.mass).unwrap();
    world.set_gravity_scale(body, wanted.gravity_scale).unwrap();
    world.set_material(body, wanted.material).unwrap();
    world.set_layer(body, wanted.layer).unwrap();
    world.set_mask(body, wanted.mask).unwrap();
    world.set_sensor(body, true).unwrap();
    world.set_one_way(body, true).unwrap();
    world.set_visible(body, false).unwrap();
    world.set_enabled(body, false).unwrap();
    world.set_user_data(body, wanted.user_data).unwrap();
    assert_eq!(world.definition(body).unwrap(), wanted);

    world.set_restitution(body, ratio(1, 2)).unwrap();
    world.set_bounce(body, true).unwrap();
    world.set_friction(body, ratio(1, 8)).unwrap();
    let material = Material { restitution: ratio(1, 2), bounce: true, friction: ratio(1, 8) };
    assert_eq!(world.definition(body).unwrap(), BodyDef { material, ..wanted });

    let view = world.body(body).unwrap();
    assert_eq!((view.kind, view.shape), (wanted.kind, wanted.shape));
    assert_eq!((view.visible, view.enabled, view.user_data), (false, false, wanted.user_data));
}

#[test]
fn a_body_spawned_from_a_definition_is_the_same_body() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    let material = Material { restitution: ratio(1, 2), bounce: false, friction: ratio(1, 4) };
    let def = BodyDef { material, velocity: vec2(px(30), px(-60)), user_data: 7, sensor: true, ..crate_at(3, 4) };
    let first = world.spawn(&def).unwrap();
    assert_eq!(world.definition(first).unwrap(), def);
    world.spawn(&BodyDef::fixed(def.shape, def.position)).map(|other| world.definition(other)).unwrap().unwrap();
}

#[test]
fn a_refused_value_is_named_and_changes_nothing() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    let body = world.spawn(&crate_at(0, 0)).unwrap();
    let still = world.spawn(&floor()).unwrap();
    run(&mut world, 3);
    let before = (digest(&world), world.definition(body), world.definition(still), world.called_for());
    let (zero, huge) = (px(0), px(17_000));
    let cases: [(Result<(), Error<Fixed>>, &str); 15] = [
        (world.set_position(body, vec2(huge, zero)), "position.x is 17000, must be -16384..=16384"),
        (world.set_position(body, vec2(zero, -huge)), "position.y is -17000, must be -16384..=16384"),
        (world.set_velocity(body, vec2(px(7621), zero)), "velocity.x is 7621, must be -7620..=7620"),
        (world.set_velocity(still, vec2(zero, px(1))), "velocity.y is 1, must be 0..=0"),
        (world.set_shape(body, Shape::Circle { radius: zero }), "radius is 0, must be above 0"),
        (world.set_shape(body, rect(0, 4)), "half width is 0, must be above 0"),
        (world.set_shape(body, Shape::Box { half: vec2(px(1), px(4097)) }), "half height is 4097, must be 0..=4096"),
        (world.set_mass(body, zero), "mass is 0, must be above 0"),
        (world.set_gravity_scale(body, px(-17)), "gravity scale is -17, must be -16..=16"),
        (world.set_restitution(body, px(3)), "restitution is 3, must be 0..=2"),
        (world.set_friction(body, px(2)), "friction is 2, must be 0..=1"),
        (world.set_material(body, Material { friction: px(-1), ..DULL }), "friction is -1, must be 0..=1"),
        (world.apply_impulse(still, vec2(zero, zero)), "the body in slot 1 is not rigid"),
        (world.apply_force(still, vec2(zero, zero)), "the body in slot 1 is not rigid"),
        (world.apply_force(body, vec2(zero, I16F16::MIN)), "force.y is -32768, must be -32767..=32767"),
    ];
    for (outcome, text) in cases {
        assert_eq!(outcome.unwrap_err().to_string(), text);
    }
    assert_eq!((digest(&world), world.definition(body), world.definition(still), world.called_for()), before);
    run(&mut world, 1);
}

#[test]
fn a_body_that_is_gone_can_not_be_changed() {
    let mut storage = Storage::<Fixed, 1, 4>::new();
    let mut world = storage.world();
    let gone = world.spawn(&crate_at(0, 0)).unwrap();
    world.despawn(gone).unwrap();
    let other = world.spawn(&crate_at(1, 1)).unwrap();
    let before = world.definition(other).unwrap();
    let zero = vec2(px(0), px(0));
    let outcomes = [
        world.set_position(gone, zero),
        world.set_velocity(gone, zero),
        world.set_kind(gone, Kind::Static),
        world.set_shape(gone, rect(2, 2)),
        world.set_mass(gone, px(2)),
        world.set_gravity_scale(gone, px(2)),
        world.set_material(gone, DULL),
        world.set_restitution(gone, px(1)),
        world.set_bounce(gone, true),
        world.set_friction(gone, px(1)),
        world.set_layer(gone, 4),
        world.set_mask(gone, 4),
        world.set_sensor(gone, true),
        world.set_one_way(gone, true),
        world.set_visible(gone, false),
        world.set_enabled(gone, false),
        world.set_user_data(gone, 9),
        world.apply_impulse(gone, zero),
        world.apply_force(gone, zero),
        world.definition(gone).map(|_| ()),
    ];
    for outcome in outcomes {
        assert_eq!(outcome, Err(Error::NoSuchBody { handle: gone }));
    }
    assert_eq!(world.definition(other).unwrap(), before);
}

#[test]
fn a_floor_that_is_put_elsewhere_lets_fall_and_catches() {
    at_rest(|world, floor, body| {
        world.set_position(floor, vec2(px(1000), px(5))).unwrap();
        assert!(falls(world, body));
        world.set_position(floor, vec2(px(0), px(100))).unwrap();
        run(world, 120);
        assert!((at(world, body).y - 90.0).abs() < 0.05, "{:?}", at(world, body));
    });
}

#[test]
fn a_floor_that_is_shifted_a_little_takes_its_contacts_along() {
    for shift in [1, -1] {
        at_rest(|world, floor, body| {
            world.set_position(floor, vec2(px(0), px(5 + shift))).unwrap();
            run(world, 60);
            assert!((at(world, body).y + 5.0 - f64::from(shift)).abs() < 0.05, "{shift}: {:?}", at(world, body));
        });
    }
}

#[test]
fn a_body_that_is_put_into_another_touches_it_in_the_next_step() {
    at_rest(|world, _, body| {
        let other = world.spawn(&crate_at(100, -5)).unwrap();
        run(world, 60);
        world.set_position(body, vec2(px(92), px(-5))).unwrap();
        run(world, 1);
        assert!(world.contacts().any(|contact| contact.bodies.contains(&body) && contact.bodies.contains(&other)));
    });
}

#[test]
fn a_body_that_is_put_elsewhere_keeps_its_velocity_and_meets_what_is_there() {
    at_rest(|world, _, body| {
        world.set_position(body, vec2(px(0), px(-100))).unwrap();
        assert!(speed(world, body).y.abs() < 0.01);
        assert!(falls(world, body));
        world.set_position(body, vec2(px(150), px(-6))).unwrap();
        assert_eq!(world.body(body).unwrap().remainder, vec2(0, 0));
        let falling = speed(world, body).y;
        assert!(falling > 50.0);
        run(world, 60);
        assert!((at(world, body).y + 5.0).abs() < 0.05 && (at(world, body).x - 150.0).abs() < 0.01);
    });
}

#[test]
fn a_velocity_is_in_effect_at_once_and_stops_at_the_next_wall() {
    at_rest(|world, _, body| {
        let wall = BodyDef { material: DULL, ..BodyDef::fixed(rect(10, 100), vec2(px(12), px(-50))) };
        world.spawn(&wall).unwrap();
        run(world, 60);
        // The wall's contact was found while both were at rest, 2 px apart.
        world.set_velocity(body, vec2(px(7000), px(0))).unwrap();
        run(world, 10);
        let x = at(world, body).x;
        assert!((x - 2.0).abs() < 0.1, "{x}");
    });
}

#[test]
fn a_kinematic_body_goes_where_its_velocity_carries_it_and_takes_others_along() {
    at_rest(|world, floor, body| {
        world.set_kind(floor, Kind::Kinematic).unwrap();
        world.set_velocity(floor, vec2(px(0), px(-60))).unwrap();
        run(world, 60);
        let (carrier, carried) = (at(world, floor).y, at(world, body).y);
        assert!((carrier + 55.0).abs() < 0.01, "{carrier}");
        assert!((carried + 65.0).abs() < 0.3, "{carried}");
        world.set_velocity(floor, vec2(px(0), px(0))).unwrap();
        run(world, 1);
        assert!((at(world, floor).y - carrier).abs() < 1e-9);
    });
}

#[test]
fn a_kind_can_become_any_other_while_in_contact() {
    at_rest(|world, floor, body| {
        world.set_kind(floor, Kind::Rigid).unwrap();
        assert!(falls(world, floor) && at(world, body).y > 10.0, "both fall");
        world.set_kind(floor, Kind::Static).unwrap();
        let held = at(world, floor);
        run(world, 120);
        assert_eq!((at(world, floor), speed(world, floor)), (held, vec2(0.0, 0.0)));
        assert!((at(world, body).y - held.y + 10.0).abs() < 0.05, "it lies on the floor again");
        world.set_kind(body, Kind::Kinematic).unwrap();
        world.set_kind(floor, Kind::Rigid).unwrap();
        let hangs = at(world, body);
        assert!(falls(world, floor));
        assert_eq!(at(world, body), hangs);
        world.set_kind(body, Kind::Rigid).unwrap();
        assert!(falls(world, body));
    });
}

#[test]
fn a_shape_that_grows_is_pushed_out_and_one_that_shrinks_comes_down() {
    at_rest(|world, floor, body| {
        world.set_shape(body, Shape::Circle { radius: px(8) }).unwrap();
        run(world, 60);
        assert!((at(world, body).y + 8.0).abs() < 0.05, "{:?}", at(world, body));
        world.set_shape(body, rect(4, 4)).unwrap();
        run(world, 60);
        assert!((at(world, body).y + 2.0).abs() < 0.05, "{:?}", at(world, body));
        world.set_shape(floor, rect(400, 4)).unwrap();
        run(world, 60);
        assert!((at(world, body).y - 1.0).abs() < 0.05, "{:?}", at(world, body));
    });
}

#[test]
fn who_gives_way_in_a_contact_changes_with_the_kind() {
    let push = |kinds: [Kind; 2]| {
        let mut storage = Storage::<Fixed, 2, 4>::new();
        let mut world = storage.world();
        world.configure(Config { gravity: Vec2::default(), ..Config::default() }).unwrap();
        let left = world.spawn(&BodyDef { kind: kinds[0], ..crate_at(0, 0) }).unwrap();
        let right = world.spawn(&crate_at(10, 0)).unwrap();
        run(&mut world, 5);
        world.set_kind(left, kinds[1]).unwrap();
        world.apply_impulse(right, vec2(px(-60), px(0))).unwrap();
        run(&mut world, 5);
        [left, right].map(|body| speed(&world, body).x)
    };
    for still in [Kind::Kinematic, Kind::Static] {
        let stopped = push([Kind::Rigid, still]);
        assert!(stopped.iter().all(|speed| speed.abs() < 0.1), "{still:?}: {stopped:?}");
        let pushed = push([still, Kind::Rigid]);
        assert!(pushed.iter().all(|speed| (speed + 30.0).abs() < 0.1), "no longer {still:?}: {pushed:?}");
    }
}

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

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// Nothing that a game does to its bodies panics, loses a body or makes two runs differ.
    #[test]
    fn any_meddling_ends_the_same_twice(acts in meddling::acts()) {
        let run = || {
            let mut storage = Storage::<Fixed, 12, 64>::new();
            let mut world = storage.world();
            meddling::build(&mut world);
            for act in &acts {
                let count = world.statistics().bodies;
                let change = act.perform(&mut world);
                assert_eq!(i32::from(world.statistics().bodies) - i32::from(count), change);
                (0..act.steps).for_each(|_| step(&mut world, Effects::ALL));
            }
            assert_eq!(world.bodies().count(), usize::from(world.statistics().bodies));
            digest(&world)
        };
        prop_assert_eq!(run(), run());
    }
}
