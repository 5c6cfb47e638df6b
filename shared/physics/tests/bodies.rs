//! Spawning, removing, finding bodies; wrong input is refused by name and changes nothing.

use fixed::types::I16F16;
use flat_physics::scalar::px;
use flat_physics::{
    BodyDef, Config, Effects, Error, Field, Fixed, Material, Scalar, Shape, Storage, World, digest, step, vec2,
};

fn ball(x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef::rigid(Shape::Circle { radius: px(4) }, vec2(px(x), px(y)))
}

/// Spawns a definition that must be refused, and checks that nothing changed.
fn refusal<S: Scalar>(world: &mut World<'_, S>, def: BodyDef<S>) -> Error<S> {
    let before = (digest(world), world.statistics(), world.called_for());
    let error = world.spawn(&def).expect_err("must be refused");
    assert_eq!((digest(world), world.statistics(), world.called_for()), before);
    error
}

#[test]
fn a_handle_names_its_body_until_that_is_gone_and_no_other_after() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    let first = world.spawn(&ball(1, 0)).unwrap();
    let second = world.spawn(&ball(2, 0)).unwrap();
    world.despawn(first).unwrap();
    let third = world.spawn(&ball(3, 0)).unwrap();
    assert_eq!(third.slot(), first.slot());
    assert_eq!(world.body(first), Err(Error::NoSuchBody { handle: first }));
    assert_eq!(world.despawn(first), Err(Error::NoSuchBody { handle: first }));
    assert_eq!(world.body(second).unwrap().position.x, px(2));
    assert_eq!(world.body(third).unwrap().position.x, px(3));
    world.clear();
    assert!(world.body(third).is_err() && world.statistics().bodies == 0);
}

#[test]
fn a_removed_body_takes_its_contacts_along_and_no_others() {
    let mut storage = Storage::<Fixed, 4, 4>::new();
    let mut world = storage.world();
    let handles = [0, 7, 14, 21].map(|x| world.spawn(&ball(x, 0)).unwrap());
    step(&mut world, Effects::NONE);
    assert_eq!(world.contacts().count(), 3);
    world.despawn(handles[1]).unwrap();
    let left: Vec<_> = world.contacts().map(|contact| contact.bodies).collect();
    assert_eq!(left, [[handles[3], handles[2]]]);
    step(&mut world, Effects::NONE);
    assert_eq!(world.contacts().count(), 1);
}

#[test]
fn a_full_world_says_so_and_has_room_again_after_a_removal() {
    let mut storage = Storage::<Fixed, 3, 4>::new();
    let mut world = storage.world();
    let handles = [0, 20, 40].map(|x| world.spawn(&ball(x, 0)).unwrap());
    assert_eq!(refusal(&mut world, ball(60, 0)), Error::Full { capacity: 3 });
    world.despawn(handles[1]).unwrap();
    world.despawn(handles[0]).unwrap();
    world.spawn(&ball(60, 0)).unwrap();
    world.spawn(&ball(80, 0)).unwrap();
    assert_eq!(refusal(&mut world, ball(60, 0)), Error::Full { capacity: 3 });
}

#[test]
fn thousands_of_spawns_and_removals_leave_an_empty_world() {
    let mut storage = Storage::<Fixed, 8, 16>::new();
    let mut world = storage.world();
    for round in 0..5000 {
        let handle = world.spawn(&ball(round % 100, 0)).unwrap();
        step(&mut world, Effects::ALL);
        world.despawn(handle).unwrap();
    }
    assert_eq!((world.statistics().bodies, world.bodies().count()), (0, 0));
}

#[test]
fn a_refused_definition_names_field_and_value() {
    let mut storage = Storage::<Fixed, 4, 4>::new();
    let mut world = storage.world();
    let good = ball(0, 0);
    let material = Material::DEFAULT;
    let circle = |radius| Shape::Circle { radius };
    let rect = |x, y| Shape::Box { half: vec2(px(x), px(y)) };
    let epsilon = I16F16::from_bits(1);
    let cases = [
        (BodyDef { position: vec2(px(16_384) + epsilon, px(0)), ..good }, Field::PositionX),
        (BodyDef { position: vec2(px(0), px(-16_385)), ..good }, Field::PositionY),
        (BodyDef { velocity: vec2(px(7621), px(0)), ..good }, Field::VelocityX),
        (BodyDef { velocity: vec2(px(0), px(-7621)), ..good }, Field::VelocityY),
        (BodyDef { shape: circle(px(0)), ..good }, Field::Radius),
        (BodyDef { shape: circle(px(-3)), ..good }, Field::Radius),
        (BodyDef { shape: circle(px(4097)), ..good }, Field::Radius),
        (BodyDef { shape: rect(0, 1), ..good }, Field::HalfWidth),
        (BodyDef { shape: rect(1, 32_767), ..good }, Field::HalfHeight),
        (BodyDef { mass: px(0), ..good }, Field::Mass),
        (BodyDef { mass: px(-1), ..good }, Field::Mass),
        (BodyDef { mass: px(16_384) + epsilon, ..good }, Field::Mass),
        (BodyDef { gravity_scale: px(17), ..good }, Field::GravityScale),
        (BodyDef { material: Material { restitution: -epsilon, ..material }, ..good }, Field::Restitution),
        (BodyDef { material: Material { restitution: px(3), ..material }, ..good }, Field::Restitution),
        (BodyDef { material: Material { friction: px(1) + epsilon, ..material }, ..good }, Field::Friction),
        (BodyDef { velocity: vec2(px(1), px(0)), ..BodyDef::fixed(good.shape, good.position) }, Field::VelocityX),
    ];
    for (def, expected) in cases {
        let error = refusal(&mut world, def);
        let (Error::OutOfRange { field, .. } | Error::NotPositive { field, .. }) = error else {
            panic!("{def:?} gave {error}");
        };
        assert_eq!(field, expected, "{def:?}");
        assert!(error.to_string().starts_with(&expected.to_string()), "{error}");
    }
    assert_eq!(refusal(&mut world, BodyDef { mass: px(-2), ..good }).to_string(), "mass is -2, must be 0..=16384");
}

#[test]
fn floats_refuse_what_is_not_a_number() {
    let mut storage = Storage::<f32, 4, 4>::new();
    let mut world = storage.world();
    let good = ball(0, 0).convert::<f32>();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for def in [
            BodyDef { position: vec2(bad, 0.0), ..good },
            BodyDef { velocity: vec2(0.0, bad), ..good },
            BodyDef { mass: bad, ..good },
            BodyDef { shape: Shape::Circle { radius: bad }, ..good },
        ] {
            assert!(matches!(refusal(&mut world, def), Error::OutOfRange { .. }), "{bad}");
        }
    }
}

#[test]
fn refused_settings_name_field_and_value_and_change_nothing() {
    let mut storage = Storage::<Fixed, 1, 1>::new();
    let mut world = storage.world();
    let good = Config::default();
    for (config, text) in [
        (Config { gravity: vec2(px(0), px(8001)), ..good }, "gravity.y is 8001, must be -8000..=8000"),
        (Config { gravity: vec2(px(-8001), px(0)), ..good }, "gravity.x is -8001, must be -8000..=8000"),
        (Config { velocity_iterations: 0, ..good }, "velocity iterations is 0, must be 1..=16"),
        (Config { velocity_iterations: 17, ..good }, "velocity iterations is 17, must be 1..=16"),
        (Config { bias: px(2), ..good }, "bias is 2, must be 0..=1"),
        (Config { slop: px(-1), ..good }, "slop is -1, must be 0..=8"),
        (Config { velocity_threshold: px(-1), ..good }, "velocity threshold is -1, must be 0..=1000"),
    ] {
        assert_eq!(world.configure(config).unwrap_err().to_string(), text);
        assert_eq!(*world.config(), good);
    }
}

#[test]
fn a_body_that_leaves_the_coordinate_range_is_disabled_and_counted_once() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    let def = BodyDef { velocity: vec2(px(7620), px(0)), ..ball(16_300, 0) };
    let handle = world.spawn(&def).unwrap();
    let mut disabled_at = None;
    for step_number in 1..=100 {
        step(&mut world, Effects::NONE);
        if disabled_at.is_none() && !world.body(handle).unwrap().enabled {
            disabled_at = Some(step_number);
        }
    }
    assert_eq!((disabled_at, world.statistics().escaped), (Some(1), 1));
    assert_eq!(world.body(handle).unwrap().position.x, px(16_384));
    world.despawn(handle).unwrap();
}

#[test]
fn speeds_are_held_at_the_limit_and_counted() {
    let mut storage = Storage::<Fixed, 1, 1>::new();
    let mut world = storage.world();
    world.configure(Config { gravity: vec2(px(0), px(8000)), ..Config::default() }).unwrap();
    let handle = world.spawn(&BodyDef { gravity_scale: px(-16), ..ball(0, 16_000) }).unwrap();
    for _ in 0..50 {
        step(&mut world, Effects::GRAVITY);
    }
    assert_eq!(world.body(handle).unwrap().velocity.y, -Fixed::FASTEST);
    assert!(world.statistics().saturations > 40, "{:?}", world.statistics());
}

#[test]
fn only_bodies_whose_layers_meet_collide() {
    let overlap = |first: (u16, u16), second: (u16, u16)| {
        let mut storage = Storage::<Fixed, 2, 4>::new();
        let mut world = storage.world();
        for ((layer, mask), x) in [(first, 0), (second, 4)] {
            world.spawn(&BodyDef { layer, mask, ..ball(x, 0) }).unwrap();
        }
        step(&mut world, Effects::NONE);
        world.statistics().contacts == 1
    };
    assert!(overlap((1, u16::MAX), (1, u16::MAX)));
    assert!(overlap((1, 0), (2, 1)) && overlap((2, 1), (1, 0)), "one mask is enough");
    assert!(!overlap((1, 2), (4, 2)));
    assert!(!overlap((1, 0), (1, 0)));
}
