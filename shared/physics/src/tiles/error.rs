//! What can be wrong with tiles. Nothing changes when an error is returned.

use core::fmt;

use super::MAX_SIDE;
use crate::scalar::POSITION_LIMIT;

/// Why a call about tiles was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TileError {
    /// There is no such tile.
    Coordinates {
        /// Column asked for.
        column: u16,
        /// Row asked for.
        row: u16,
        /// Columns there are.
        columns: u16,
        /// Rows there are.
        rows: u16,
    },
    /// A layer without tiles, or with more columns or rows than coordinates can name.
    LayerSize {
        /// Columns.
        width: u16,
        /// Rows.
        height: u16,
    },
    /// A layer's data isn't one byte for each of its tiles.
    DataLength {
        /// Bytes given.
        given: usize,
        /// Bytes needed.
        needed: usize,
    },
    /// A byte of a layer has bits that are no flag.
    UnknownFlags {
        /// The byte.
        bits: u8,
        /// Column where it stands.
        column: u16,
        /// Row where it stands.
        row: u16,
    },
    /// No tile packs to this value.
    Packed {
        /// The value.
        packed: u32,
    },
    /// Tiles without area.
    TileSize {
        /// Width, px.
        width: u8,
        /// Height, px.
        height: u8,
    },
    /// Part of the map would lie outside the coordinate range.
    OutsideRange {
        /// The map's left or top end, px.
        low: i32,
        /// Its right or bottom end, px.
        high: i32,
    },
    /// More tiles than the storage has bytes for.
    NoRoom {
        /// Tiles.
        needed: usize,
        /// Bytes.
        capacity: usize,
    },
    /// A layer makes more bodies than it may.
    TooManyBodies {
        /// Bodies that the layer makes.
        needed: u32,
        /// Bodies that it may make.
        limit: u32,
    },
}

impl fmt::Display for TileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Coordinates { column, row, columns, rows } => {
                write!(f, "no tile in column {column} of row {row}: there are {columns} columns and {rows} rows")
            }
            Self::LayerSize { width, height } => {
                write!(f, "a layer of {width} columns and {height} rows: both must be 1..={MAX_SIDE}")
            }
            Self::DataLength { given, needed } => write!(f, "{given} bytes of layer data, must be {needed}"),
            Self::UnknownFlags { bits, column, row } => {
                write!(f, "tile flags {bits:#04x} in column {column} of row {row} have unknown bits")
            }
            Self::Packed { packed } => write!(f, "{packed:#010x} is no packed tile"),
            Self::TileSize { width, height } => {
                write!(f, "tiles of {width} x {height} px: both must be above 0")
            }
            Self::OutsideRange { low, high } => {
                write!(f, "the map spans {low}..{high} px, must lie within +-{POSITION_LIMIT}")
            }
            Self::NoRoom { needed, capacity } => write!(f, "{needed} tiles, there is room for {capacity}"),
            Self::TooManyBodies { needed, limit } => write!(f, "the layer makes {needed} bodies, may make {limit}"),
        }
    }
}

impl core::error::Error for TileError {}
