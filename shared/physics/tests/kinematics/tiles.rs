//! Maps of tiles under a walker.

use flat_physics::scalar::px;
use flat_physics::tiles::{BehaviorLayer, TileFlags};
use flat_physics::world::Terrain;
use flat_physics::{BodyDef, Collider, Fixed, SlideOptions, World};

use crate::{Walker, at, height, place, player, rect};

/// A map of 16 px tiles from its picture: `#` solid, `=` one-way, `o` coin.
fn level<const COLUMNS: usize>(world: &mut World<'_, Fixed>, picture: &[&[u8; COLUMNS]], terrain: &Terrain<Fixed>) {
    let flags = |tile: &u8| match tile {
        b'#' => TileFlags::SOLID,
        b'=' => TileFlags::ONE_WAY,
        b'o' => TileFlags::COLLECTIBLE,
        _ => TileFlags::NONE,
    };
    let bytes: Vec<u8> = picture.iter().flat_map(|row| row.iter().map(|tile| flags(tile).bits())).collect();
    let layer = BehaviorLayer::new(&bytes, COLUMNS as u16, picture.len() as u16).unwrap();
    world.set_tiles(&layer, terrain).unwrap();
}

#[test]
fn tiles_are_floors_walls_ledges_and_coins() {
    world!(world, [hero = player(rect(4, 6), 40, 20)]);
    let picture = [b"            ", b"            ", b"  ==   oo  #", b"           #", b"############"];
    level(&mut world, &picture, &Terrain::DEFAULT);
    let mut walker = Walker::new(hero);
    while !walker.walk(&mut world, 0).floor {}
    assert_eq!(place(&world, hero), (40.0, 26.0), "on the ledge");
    walker.options.drop_through = true;
    while place(&world, hero).1 < 40.0 {
        walker.walk(&mut world, 0);
    }
    walker.options.drop_through = false;
    while !walker.walk(&mut world, 0).floor {}
    assert_eq!(place(&world, hero), (40.0, 58.0), "on the ground");
    loop {
        let slide = walker.walk(&mut world, 150);
        assert!(slide.floor);
        if slide.wall {
            break;
        }
        assert_eq!(slide.velocity, at(150, 0), "at {:?}", place(&world, hero));
    }
    assert_eq!(place(&world, hero), (172.0, 58.0), "at the wall");
    // Up through the coins and back.
    let mut coins = Vec::new();
    walker.velocity.y = px(-150);
    while place(&world, hero).0 > 60.0 {
        for sensor in walker.walk(&mut world, -150).sensors() {
            let Collider::Tile(tile) = sensor else { panic!("no body here") };
            if !coins.contains(&(tile.column, tile.row)) {
                coins.push((tile.column, tile.row));
            }
        }
    }
    assert_eq!(coins, [(8, 2), (7, 2)]);
    // Up through the ledge from below, onto it from above.
    walker.velocity.y = px(-300);
    while !walker.walk(&mut world, -20).floor {}
    assert_eq!(height(&world, hero), px(26));
}

#[test]
fn tiles_let_out_what_is_inside_them_and_through_whom_they_do_not_meet() {
    let picture = [b"     ", b"     ", b"#####"];
    world!(world, [hero = player(rect(4, 6), 40, 29)]);
    level(&mut world, &picture, &Terrain::DEFAULT);
    let slide = world.move_and_slide(hero, at(0, 60), &SlideOptions::default()).unwrap();
    assert!(slide.floor);
    assert_eq!(place(&world, hero), (40.0, 26.0));
    assert!(world.move_and_collide(hero, at(0, 90)).unwrap().is_some());
    let elsewhere = Terrain { layer: 2, mask: 2, ..Terrain::DEFAULT };
    world!(world, [hero = BodyDef { mask: 1, ..player(rect(4, 6), 40, 20) }]);
    level(&mut world, &picture, &elsewhere);
    assert_eq!(world.move_and_collide(hero, at(0, 90)).unwrap(), None);
}
