//! Static bodies in place of a map: runs of equal tiles merged into few boxes.

use ::fixed::types::I16F16;

use super::behavior::BehaviorLayer;
use super::check_placement;
use super::error::TileError;
use super::flags::TileFlags;
use super::map::TileMap;
use super::packed::TileData;
use crate::body::BodyDef;
use crate::error::Error;
use crate::handle::Handle;
use crate::material::Material;
use crate::scalar::{EXTENT_LIMIT, Scalar};
use crate::shape::Shape;
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// How the bodies of a layer are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TileBodies<S: Scalar> {
    /// Top left corner of the layer, px.
    pub origin: Vec2<i16>,
    /// Width and height of a tile, px, above 0. Default 16 x 16.
    pub tile_size: Vec2<u8>,
    /// Most bodies that the layer may make. Default 65535: as many as there can be.
    pub max_entities: u16,
    /// Layers that the bodies are on. Default 1.
    pub layer: u16,
    /// Layers that the bodies collide with. Default all.
    pub mask: u16,
    /// Surface of the bodies.
    pub material: Material<S>,
}

impl<S: Scalar> Default for TileBodies<S> {
    fn default() -> Self {
        Self {
            origin: vec2(0, 0),
            tile_size: vec2(16, 16),
            max_entities: u16::MAX,
            layer: 1,
            mask: u16::MAX,
            material: Material::DEFAULT,
        }
    }
}

/// A rectangle of equal tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileRect {
    /// First column.
    pub column: u16,
    /// First row.
    pub row: u16,
    /// Columns.
    pub columns: u16,
    /// Rows.
    pub rows: u16,
    /// What its tiles do.
    pub flags: TileFlags,
}

impl<S: Scalar> TileBodies<S> {
    /// The bodies of a layer, from the top left.
    ///
    /// Each is a static box with [`TileData`] of its first tile as user data; a sensor or one-way if its tiles are. Runs of
    /// equal tiles in a row are one body; equal runs above each other are one body too, unless they are one-way. Collectible
    /// tiles have a body each, so that each can be consumed.
    ///
    /// # Errors
    /// [`TileError::TileSize`]; [`TileError::OutsideRange`] if not all of the layer would lie within the coordinate range;
    /// [`TileError::TooManyBodies`] with their number.
    pub fn of(&self, layer: &BehaviorLayer<'_>) -> Result<impl Iterator<Item = BodyDef<S>>, TileError> {
        let rects = self.rects(layer)?;
        Ok(rects.map(|rect| self.body(rect)))
    }

    /// The rectangles behind [`of`](Self::of).
    ///
    /// # Errors
    /// As there.
    pub fn rects<'a>(
        &self,
        layer: &BehaviorLayer<'a>,
    ) -> Result<impl Iterator<Item = TileRect> + use<'a, S>, TileError> {
        check_placement(layer, self.origin, self.tile_size)?;
        let widest = |size: u8| 2 * EXTENT_LIMIT as u16 / u16::from(size);
        let rects =
            Rects { layer: *layer, most: vec2(widest(self.tile_size.x), widest(self.tile_size.y)), column: 0, row: 0 };
        let (needed, limit) = (rects.clone().count() as u32, u32::from(self.max_entities));
        if needed > limit { Err(TileError::TooManyBodies { needed, limit }) } else { Ok(rects) }
    }

    /// A body for all tiles of a rectangle.
    fn body(&self, rect: TileRect) -> BodyDef<S> {
        let TileRect { column, row, columns, rows, flags } = rect;
        // Twice the centre fits: the layer lies within the coordinate range.
        let centre = |origin: i16, size: u8, first: u16, count: u16| {
            let doubled = 2 * i32::from(origin) + i32::from(size) * (2 * i32::from(first) + i32::from(count));
            S::real(half_px(doubled))
        };
        let half = |size: u8, count: u16| S::real(half_px(i32::from(size) * i32::from(count)));
        let shape = Shape::Box { half: vec2(half(self.tile_size.x, columns), half(self.tile_size.y, rows)) };
        let position = vec2(
            centre(self.origin.x, self.tile_size.x, column, columns),
            centre(self.origin.y, self.tile_size.y, row, rows),
        );
        BodyDef {
            sensor: flags.is_sensor(),
            one_way: flags.is_one_way(),
            layer: self.layer,
            mask: self.mask,
            material: self.material,
            user_data: TileData { column, row, flags }.packed(),
            ..BodyDef::fixed(shape, position)
        }
    }
}

/// Finds the rectangles of a layer without remembering any: each tile tells by its neighbours whether one begins at it.
#[derive(Clone)]
struct Rects<'a> {
    layer: BehaviorLayer<'a>,
    /// Most columns and rows of a body: rectangles end at the multiples of these.
    most: Vec2<u16>,
    column: u16,
    row: u16,
}

impl Iterator for Rects<'_> {
    type Item = TileRect;

    fn next(&mut self) -> Option<TileRect> {
        while self.row < self.layer.height() {
            let (column, row) = (self.column, self.row);
            let flags = self.layer.flags(column, row);
            let end = self.run_end(column, row);
            (self.column, self.row) = if end < self.layer.width() { (end, row) } else { (0, row + 1) };
            let stacks = !flags.is_one_way() && !flags.is_collectible();
            let continues_below =
                |row: u16| stacks && !(row + 1).is_multiple_of(self.most.y) && self.runs_alike(column, end, row);
            if flags == TileFlags::NONE || (row > 0 && continues_below(row - 1)) {
                continue;
            }
            let last =
                (row..self.layer.height() - 1).find(|&row| !continues_below(row)).unwrap_or(self.layer.height() - 1);
            return Some(TileRect { column, row, columns: end - column, rows: last + 1 - row, flags });
        }
        None
    }
}

impl Rects<'_> {
    /// The first column after the run of equal tiles that begins at a tile.
    fn run_end(&self, column: u16, row: u16) -> u16 {
        let flags = self.layer.flags(column, row);
        let ends = |&next: &u16| {
            flags.is_collectible() || next.is_multiple_of(self.most.x) || self.layer.flags(next, row) != flags
        };
        (column + 1..self.layer.width()).find(ends).unwrap_or(self.layer.width())
    }

    /// Whether a row and the row below it have the same run of tiles there.
    fn runs_alike(&self, column: u16, end: u16, row: u16) -> bool {
        let is_run = |row| {
            let begins = column.is_multiple_of(self.most.x)
                || self.layer.flags(column - 1, row) != self.layer.flags(column, row);
            begins && self.run_end(column, row) == end
        };
        self.layer.flags(column, row) == self.layer.flags(column, row + 1) && is_run(row) && is_run(row + 1)
    }
}

/// Half a number of px, up to +-2^15 of them.
fn half_px(doubled: i32) -> I16F16 {
    I16F16::from_bits(doubled << 15)
}

impl<S: Scalar> World<'_, S> {
    /// Adds a body for each rectangle of equal tiles of a layer: see [`TileBodies::of`]. Returns their number.
    ///
    /// # Errors
    /// What [`TileBodies::of`] finds; [`TileError::TooManyBodies`] also if there are fewer free slots; what
    /// [`BodyDef::validate`] finds wrong with the material. No body is added then.
    pub fn spawn_tiles(&mut self, layer: &BehaviorLayer<'_>, bodies: &TileBodies<S>) -> Result<u16, Error<S>> {
        let needed = bodies.rects(layer)?.count() as u32;
        let room = u32::from(self.capacity() - self.statistics().bodies);
        if needed > room {
            return Err(TileError::TooManyBodies { needed, limit: room }.into());
        }
        bodies.of(layer)?.try_for_each(|body| body.validate())?;
        for body in bodies.of(layer)? {
            self.spawn(&body)?;
        }
        Ok(needed as u16)
    }

    /// Consumes the tile that a body stands for, if it is [collectible](TileFlags::COLLECTIBLE): the body is gone and the tile
    /// of the map switched off. True if that was done; false if the tile isn't collectible.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`TileError::Packed`] if the body's user data are no [`TileData`]; [`TileError::Coordinates`] if
    /// the map has no such tile.
    pub fn consume_tile(&mut self, body: Handle, map: &mut TileMap<'_>) -> Result<bool, Error<S>> {
        let TileData { column, row, flags } = TileData::unpack(self.body(body)?.user_data)?;
        if !flags.is_collectible() {
            return Ok(false);
        }
        map.set_active(column, row, false)?;
        self.despawn(body)?;
        Ok(true)
    }

    /// Brings a consumed tile back: switches it on in the map and adds a body for it. None if the tile is on.
    ///
    /// # Errors
    /// [`TileError::Coordinates`] if the map has no such tile; what [`World::spawn`] finds. Nothing changes then.
    pub fn restore_tile(
        &mut self,
        column: u16,
        row: u16,
        map: &mut TileMap<'_>,
        bodies: &TileBodies<S>,
    ) -> Result<Option<Handle>, Error<S>> {
        let Some(flags) = map.inactive_flags(column, row)? else {
            return Ok(None);
        };
        let handle = self.spawn(&bodies.body(TileRect { column, row, columns: 1, rows: 1, flags }))?;
        map.restore(column, row)?;
        Ok(Some(handle))
    }
}
