//! Flags, packed tiles and layers.

use flat_physics::tiles::{BehaviorLayer, LegacyBehavior, LegacyTileData, MAX_SIDE, TileData, TileError, TileFlags};
use proptest::prelude::*;

#[test]
fn a_tile_blocks_in_one_way_at_most() {
    for bits in 0..=u8::MAX {
        let Some(flags) = TileFlags::from_bits(bits) else {
            assert!(bits > 0b11_1111, "{bits:#b}");
            continue;
        };
        let kinds = [flags.is_solid(), flags.is_one_way(), flags.is_sensor()];
        assert_eq!(kinds.iter().filter(|&&kind| kind).count(), usize::from(flags != TileFlags::NONE), "{flags:?}");
    }
}

#[test]
fn what_a_tile_is_follows_from_its_flags() {
    use TileFlags as Tile;
    assert!(Tile::SOLID.is_solid());
    assert!((Tile::SOLID | Tile::DAMAGE).is_solid(), "spikes that one can stand on");
    assert!((Tile::SOLID | Tile::COLLECTIBLE).is_solid(), "a brick that breaks");
    assert!((Tile::SOLID | Tile::ONE_WAY).is_one_way());
    assert!((Tile::SOLID | Tile::SENSOR).is_sensor());
    for flags in [Tile::SENSOR, Tile::DAMAGE, Tile::COLLECTIBLE, Tile::TRIGGER] {
        assert!(flags.is_sensor(), "{flags:?}");
    }
}

proptest! {
    #[test]
    fn packed_tiles_come_back(column in 0..MAX_SIDE, row in 0..MAX_SIDE, bits in 0u8..64) {
        let tile = TileData { column, row, flags: TileFlags::from_bits(bits).unwrap() };
        let packed = tile.pack().unwrap();
        prop_assert_eq!(packed, u32::from(column) | u32::from(row) << 10 | u32::from(bits) << 20);
        prop_assert_eq!(TileData::unpack(packed), Ok(tile));
    }

    #[test]
    fn a_value_unpacks_only_to_what_packs_to_it(packed: u32) {
        if let Ok(tile) = TileData::unpack(packed) {
            prop_assert_eq!(tile.pack(), Ok(packed));
        } else {
            prop_assert!(packed >> 20 >= 64);
        }
    }
}

#[test]
fn legacy_tiles_come_back_and_translate_to_flags() {
    use LegacyBehavior as Old;
    let all = [
        (Old::Solid, TileFlags::SOLID),
        (Old::Sensor, TileFlags::SENSOR),
        (Old::OneWayUp, TileFlags::ONE_WAY),
        (Old::Damage, TileFlags::SENSOR | TileFlags::DAMAGE),
        (Old::Destructible, TileFlags::SOLID | TileFlags::COLLECTIBLE),
    ];
    for (code, (behavior, flags)) in all.into_iter().enumerate() {
        let tile = LegacyTileData { column: 1023, row: 5, behavior };
        let packed = tile.pack().unwrap();
        assert_eq!(packed, 1023 | 5 << 10 | (code as u32) << 20);
        assert_eq!(LegacyTileData::unpack(packed), Ok(tile));
        assert_eq!(TileFlags::from(behavior), flags);
    }
    let packed = 5 << 20;
    assert_eq!(LegacyTileData::unpack(packed), Err(TileError::Packed { packed }));
}

#[test]
fn coordinates_beyond_ten_bits_don_t_pack() {
    for (column, row) in [(1024, 0), (0, 1024), (u16::MAX, 3)] {
        let error = TileError::Coordinates { column, row, columns: 1024, rows: 1024 };
        assert_eq!(TileData { column, row, flags: TileFlags::SOLID }.pack(), Err(error));
        assert_eq!(LegacyTileData { column, row, behavior: LegacyBehavior::Solid }.pack(), Err(error));
    }
}

#[test]
fn a_layer_tells_what_is_wrong_with_its_data() {
    let data = [1, 0, 64, 0, 0, 0];
    assert_eq!(BehaviorLayer::new(&data, 0, 6), Err(TileError::LayerSize { width: 0, height: 6 }));
    assert_eq!(BehaviorLayer::new(&data, 1025, 1), Err(TileError::LayerSize { width: 1025, height: 1 }));
    assert_eq!(BehaviorLayer::new(&data, 3, 3), Err(TileError::DataLength { given: 6, needed: 9 }));
    let error = BehaviorLayer::new(&data, 2, 3).unwrap_err();
    assert_eq!(error, TileError::UnknownFlags { bits: 64, column: 0, row: 1 });
    assert_eq!(error.to_string(), "tile flags 0x40 in column 0 of row 1 have unknown bits");
}

#[test]
fn a_layer_has_nothing_beyond_its_edges() {
    let data = [1, 2, 4, 8, 16, 32];
    let layer = BehaviorLayer::new(&data, 3, 2).unwrap();
    assert_eq!(layer.flags(2, 1), TileFlags::TRIGGER);
    for (column, row) in [(3, 0), (0, 2), (u16::MAX, 0), (0, u16::MAX)] {
        assert_eq!(layer.flags(column, row), TileFlags::NONE);
    }
}
