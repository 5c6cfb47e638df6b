//! Bodies are put elsewhere, and become others.

use flat_physics::scalar::px;
use flat_physics::{BodyDef, Config, Fixed, Kind, Shape, Storage, Vec2, vec2};

use crate::{DULL, at, at_rest, crate_at, falls, rect, run, speed};

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
