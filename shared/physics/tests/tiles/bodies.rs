//! Bodies in place of a map.

use flat_physics::scalar::px;
use flat_physics::tiles::{TileBodies, TileData, TileError, TileFlags};
use flat_physics::{BodyDef, Error, Fixed, Kind, Material, Shape, Storage, vec2};
use proptest::prelude::*;

use crate::drawing::Drawing;

fn rects(drawing: &Drawing) -> Vec<(u16, u16, u16, u16)> {
    let rects = TileBodies::<Fixed>::default().rects(&drawing.layer()).unwrap();
    rects.map(|rect| (rect.column, rect.row, rect.columns, rect.rows)).collect()
}

#[test]
fn equal_tiles_are_merged_into_few_bodies() {
    let drawing = Drawing::new(&["##########", "#...==...#", "#...==$$.#", "#..####..#", "#..####^^#", "##########"]);
    let expected = [
        (0, 0, 10, 1), // ceiling
        (0, 1, 1, 4),  // left wall
        (4, 1, 2, 1),  // one-way tiles merge along rows only
        (9, 1, 1, 4),
        (4, 2, 2, 1),
        (6, 2, 1, 1), // each coin on its own
        (7, 2, 1, 1),
        (3, 3, 4, 2),
        (7, 4, 2, 1),
        (0, 5, 10, 1),
    ];
    assert_eq!(rects(&drawing), expected);
}

#[test]
fn a_body_is_where_its_tiles_are_and_tells_which() {
    let drawing = Drawing::new(&["..", ".^", ".^", "=="]);
    let bodies = TileBodies::<Fixed> {
        origin: vec2(-100, 7),
        tile_size: vec2(15, 10),
        layer: 4,
        mask: 2,
        material: Material { friction: px(1), ..Material::DEFAULT },
        ..TileBodies::default()
    };
    let made: Vec<BodyDef<Fixed>> = bodies.of(&drawing.layer()).unwrap().collect();
    let half = |x: f32, y: f32| Shape::Box {
        half: vec2(fixed::types::I16F16::from_num(x), fixed::types::I16F16::from_num(y)),
    };
    assert_eq!(made[0].shape, half(7.5, 10.0));
    assert_eq!(made[0].position, vec2(fixed::types::I16F16::from_num(-77.5), px(27)));
    assert_eq!(made[1].shape, half(15.0, 5.0));
    assert_eq!(made[1].position, vec2(px(-85), px(42)));
    assert_eq!((made[0].sensor, made[0].one_way), (true, false));
    assert_eq!((made[1].sensor, made[1].one_way), (false, true));
    for body in &made {
        assert_eq!((body.kind, body.layer, body.mask, body.material.friction), (Kind::Static, 4, 2, px(1)));
    }
    let tile = TileData { column: 1, row: 1, flags: TileFlags::DAMAGE };
    assert_eq!(TileData::unpack(made[0].user_data), Ok(tile));
}

#[test]
fn no_body_is_larger_than_bodies_may_be() {
    let drawing = Drawing::of(vec![1; 1024], 1024, 1);
    let bodies = TileBodies::<Fixed> { origin: vec2(-16_384, 0), tile_size: vec2(30, 255), ..TileBodies::default() };
    let made: Vec<_> = bodies.of(&drawing.layer()).unwrap().collect();
    assert_eq!(made.len(), 4);
    for body in made {
        body.validate().unwrap();
    }
}

proptest! {
    #[test]
    fn every_tile_is_in_exactly_one_rectangle(
        width in 1u16..12, height in 1u16..12, tiles in prop::collection::vec(prop::sample::select(&[0u8, 0, 1, 1, 1, 2, 10, 16][..]), 144),
    ) {
        let drawing = Drawing::of(tiles[..usize::from(width * height)].to_vec(), width, height);
        let mut covered = vec![0u8; drawing.bytes.len()];
        for rect in TileBodies::<Fixed>::default().rects(&drawing.layer()).unwrap() {
            prop_assert!(rect.columns == 1 && rect.rows == 1 || !rect.flags.is_collectible());
            for row in rect.row..rect.row + rect.rows {
                for column in rect.column..rect.column + rect.columns {
                    let place = usize::from(row * width + column);
                    prop_assert_eq!(covered[place], 0, "in two rectangles");
                    covered[place] = rect.flags.bits();
                }
            }
        }
        prop_assert_eq!(covered, drawing.bytes);
    }
}

#[test]
fn all_bodies_are_added_or_none() {
    let drawing = Drawing::new(&["#.#.#"]);
    let mut storage = Storage::<Fixed, 4, 4>::new();
    let mut world = storage.world();
    let bodies = TileBodies::default();
    let two = TileBodies { max_entities: 2, ..bodies };
    let too_many = |limit| Err(Error::Tile(TileError::TooManyBodies { needed: 3, limit }));
    assert_eq!(world.spawn_tiles(&drawing.layer(), &two), too_many(2));
    let rough = TileBodies { material: Material { friction: px(2), ..Material::DEFAULT }, ..bodies };
    assert!(matches!(world.spawn_tiles(&drawing.layer(), &rough), Err(Error::OutOfRange { .. })));
    assert_eq!(world.statistics().bodies, 0);
    assert_eq!(world.spawn_tiles(&drawing.layer(), &bodies), Ok(3));
    assert_eq!(world.spawn_tiles(&drawing.layer(), &bodies), too_many(1));
    assert_eq!(world.statistics().bodies, 3);
}

#[test]
fn a_consumed_tile_takes_its_body_along_and_brings_it_back() {
    let mut drawing = Drawing::new(&["#$"]);
    let mut storage = Storage::<Fixed, 4, 4>::new();
    let mut world = storage.world();
    let bodies = TileBodies::default();
    world.spawn_tiles(&drawing.layer(), &bodies).unwrap();
    let mut map = drawing.map(vec2(0, 0), vec2(16, 16));
    let handles: Vec<_> = world.bodies().map(|body| body.handle).collect();
    let before = world.body(handles[1]).unwrap();

    assert_eq!(world.consume_tile(handles[0], &mut map), Ok(false), "a wall");
    assert_eq!(world.consume_tile(handles[1], &mut map), Ok(true));
    assert_eq!((world.statistics().bodies, map.flags(1, 0)), (1, TileFlags::NONE));
    assert_eq!(world.consume_tile(handles[1], &mut map), Err(Error::NoSuchBody { handle: handles[1] }));

    let again = world.restore_tile(1, 0, &mut map, &bodies).unwrap().expect("it was off");
    let after = world.body(again).unwrap();
    assert_eq!((after.position, after.user_data), (before.position, before.user_data));
    assert!(map.flags(1, 0).is_collectible());
    assert_eq!(world.restore_tile(1, 0, &mut map, &bodies), Ok(None), "it is there");
}
