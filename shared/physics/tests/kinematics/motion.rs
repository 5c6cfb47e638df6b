//! A motion and what it meets.

use flat_physics::scalar::px;
use flat_physics::{BodyDef, Collider, Error, Field, Fixed, Scalar, Shape, SlideOptions, vec2};

use crate::{Real, at, disc, place, player, rect, wall};

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
