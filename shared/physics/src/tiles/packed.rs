//! A tile's place and flags in the 32 bits of a body's user data.

use super::error::TileError;
use super::flags::TileFlags;
use super::{MAX_SIDE, check_coordinates};

/// Bits of a coordinate.
pub(super) const COORDINATE_BITS: u32 = MAX_SIDE.trailing_zeros();
/// Position of what stands above both coordinates.
pub(super) const ABOVE_COORDINATES: u32 = 2 * COORDINATE_BITS;

/// What the bodies of a layer carry as user data: which tile they stand for.
///
/// ```text
/// bit 31..28   27..20   19..10   9..0
///     0        flags    row      column
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct TileData {
    /// Column, below [`MAX_SIDE`].
    pub column: u16,
    /// Row, below [`MAX_SIDE`].
    pub row: u16,
    /// What the tile does.
    pub flags: TileFlags,
}

impl TileData {
    /// The packed value.
    ///
    /// # Errors
    /// [`TileError::Coordinates`] if one of them has more than 10 bits.
    pub const fn pack(self) -> Result<u32, TileError> {
        match check_coordinates(self.column, self.row, MAX_SIDE, MAX_SIDE) {
            Ok(()) => Ok(self.packed()),
            Err(error) => Err(error),
        }
    }

    /// The packed value of coordinates that are in range.
    pub(super) const fn packed(self) -> u32 {
        pack_coordinates(self.column, self.row) | (self.flags.bits() as u32) << ABOVE_COORDINATES
    }

    /// What a value was packed from.
    ///
    /// # Errors
    /// [`TileError::Packed`] if nothing packs to that value.
    pub const fn unpack(packed: u32) -> Result<Self, TileError> {
        let above = packed >> ABOVE_COORDINATES;
        match TileFlags::from_bits(above as u8) {
            Some(flags) if above <= u8::MAX as u32 => {
                let (column, row) = unpack_coordinates(packed);
                Ok(Self { column, row, flags })
            }
            _ => Err(TileError::Packed { packed }),
        }
    }
}

pub(super) const fn pack_coordinates(column: u16, row: u16) -> u32 {
    column as u32 | (row as u32) << COORDINATE_BITS
}

pub(super) const fn unpack_coordinates(packed: u32) -> (u16, u16) {
    let mask = MAX_SIDE as u32 - 1;
    ((packed & mask) as u16, (packed >> COORDINATE_BITS & mask) as u16)
}
