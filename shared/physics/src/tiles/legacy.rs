//! The older way to say what a tile does: one behaviour out of five.

use super::error::TileError;
use super::flags::TileFlags;
use super::packed::{ABOVE_COORDINATES, pack_coordinates, unpack_coordinates};
use super::{MAX_SIDE, check_coordinates};

/// The behaviour of a tile in levels made before there were [`TileFlags`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LegacyBehavior {
    /// Blocks from all sides.
    Solid,
    /// Notices what overlaps it.
    Sensor,
    /// Holds what lands on it from above.
    OneWayUp,
    /// Hurts what overlaps it.
    Damage,
    /// Blocks until it is destroyed.
    Destructible,
}

impl LegacyBehavior {
    const ALL: [Self; 5] = [Self::Solid, Self::Sensor, Self::OneWayUp, Self::Damage, Self::Destructible];
}

impl From<LegacyBehavior> for TileFlags {
    fn from(behavior: LegacyBehavior) -> Self {
        match behavior {
            LegacyBehavior::Solid => Self::SOLID,
            LegacyBehavior::Sensor => Self::SENSOR,
            LegacyBehavior::OneWayUp => Self::ONE_WAY,
            LegacyBehavior::Damage => Self::SENSOR | Self::DAMAGE,
            LegacyBehavior::Destructible => Self::SOLID | Self::COLLECTIBLE,
        }
    }
}

/// A tile's place and behaviour: packs like [`TileData`](super::TileData), with 4 bits of behaviour in place of the flags.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LegacyTileData {
    /// Column, below [`MAX_SIDE`].
    pub column: u16,
    /// Row, below [`MAX_SIDE`].
    pub row: u16,
    /// What the tile does.
    pub behavior: LegacyBehavior,
}

impl LegacyTileData {
    /// The packed value.
    ///
    /// # Errors
    /// [`TileError::Coordinates`] if one of them has more than 10 bits.
    pub const fn pack(self) -> Result<u32, TileError> {
        match check_coordinates(self.column, self.row, MAX_SIDE, MAX_SIDE) {
            Ok(()) => Ok(pack_coordinates(self.column, self.row) | (self.behavior as u32) << ABOVE_COORDINATES),
            Err(error) => Err(error),
        }
    }

    /// What a value was packed from.
    ///
    /// # Errors
    /// [`TileError::Packed`] if nothing packs to that value.
    pub fn unpack(packed: u32) -> Result<Self, TileError> {
        let behavior = (packed >> ABOVE_COORDINATES) as usize;
        let behavior = *LegacyBehavior::ALL.get(behavior).ok_or(TileError::Packed { packed })?;
        let (column, row) = unpack_coordinates(packed);
        Ok(Self { column, row, behavior })
    }
}
