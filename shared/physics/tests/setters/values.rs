//! What is set is what the definition says; what can't be set changes nothing.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Error, Fixed, Kind, Material, Shape, Storage, digest, vec2};

use crate::{DULL, crate_at, floor, rect, run};

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
