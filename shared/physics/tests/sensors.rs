//! Sensors notice what touches them, and neither push nor are pushed.

use flat_physics::scalar::px;
use flat_physics::{BodyDef, Effects, Fixed, Handle, Kind, Phase, Shape, Storage, Vec2, World, step, vec2};

fn disc(kind: Kind, x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { kind, ..BodyDef::rigid(Shape::Circle { radius: px(5) }, vec2(px(x), px(y))) }
}

fn sensor(kind: Kind, x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { sensor: true, ..disc(kind, x, y) }
}

fn block(kind: Kind, x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { shape: Shape::Box { half: vec2(px(5), px(5)) }, ..disc(kind, x, y) }
}

/// Steps; begins and ends so far.
fn count(world: &mut World<'_, Fixed>, steps: usize) -> (usize, usize) {
    let (mut begins, mut ends) = (0, 0);
    for _ in 0..steps {
        step(world, Effects::ALL);
        for event in world.events() {
            assert!(event.sensor && event.impulse == Vec2::default());
            begins += usize::from(event.phase == Phase::Begin);
            ends += usize::from(event.phase == Phase::End);
        }
    }
    (begins, ends)
}

#[test]
fn a_sensor_notices_who_passes_once_and_changes_no_bit_of_its_motion() {
    let kinds = [Kind::Rigid, Kind::Static, Kind::Kinematic];
    for passer in [Kind::Rigid, Kind::Kinematic] {
        for (kind, shape) in kinds.into_iter().flat_map(|kind| [(kind, disc as fn(_, _, _) -> _), (kind, block)]) {
            for (mover, zone) in [(false, true), (true, false), (true, true)] {
                let pass = |with_zone: bool| {
                    let mut storage = Storage::<Fixed, 2, 4>::new();
                    let mut world = storage.world();
                    let def = BodyDef { sensor: mover, velocity: vec2(px(60), px(3)), ..disc(passer, -30, 0) };
                    let body = world.spawn(&BodyDef { gravity_scale: px(0), ..def }).unwrap();
                    if with_zone {
                        let def: BodyDef<Fixed> = shape(kind, 0, 0);
                        world.spawn(&BodyDef { sensor: zone, gravity_scale: px(0), ..def }).unwrap();
                    }
                    let counts = count(&mut world, 60);
                    assert_eq!(world.contacts().count(), 0);
                    let view = world.body(body).unwrap();
                    (counts, view.position, view.velocity)
                };
                let (met, alone) = (pass(true), pass(false));
                assert_eq!(met.0, (1, 1), "{passer:?} {mover} meets {kind:?} {zone}");
                assert_eq!((met.1, met.2), (alone.1, alone.2));
            }
        }
    }
}

#[test]
fn a_sensor_that_falls_passes_through_the_floor() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.spawn(&block(Kind::Static, 0, 40)).unwrap();
    let body = world.spawn(&sensor(Kind::Rigid, 0, 0)).unwrap();
    assert_eq!(count(&mut world, 60), (1, 1));
    assert!(world.body(body).unwrap().position.y > px(90));
}

#[test]
fn bodies_that_can_not_move_notice_nothing_and_kinematic_ones_only_sensors() {
    let events = |first: BodyDef<Fixed>, second: BodyDef<Fixed>| {
        let mut storage = Storage::<Fixed, 2, 4>::new();
        let mut world = storage.world();
        world.spawn(&first).unwrap();
        world.spawn(&second).unwrap();
        step(&mut world, Effects::ALL);
        world.events().count()
    };
    assert_eq!(events(sensor(Kind::Static, 0, 0), disc(Kind::Static, 3, 3)), 0);
    assert_eq!(events(sensor(Kind::Static, 0, 0), sensor(Kind::Static, 3, 3)), 0);
    assert_eq!(events(disc(Kind::Kinematic, 0, 0), disc(Kind::Static, 3, 3)), 0);
    assert_eq!(events(disc(Kind::Kinematic, 0, 0), disc(Kind::Kinematic, 3, 3)), 0);
    assert_eq!(events(sensor(Kind::Kinematic, 0, 0), disc(Kind::Static, 3, 3)), 1);
    assert_eq!(events(disc(Kind::Kinematic, 0, 0), sensor(Kind::Static, 3, 3)), 1);
    assert_eq!(events(disc(Kind::Kinematic, 0, 0), sensor(Kind::Kinematic, 3, 3)), 1);
}

#[test]
fn sensors_obey_layers_and_hiding() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    let zone = world.spawn(&BodyDef { layer: 2, mask: 0, ..sensor(Kind::Static, 0, 0) }).unwrap();
    let body = world.spawn(&BodyDef { mask: 4, ..disc(Kind::Kinematic, 3, 0) }).unwrap();
    assert_eq!(count(&mut world, 2), (0, 0));
    world.set_mask(body, 2).unwrap();
    assert_eq!(count(&mut world, 2), (1, 0));
    world.set_visible(zone, false).unwrap();
    assert_eq!(count(&mut world, 2), (0, 1));
    world.set_visible(zone, true).unwrap();
    assert_eq!(count(&mut world, 2), (1, 0));
    world.set_sensor(zone, false).unwrap();
    step(&mut world, Effects::ALL);
    let end: Vec<_> = world.events().map(|event| event.phase).collect();
    assert_eq!(end, [Phase::End], "a kinematic body and a static one have nothing to do with each other");
}

#[test]
fn two_that_pass_each_other_upright_are_told_once() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.spawn(&BodyDef { velocity: vec2(px(0), px(40)), ..sensor(Kind::Kinematic, 0, -20) }).unwrap();
    world.spawn(&BodyDef { velocity: vec2(px(0), px(-40)), ..disc(Kind::Kinematic, 2, 20) }).unwrap();
    assert_eq!(count(&mut world, 90), (1, 1));
}

#[test]
fn a_sensor_among_resting_bodies_changes_nothing_for_them() {
    let pile = |world: &mut World<'_, Fixed>| -> Vec<Handle> {
        world
            .spawn(&BodyDef { shape: Shape::Box { half: vec2(px(100), px(5)) }, ..block(Kind::Static, 0, 5) })
            .unwrap();
        (0..5).map(|n| world.spawn(&block(Kind::Rigid, n % 2, -6 - 11 * n)).unwrap()).collect()
    };
    let state = |world: &World<'_, Fixed>, handles: &[Handle]| -> Vec<_> {
        handles.iter().map(|&handle| world.body(handle).map(|body| (body.position, body.velocity)).unwrap()).collect()
    };
    let mut storage = [Storage::<Fixed, 8, 64>::new(), Storage::new()];
    let [plain, watched] = &mut storage;
    let (mut plain, mut watched) = (plain.world(), watched.world());
    let (first, second) = (pile(&mut plain), pile(&mut watched));
    watched
        .spawn(&BodyDef { shape: Shape::Box { half: vec2(px(30), px(40)) }, ..sensor(Kind::Static, 0, -20) })
        .unwrap();
    for _ in 0..120 {
        step(&mut plain, Effects::ALL);
        step(&mut watched, Effects::ALL);
        assert_eq!(state(&plain, &first), state(&watched, &second));
    }
    assert_eq!(watched.events().filter(|event| event.sensor).count(), 5);
}

#[test]
fn a_sensor_blocks_where_sensors_are_not_called_for() {
    let land = |sensor: bool, effects| {
        let mut storage = Storage::<Fixed, 3, 8>::new();
        let mut world = storage.world();
        world.spawn(&BodyDef { sensor, ..block(Kind::Static, 0, 5) }).unwrap();
        world.spawn(&BodyDef { sensor, ..block(Kind::Kinematic, 3, 8) }).unwrap();
        let body = world.spawn(&block(Kind::Rigid, 0, -10)).unwrap();
        (0..60).for_each(|_| step(&mut world, effects));
        world.body(body).unwrap().position.y
    };
    let without = Effects::ALL.without(Effects::SENSORS);
    assert!(land(true, Effects::ALL) > px(50));
    assert_eq!(land(true, without), land(false, without));
    assert_eq!(land(false, Effects::ALL), land(false, without));
}
