//! The layer of a level that says what its tiles do, as a level editor exports it.

use super::MAX_SIDE;
use super::error::TileError;
use super::flags::TileFlags;

/// One byte of [`TileFlags`] for each tile, row by row from the top left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BehaviorLayer<'a> {
    data: &'a [u8],
    width: u16,
    height: u16,
}

impl<'a> BehaviorLayer<'a> {
    /// A layer of `width` columns and `height` rows.
    ///
    /// # Errors
    /// [`TileError::LayerSize`] unless both are 1..=1024, [`TileError::DataLength`] unless `data` has a byte for each tile,
    /// [`TileError::UnknownFlags`] with the first byte that has bits beyond the flags.
    pub fn new(data: &'a [u8], width: u16, height: u16) -> Result<Self, TileError> {
        if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
            return Err(TileError::LayerSize { width, height });
        }
        let needed = usize::from(width) * usize::from(height);
        if data.len() != needed {
            return Err(TileError::DataLength { given: data.len(), needed });
        }
        if let Some(place) = data.iter().position(|&bits| TileFlags::from_bits(bits).is_none()) {
            let (row, column) = (place / usize::from(width), place % usize::from(width));
            return Err(TileError::UnknownFlags { bits: data[place], column: column as u16, row: row as u16 });
        }
        Ok(Self { data, width, height })
    }

    /// Columns.
    pub fn width(&self) -> u16 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u16 {
        self.height
    }

    /// What a tile does; nothing outside the layer.
    pub fn flags(&self, column: u16, row: u16) -> TileFlags {
        if column >= self.width || row >= self.height {
            return TileFlags::NONE;
        }
        TileFlags::masked(self.data[usize::from(row) * usize::from(self.width) + usize::from(column)])
    }

    /// A byte for each tile, row by row.
    pub(crate) fn bytes(&self) -> &'a [u8] {
        self.data
    }
}
