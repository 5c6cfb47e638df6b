//! A map of tiles as a collider: one byte a tile, looked up by place.

use core::iter;
use core::ops::Range;

use super::axis::Axis;
use super::behavior::BehaviorLayer;
use super::error::TileError;
use super::flags::TileFlags;
use super::{check_coordinates, check_placement};
use crate::geometry::Bounds;
use crate::scalar::{Quantity, Scalar};
use crate::vec2::{Vec2, vec2};

/// Set in the byte of a tile that is switched off.
const INACTIVE: u8 = 1 << 7;

/// Without one of these bits, the byte of a tile neither blocks nor holds anything.
pub(super) const BLOCKING: u8 = TileFlags::SOLID.bits() | TileFlags::ONE_WAY.bits();

/// A tile of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Column.
    pub column: u16,
    /// Row.
    pub row: u16,
    /// What it does.
    pub flags: TileFlags,
}

impl Tile {
    #[inline]
    pub(super) fn new(column: u32, row: u32, bits: u8) -> Self {
        Self { column: column as u16, row: row as u16, flags: TileFlags::masked(bits) }
    }
}

/// A side of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// At the lesser x.
    Left,
    /// At the greater x.
    Right,
    /// At the lesser y.
    Top,
    /// At the greater y.
    Bottom,
}

/// Tiles on storage that somebody else owns. Beyond its edges there is nothing.
#[derive(Debug)]
pub struct TileMap<'a> {
    /// Row by row from the top left; flags and [`INACTIVE`].
    tiles: &'a mut [u8],
    columns: Axis,
    rows: Axis,
    inactive: u32,
    sensors: u32,
    /// The bits of all tiles, those that are off included.
    kinds: u8,
}

impl<'a> TileMap<'a> {
    /// A map without tiles, with room for one in each byte.
    pub fn new(storage: &'a mut [u8]) -> Self {
        Self { tiles: storage, columns: Axis::default(), rows: Axis::default(), inactive: 0, sensors: 0, kinds: 0 }
    }

    /// Takes over a layer, with all its tiles active; the tiles before are gone.
    ///
    /// `origin` is the top left corner, px. Tiles are `tile_size` px wide and high, both above 0.
    ///
    /// # Errors
    /// [`TileError::TileSize`], [`TileError::OutsideRange`] if not all of the map would lie within the coordinate range,
    /// [`TileError::NoRoom`] if the layer has more tiles than the storage has bytes. The old tiles then stay.
    pub fn load(&mut self, layer: &BehaviorLayer<'_>, origin: Vec2<i16>, tile_size: Vec2<u8>) -> Result<(), TileError> {
        check_placement(layer, origin, tile_size)?;
        let source = layer.bytes();
        let capacity = self.tiles.len();
        let room = self.tiles.get_mut(..source.len()).ok_or(TileError::NoRoom { needed: source.len(), capacity })?;
        room.copy_from_slice(source);
        self.columns = Axis::new(origin.x, tile_size.x, layer.width());
        self.rows = Axis::new(origin.y, tile_size.y, layer.height());
        self.inactive = 0;
        self.sensors = source.iter().filter(|&&bits| TileFlags::masked(bits).is_sensor()).count() as u32;
        self.kinds = source.iter().fold(0, |kinds, bits| kinds | bits);
        Ok(())
    }

    /// Becomes a copy of another map, tiles that are off included.
    ///
    /// # Errors
    /// [`TileError::NoRoom`] if the other one has more tiles than the storage has bytes. Nothing changes then.
    pub fn copy_from(&mut self, other: &TileMap<'_>) -> Result<(), TileError> {
        let source = other.bytes();
        let capacity = self.tiles.len();
        let room = self.tiles.get_mut(..source.len()).ok_or(TileError::NoRoom { needed: source.len(), capacity })?;
        room.copy_from_slice(source);
        (self.columns, self.rows) = (other.columns, other.rows);
        (self.inactive, self.sensors, self.kinds) = (other.inactive, other.sensors, other.kinds);
        Ok(())
    }

    /// Forgets all tiles.
    pub fn clear(&mut self) {
        (self.columns, self.rows) = (Axis::default(), Axis::default());
        (self.inactive, self.sensors, self.kinds) = (0, 0, 0);
    }

    /// Whether there are no tiles.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.columns.count() == 0
    }

    /// Columns and rows.
    pub fn size(&self) -> Vec2<u16> {
        vec2(self.columns.count() as u16, self.rows.count() as u16)
    }

    /// Top left corner, px.
    pub fn origin(&self) -> Vec2<i16> {
        vec2(self.columns.origin(), self.rows.origin())
    }

    /// Width and height of a tile, px.
    pub fn tile_size(&self) -> Vec2<u8> {
        vec2(self.columns.size(), self.rows.size())
    }

    /// Tiles that are switched off.
    pub fn inactive(&self) -> u32 {
        self.inactive
    }

    /// Active tiles that are sensors: if there are none, nothing can overlap one.
    #[inline]
    pub fn sensors(&self) -> u32 {
        self.sensors
    }

    /// Whether some tile may be one-way.
    #[inline]
    pub(super) fn has_one_way(&self) -> bool {
        self.kinds & TileFlags::ONE_WAY.bits() != 0
    }

    /// What a tile does; nothing if it is switched off or there is no such tile.
    #[inline]
    pub fn flags(&self, column: u16, row: u16) -> TileFlags {
        let bits = self.bits(column.into(), row.into());
        if bits & INACTIVE == 0 { TileFlags::masked(bits) } else { TileFlags::NONE }
    }

    /// What a tile does when it is on, if it is off.
    ///
    /// # Errors
    /// [`TileError::Coordinates`] if they are not in the map.
    pub fn inactive_flags(&self, column: u16, row: u16) -> Result<Option<TileFlags>, TileError> {
        self.check(column, row)?;
        let bits = self.bits(column.into(), row.into());
        Ok((bits & INACTIVE != 0).then_some(TileFlags::masked(bits)))
    }

    /// The tile at a place in px, if there is an active one.
    pub fn at<S: Scalar>(&self, position: Vec2<S::Real>) -> Option<Tile> {
        let (column, row) = (self.columns.index(S::floor(position.x)), self.rows.index(S::floor(position.y)));
        self.tile(column, row)
    }

    /// A tile's edges, px.
    #[inline]
    pub fn bounds<S: Scalar>(&self, tile: Tile) -> Bounds<S> {
        let (column, row) = (u32::from(tile.column), u32::from(tile.row));
        Bounds {
            min: vec2(self.columns.edge::<S>(column), self.rows.edge::<S>(row)),
            max: vec2(self.columns.edge::<S>(column + 1), self.rows.edge::<S>(row + 1)),
        }
    }

    /// The active tiles that overlap or touch a box, row by row.
    pub fn tiles_in<S: Scalar>(&self, bounds: &Bounds<S>) -> impl Iterator<Item = Tile> {
        let columns = self.columns.span::<S>(bounds.min.x, bounds.max.x);
        let mut rows = self.rows.span::<S>(bounds.min.y, bounds.max.y);
        let mut rest = columns.clone();
        iter::from_fn(move || {
            while !rows.is_empty() {
                if let Some(tile) = rest.find_map(|column| self.tile(column, rows.start)) {
                    return Some(tile);
                }
                (rows.start, rest) = (rows.start + 1, columns.clone());
            }
            None
        })
    }

    /// Whether a tile has that face: a solid tile where the tile beside it isn't solid, a one-way tile only its top.
    pub fn has_face(&self, column: u16, row: u16, side: Side) -> bool {
        let flags = self.flags(column, row);
        let acts = flags.is_solid() || (flags.is_one_way() && side == Side::Top);
        acts && self.is_open(Tile { column, row, flags }, side)
    }

    /// Switches a tile on or off: what is off neither blocks nor notices. True if that changed anything; where there is no
    /// tile, nothing changes.
    ///
    /// # Errors
    /// [`TileError::Coordinates`] if they are not in the map.
    pub fn set_active(&mut self, column: u16, row: u16, active: bool) -> Result<bool, TileError> {
        self.check(column, row)?;
        let place = usize::from(row) * self.columns.count() as usize + usize::from(column);
        let bits = &mut self.tiles[place];
        let flags = TileFlags::masked(*bits);
        let was_active = *bits & INACTIVE == 0;
        if flags == TileFlags::NONE || was_active == active {
            return Ok(false);
        }
        *bits ^= INACTIVE;
        let sensors = u32::from(flags.is_sensor());
        if active {
            self.inactive -= 1;
            self.sensors += sensors;
        } else {
            self.inactive += 1;
            self.sensors -= sensors;
        }
        Ok(true)
    }

    /// Switches a tile off if it is [collectible](TileFlags::COLLECTIBLE) and on. True if it was consumed by this.
    ///
    /// # Errors
    /// [`TileError::Coordinates`] if they are not in the map.
    pub fn consume(&mut self, column: u16, row: u16) -> Result<bool, TileError> {
        self.check(column, row)?;
        if self.flags(column, row).is_collectible() { self.set_active(column, row, false) } else { Ok(false) }
    }

    /// Switches a tile on again. True if it was off.
    ///
    /// # Errors
    /// [`TileError::Coordinates`] if they are not in the map.
    pub fn restore(&mut self, column: u16, row: u16) -> Result<bool, TileError> {
        self.set_active(column, row, true)
    }

    /// Switches all tiles on again; the number of those that were off.
    pub fn restore_all(&mut self) -> u32 {
        let (columns, rows) = (self.columns.count() as u16, self.rows.count() as u16);
        let mut restored = 0;
        for row in 0..rows {
            for column in 0..columns {
                restored += u32::from(self.restore(column, row) == Ok(true));
            }
        }
        restored
    }

    /// The byte of each tile, row by row: the state of the map, for digests and snapshots.
    pub fn bytes(&self) -> &[u8] {
        &self.tiles[..(self.columns.count() * self.rows.count()) as usize]
    }

    #[inline]
    pub(super) fn axes(&self) -> (&Axis, &Axis) {
        (&self.columns, &self.rows)
    }

    /// The byte of a tile; 0 beyond the edges, so that -1 may be spelled as `u32::MAX`.
    #[inline]
    pub(super) fn bits(&self, column: u32, row: u32) -> u8 {
        if column >= self.columns.count() || row >= self.rows.count() {
            return 0;
        }
        self.byte(row * self.columns.count() + column)
    }

    /// The byte at a place in the map, row by row.
    #[inline]
    pub(super) fn byte(&self, place: u32) -> u8 {
        self.tiles.get(place as usize).copied().unwrap_or(0)
    }

    /// The bytes from a place in the map on.
    #[inline]
    pub(super) fn bytes_from(&self, place: u32) -> &[u8] {
        self.tiles.get(place as usize..).unwrap_or_default()
    }

    #[inline]
    pub(super) fn is_solid(&self, column: u32, row: u32) -> bool {
        is_solid(self.bits(column, row))
    }

    /// Whether the place beside a tile isn't solid.
    #[inline]
    pub(super) fn is_open(&self, tile: Tile, side: Side) -> bool {
        let (column, row) = side.beside(tile.column.into(), tile.row.into());
        !self.is_solid(column, row)
    }

    /// The bytes of some tiles of a row.
    #[inline]
    pub(super) fn row(&self, row: u32, columns: &Range<u32>) -> &[u8] {
        let start = row * self.columns.count();
        self.tiles.get((start + columns.start) as usize..(start + columns.end) as usize).unwrap_or_default()
    }

    /// The tile at those coordinates, if there is an active one.
    pub(super) fn tile(&self, column: u32, row: u32) -> Option<Tile> {
        let bits = self.bits(column, row);
        let there = bits & INACTIVE == 0 && bits != 0;
        there.then_some(Tile::new(column, row, bits))
    }

    fn check(&self, column: u16, row: u16) -> Result<(), TileError> {
        check_coordinates(column, row, self.columns.count() as u16, self.rows.count() as u16)
    }
}

impl Side {
    /// Coordinates of the tile beside that side; they wrap around below 0.
    #[inline]
    pub(super) fn beside(self, column: u32, row: u32) -> (u32, u32) {
        match self {
            Self::Left => (column.wrapping_sub(1), row),
            Self::Right => (column + 1, row),
            Self::Top => (column, row.wrapping_sub(1)),
            Self::Bottom => (column, row + 1),
        }
    }

    /// The side by which the tile beside this side touches it.
    pub(super) fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
            Self::Top => Self::Bottom,
            Self::Bottom => Self::Top,
        }
    }

    /// The tile beside that side, if it is solid.
    pub(super) fn solid_beside(self, map: &TileMap<'_>, tile: Tile) -> Option<Tile> {
        let (column, row) = self.beside(tile.column.into(), tile.row.into());
        map.tile(column, row).filter(|tile| tile.flags.is_solid())
    }

    /// Unit vector into the tile.
    #[inline]
    pub(super) fn inward<S: Scalar>(self) -> Vec2<S::Unit> {
        match self {
            Self::Left => vec2(S::UNIT, S::Unit::ZERO),
            Self::Right => vec2(-S::UNIT, S::Unit::ZERO),
            Self::Top => vec2(S::Unit::ZERO, S::UNIT),
            Self::Bottom => vec2(S::Unit::ZERO, -S::UNIT),
        }
    }
}

/// Whether the byte of a tile says that it is active and solid.
#[inline]
pub(super) fn is_solid(bits: u8) -> bool {
    bits & INACTIVE == 0 && TileFlags::masked(bits).is_solid()
}

/// Whether the byte of a tile says that it is active and one-way.
#[inline]
pub(super) fn is_one_way(bits: u8) -> bool {
    bits & INACTIVE == 0 && TileFlags::masked(bits).is_one_way()
}
