//! The map: where its tiles are, which faces they have, what can be switched off.

use fixed::types::I16F16;
use flat_physics::geometry::Bounds;
use flat_physics::scalar::px;
use flat_physics::tiles::{BehaviorLayer, Side, TileError, TileFlags, TileMap};
use flat_physics::{Fixed, vec2};

use crate::drawing::{Drawing, flags};

#[test]
fn places_are_found_as_by_division() {
    let data = vec![1; 1024];
    let layer = BehaviorLayer::new(&data, 1024, 1).unwrap();
    let mut room = vec![0; 1024];
    let mut map = TileMap::new(&mut room);
    for size in 1..=u8::MAX {
        let count = (32_768 / i32::from(size)).min(1024);
        let layer = BehaviorLayer::new(&data[..count as usize], count as u16, 1).unwrap_or(layer);
        map.load(&layer, vec2(-16_384, 0), vec2(size, 1)).unwrap();
        for distance in -1..=count * i32::from(size) {
            let whole = (distance - 16_384).clamp(-32_768, 32_767);
            let found = map.at::<Fixed>(vec2(px(whole as i16), px(0))).map(|tile| i32::from(tile.column));
            let expected = distance / i32::from(size);
            let expected = (distance >= 0 && expected < count).then_some(expected);
            assert_eq!(found, expected, "{distance} px in tiles of {size} px");
        }
    }
}

#[test]
fn a_box_names_the_tiles_that_it_touches() {
    let mut drawing = Drawing::new(&["####", "####", "####"]);
    let map = drawing.map(vec2(-8, 4), vec2(16, 10));
    let named = |low: (i16, i16), high: (i16, i16)| {
        let corner = |(x, y)| vec2(px(x), px(y));
        let bounds = Bounds::<Fixed> { min: corner(low), max: corner(high) };
        map.tiles_in(&bounds).map(|tile| (tile.column, tile.row)).collect::<Vec<_>>()
    };
    assert_eq!(named((9, 15), (10, 16)), [(1, 1)]);
    assert_eq!(named((8, 15), (9, 16)), [(0, 1), (1, 1)], "touches on the left");
    assert_eq!(named((9, 15), (24, 16)), [(1, 1), (2, 1)], "touches on the right");
    assert_eq!(named((9, 14), (10, 24)), [(1, 0), (1, 1), (1, 2)], "touches above and below");
    assert_eq!(named((-9, 0), (-9, 99)), [], "beside the map");
    assert_eq!(named((-300, -300), (300, 300)).len(), 12);
}

#[test]
fn faces_between_solid_tiles_don_t_exist() {
    let mut drawing = Drawing::new(&[
        ".#..", //
        "###=", //
        "=#$.",
    ]);
    let map = drawing.map(vec2(0, 0), vec2(16, 16));
    let faces = |column, row| {
        [Side::Left, Side::Right, Side::Top, Side::Bottom].map(|side| u8::from(map.has_face(column, row, side)))
    };
    assert_eq!(faces(1, 1), [0, 0, 0, 0], "inside");
    assert_eq!(faces(1, 0), [1, 1, 1, 0], "at the edge of the map");
    assert_eq!(faces(0, 1), [1, 0, 1, 1], "above a one-way tile, which covers nothing");
    assert_eq!(faces(3, 1), [0, 0, 1, 0], "one-way");
    assert_eq!(faces(0, 2), [0, 0, 0, 0], "one-way under a solid tile");
    assert_eq!(faces(2, 2), [0, 0, 0, 0], "a sensor");
    assert_eq!(faces(2, 0), [0, 0, 0, 0], "nothing");
}

#[test]
fn only_collectible_tiles_are_consumed_and_all_come_back() {
    let mut drawing = Drawing::new(&["$#*.", "$==^"]);
    let mut map = drawing.map(vec2(0, 0), vec2(16, 16));
    assert_eq!(map.sensors(), 3);
    assert_eq!(map.consume(0, 0), Ok(true));
    assert_eq!(map.consume(0, 0), Ok(false), "it is gone already");
    assert_eq!(map.consume(1, 0), Ok(false), "a wall");
    assert_eq!(map.consume(2, 0), Ok(true), "a brick");
    assert_eq!(map.set_active(1, 0, false), Ok(true), "the game may switch off anything");
    assert_eq!(map.set_active(3, 0, false), Ok(false), "but where there is a tile");
    assert_eq!((map.inactive(), map.sensors()), (3, 2));
    assert_eq!(map.flags(0, 0), TileFlags::NONE);
    assert!(!map.has_face(2, 0, Side::Top));
    assert_eq!(map.at::<Fixed>(vec2(px(8), px(8))), None);

    assert_eq!(map.restore(2, 0), Ok(true));
    assert_eq!(map.restore(2, 0), Ok(false));
    assert!(map.has_face(2, 0, Side::Left), "the wall beside it is still off");
    assert_eq!(map.restore_all(), 2);
    assert_eq!((map.inactive(), map.sensors()), (0, 3));
    assert_eq!(map.flags(0, 0), flags('$'));
}

#[test]
fn a_map_refuses_what_doesn_t_fit_and_stays_as_it_was() {
    let (first, second) = (Drawing::new(&["#$"]), Drawing::new(&["###", "###"]));
    let mut room = [0; 5];
    let mut map = TileMap::new(&mut room);
    map.load(&first.layer(), vec2(0, 0), vec2(16, 16)).unwrap();
    let mut refused = |origin, size| map.load(&second.layer(), origin, size).unwrap_err();
    assert_eq!(refused(vec2(0, 0), vec2(16, 16)), TileError::NoRoom { needed: 6, capacity: 5 });
    assert_eq!(refused(vec2(0, 0), vec2(16, 0)), TileError::TileSize { width: 16, height: 0 });
    assert_eq!(refused(vec2(16_337, 0), vec2(16, 16)), TileError::OutsideRange { low: 16_337, high: 16_385 });
    assert_eq!(refused(vec2(0, -16_385), vec2(16, 16)), TileError::OutsideRange { low: -16_385, high: -16_353 });
    assert_eq!((map.size(), map.bytes()), (vec2(2, 1), &first.bytes[..]));
    let error = TileError::Coordinates { column: 2, row: 0, columns: 2, rows: 1 };
    assert_eq!(map.set_active(2, 0, false), Err(error));
    assert_eq!(map.consume(2, 0), Err(error));
    assert_eq!(error.to_string(), "no tile in column 2 of row 0: there are 2 columns and 1 rows");
    map.clear();
    assert!(map.is_empty() && map.at::<Fixed>(vec2(I16F16::ONE, I16F16::ONE)).is_none());
}
