//! Questions to a world: who is at a point, in a shape, on a ray.

use fixed::types::I16F16;
use flat_physics::geometry::{Outline, cast, touches};
use flat_physics::query::Filter;
use flat_physics::scalar::px;
use flat_physics::tiles::{BehaviorLayer, TileFlags};
use flat_physics::world::Terrain;
use flat_physics::{BodyDef, Collider, Error, Field, Fixed, Handle, Shape, Storage, Vec2, World, vec2};
use proptest::prelude::*;

fn at(x: i16, y: i16) -> Vec2<I16F16> {
    vec2(px(x), px(y))
}
fn rect(w: i16, h: i16) -> Shape<Fixed> {
    Shape::Box { half: at(w, h) }
}
fn disc(radius: i16) -> Shape<Fixed> {
    Shape::Circle { radius: px(radius) }
}
fn bodies(colliders: impl Iterator<Item = Collider>) -> Vec<Handle> {
    let handle = |collider| match collider {
        Collider::Body(handle) => handle,
        Collider::Tile(tile) => panic!("a tile: {tile:?}"),
    };
    colliders.map(handle).collect()
}

/// A row along the x axis: box, disc, sensor, body of another layer, hidden and disabled ones.
fn row(world: &mut World<'_, Fixed>) -> [Handle; 6] {
    let defs = [
        BodyDef::fixed(rect(5, 5), at(100, 0)),
        BodyDef::rigid(disc(5), at(50, 0)),
        BodyDef { sensor: true, ..BodyDef::fixed(rect(5, 5), at(150, 0)) },
        BodyDef { layer: 4, ..BodyDef::kinematic(rect(5, 5), at(200, 0)) },
        BodyDef { visible: false, ..BodyDef::fixed(rect(5, 5), at(20, 0)) },
        BodyDef { enabled: false, ..BodyDef::fixed(rect(5, 5), at(30, 0)) },
    ];
    defs.map(|def| world.spawn(&def).unwrap())
}

#[test]
fn a_point_finds_what_covers_it_edges_included() {
    let mut storage = Storage::<Fixed, 8, 8>::new();
    let mut world = storage.world();
    let [block, ball, coin, ..] = row(&mut world);
    let over = world.spawn(&BodyDef::fixed(rect(60, 5), at(80, 4))).unwrap();
    let (solid, all) = (Filter::default(), Filter { sensors: true, ..Filter::default() });
    let find = |point, filter: Filter| bodies(world.at_point(point, filter).unwrap());
    assert_eq!(find(at(100, 0), solid), [block, over]);
    assert_eq!(find(at(105, -5), solid), [block], "a corner is covered");
    assert_eq!(find(at(106, -5), solid), []);
    assert_eq!(find(at(53, -4), solid), [ball], "3, 4, 5");
    assert_eq!(find(at(54, -4), solid), []);
    assert_eq!(find(at(150, 0), solid), []);
    assert_eq!(find(at(150, 0), all), [coin]);
    assert_eq!(find(at(100, 0), Filter { except: Some(block), ..solid }), [over]);
    assert_eq!(find(at(20, 0), all), [over], "hidden");
    assert_eq!(find(at(30, 0), all), [over], "disabled");
}

#[test]
fn a_ray_finds_what_it_meets_in_the_order_in_which_it_does() {
    let mut storage = Storage::<Fixed, 8, 8>::new();
    let mut world = storage.world();
    let [block, ball, coin, other, ..] = row(&mut world);
    let order = |filter| {
        let hits = world.ray_all(at(0, 0), at(400, 0), filter).unwrap();
        bodies(hits.map(|hit| hit.collider))
    };
    assert_eq!(order(Filter::default()), [ball, block, other]);
    assert_eq!(order(Filter { sensors: true, ..Filter::default() }), [ball, block, coin, other]);
    assert_eq!(order(Filter { mask: 4, ..Filter::default() }), [other]);
    let hit = world.ray(at(0, 0), at(400, 0), Filter::default()).unwrap().expect("the ball");
    assert_eq!((hit.collider, hit.place, hit.depth), (Collider::Body(ball), at(45, 0), px(0)));
    let back = world.ray(at(400, 0), at(-400, 0), Filter::default()).unwrap().expect("the other");
    assert_eq!((back.collider, back.place), (Collider::Body(other), at(205, 0)));
    // Too short, beside, along an edge, and from within.
    for (origin, way) in [(at(0, 0), at(45, 0)), (at(0, 6), at(400, 0)), (at(0, 5), at(400, 0)), (at(0, 0), at(0, 0))] {
        assert_eq!(world.ray(origin, way, Filter::default()).unwrap(), None, "{origin:?} {way:?}");
    }
    let inside = world.ray(at(97, 0), at(400, 0), Filter::default()).unwrap().expect("the block around it");
    assert_eq!((inside.collider, inside.place, inside.depth), (Collider::Body(block), at(97, 0), px(2)));
}

#[test]
fn tiles_are_found_after_bodies_and_by_their_surface() {
    let mut storage = Storage::<Fixed, 8, 8, 8>::new();
    let mut world = storage.world();
    let (solid, coin) = (TileFlags::SOLID.bits(), TileFlags::COLLECTIBLE.bits());
    // Two rows of 16 px tiles: a wall two tiles thick, a coin, a wall.
    let row = [solid, solid, coin, solid];
    let layer = [row, row].concat();
    world.set_tiles(&BehaviorLayer::new(&layer, 4, 2).unwrap(), &Terrain { layer: 2, ..Terrain::DEFAULT }).unwrap();
    let block = world.spawn(&BodyDef::fixed(rect(4, 4), at(16, 8))).unwrap();
    let place = |collider| match collider {
        Collider::Tile(tile) => (tile.column, tile.row),
        Collider::Body(body) => (900 + body.slot(), 0),
    };
    let (filter, all) = (Filter::default(), Filter { sensors: true, ..Filter::default() });
    let find = |point, filter| world.at_point(point, filter).unwrap().map(place).collect::<Vec<_>>();
    let block = (900 + block.slot(), 0);
    assert_eq!(find(at(16, 8), filter), [block, (0, 0), (1, 0)], "an edge is of both tiles");
    assert_eq!(find(at(16, 8), Filter { tiles: false, ..filter }), [block]);
    assert_eq!(find(at(16, 8), Filter { mask: 1, ..filter }), [block]);
    assert_eq!((find(at(40, 8), filter), find(at(40, 8), all)), (vec![], vec![(2, 0)]));
    let ray = |filter| {
        let hits = world.ray_all(at(-10, 24), at(100, 0), filter).unwrap();
        hits.map(|hit| (place(hit.collider), hit.place.x)).collect::<Vec<_>>()
    };
    assert_eq!(ray(filter), [((0, 1), px(0)), ((3, 1), px(48))], "no face between the first two");
    assert_eq!(ray(all), [((0, 1), px(0)), ((2, 1), px(32)), ((3, 1), px(48))]);
    // A box as high as the map meets two tiles at once.
    let bar = Outline { centre: at(-10, 16), half: at(2, 12), circle: false };
    let met: Vec<_> = world.cast_all(bar, at(30, 0), filter).unwrap().map(|hit| place(hit.collider)).collect();
    assert_eq!(met, [(0, 0), (0, 1), block]);
}

#[test]
fn a_question_that_makes_no_sense_is_refused() {
    let mut storage = Storage::<Fixed, 2, 2>::new();
    let world = storage.world();
    let refusal = |field, value, range| Error::OutOfRange { field, value: px(value), range };
    let filter = Filter::default();
    let world_range = (-16_384, 16_384);
    assert_eq!(world.at_point(at(0, 16_385), filter).err(), Some(refusal(Field::PositionY, 16_385, world_range)));
    assert_eq!(
        world.ray(at(-16_385, 0), at(0, 0), filter).err(),
        Some(refusal(Field::PositionX, -16_385, world_range))
    );
    let big = Outline { centre: at(0, 0), half: at(4097, 4097), circle: true };
    assert_eq!(world.overlapping(big, filter).err(), Some(refusal(Field::Radius, 4097, (0, 4096))));
    let turned = Outline { centre: at(0, 0), half: at(1, -1), circle: false };
    assert_eq!(world.cast_all(turned, at(0, 0), filter).err(), Some(refusal(Field::HalfHeight, -1, (0, 4096))));

    let mut floats = Storage::<f32, 2, 2>::new();
    let world = floats.world();
    let Err(Error::OutOfRange { field: Field::MotionX, .. }) = world.ray(vec2(0.0, 0.0), vec2(f32::NAN, 0.0), filter)
    else {
        panic!("not a number is not a way");
    };
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn answers_are_those_of_a_search_through_all_bodies(
        crowd in prop::collection::vec((-100..100i16, -100..100i16, 1..20i16, 1..20i16, any::<bool>()), 0..24),
        (x, y, w, h) in (-100..100i16, -100..100i16, 0..30i16, 0..30i16),
        way in (-300..300i16, -300..300i16),
    ) {
        let mut storage = Storage::<Fixed, 24, 8>::new();
        let mut world = storage.world();
        let crowd: Vec<_> = crowd.into_iter().map(|(x, y, w, h, circle)| {
            let shape = if circle { disc(w) } else { rect(w, h) };
            (world.spawn(&BodyDef::fixed(shape, at(x, y))).unwrap(), Outline::new(&shape, at(x, y)))
        }).collect();
        let probe = Outline { centre: at(x, y), half: at(w, h), circle: false };
        let expected: Vec<_> = crowd.iter().filter(|(_, outline)| touches(&probe, outline)).map(|(body, _)| *body).collect();
        prop_assert_eq!(bodies(world.overlapping(probe, Filter::default()).unwrap()), expected);

        let way = at(way.0, way.1);
        let mut expected: Vec<_> =
            crowd.iter().filter_map(|(body, outline)| Some((cast(&probe, way, outline)?.time, *body))).collect();
        expected.sort_by_key(|(time, body)| (*time, body.slot()));
        let hits = world.cast_all(probe, way, Filter::default()).unwrap();
        prop_assert_eq!(bodies(hits.map(|hit| hit.collider)), expected.into_iter().map(|(_, body)| body).collect::<Vec<_>>());
    }
}
