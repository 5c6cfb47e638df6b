//! Levels made of tiles: what a tile does, a map of them that collides as one surface, and bodies built from a layer.
//!
//! ```text
//! editor ─▶ BehaviorLayer ──▶ TileMap        a collider of its own: one byte a tile, no body
//!           one byte a tile └▶ TileBodies    the same as static bodies: runs of equal tiles merged into few boxes
//! ```
//!
//! A [`TileMap`] has no internal edges. A face between two solid tiles doesn't exist, so nothing can catch on it: what slides
//! along a row of tiles slides along one surface.

use crate::scalar::POSITION_LIMIT;
use crate::vec2::Vec2;

mod around;
mod axis;
mod behavior;
mod bodies;
mod cast;
mod contacts;
mod error;
mod flags;
mod legacy;
mod map;
mod packed;
mod touch;

pub use behavior::BehaviorLayer;
pub use bodies::{TileBodies, TileRect};
pub use cast::TileHit;
pub use contacts::TileContact;
pub use error::TileError;
pub use flags::TileFlags;
pub use legacy::{LegacyBehavior, LegacyTileData};
pub use map::{Side, Tile, TileMap};
pub use packed::TileData;

/// Most columns and most rows of a map: tile coordinates have 10 bits.
pub const MAX_SIDE: u16 = 1024;

/// Whether there is such a tile.
const fn check_coordinates(column: u16, row: u16, columns: u16, rows: u16) -> Result<(), TileError> {
    if column < columns && row < rows { Ok(()) } else { Err(TileError::Coordinates { column, row, columns, rows }) }
}

/// Whether tiles of that size can lie at that place.
fn check_placement(layer: &BehaviorLayer<'_>, origin: Vec2<i16>, tile_size: Vec2<u8>) -> Result<(), TileError> {
    if tile_size.x == 0 || tile_size.y == 0 {
        return Err(TileError::TileSize { width: tile_size.x, height: tile_size.y });
    }
    let limit = i32::from(POSITION_LIMIT);
    for (origin, size, count) in [(origin.x, tile_size.x, layer.width()), (origin.y, tile_size.y, layer.height())] {
        let low = i32::from(origin);
        let high = low + i32::from(size) * i32::from(count);
        if low < -limit || high > limit {
            return Err(TileError::OutsideRange { low, high });
        }
    }
    Ok(())
}
