//! Levels from drawings.

use flat_physics::Vec2;
use flat_physics::tiles::{BehaviorLayer, TileFlags, TileMap};

/// A drawn level: its tiles, and room for a map of them.
pub(crate) struct Drawing {
    pub(crate) bytes: Vec<u8>,
    pub(crate) width: u16,
    pub(crate) height: u16,
    room: Vec<u8>,
}

impl Drawing {
    pub(crate) fn new(rows: &[&str]) -> Self {
        let width = rows[0].chars().count();
        assert!(rows.iter().all(|row| row.chars().count() == width), "rows differ in length");
        let bytes = rows.iter().flat_map(|row| row.chars()).map(|tile| flags(tile).bits()).collect();
        Self::of(bytes, width as u16, rows.len() as u16)
    }

    pub(crate) fn of(bytes: Vec<u8>, width: u16, height: u16) -> Self {
        let room = vec![0; bytes.len()];
        Self { bytes, width, height, room }
    }

    pub(crate) fn layer(&self) -> BehaviorLayer<'_> {
        BehaviorLayer::new(&self.bytes, self.width, self.height).expect("drawings are valid")
    }

    pub(crate) fn map(&mut self, origin: Vec2<i16>, tile_size: Vec2<u8>) -> TileMap<'_> {
        let layer = BehaviorLayer::new(&self.bytes, self.width, self.height).expect("drawings are valid");
        let mut map = TileMap::new(&mut self.room);
        map.load(&layer, origin, tile_size).expect("drawings fit");
        map
    }

    /// The same level seen in a mirror beside it.
    pub(crate) fn mirrored(&self) -> Self {
        let rows = self.bytes.chunks(self.width.into());
        Self::of(rows.flat_map(|row| row.iter().rev().copied()).collect(), self.width, self.height)
    }
}

pub(crate) fn flags(tile: char) -> TileFlags {
    match tile {
        '#' => TileFlags::SOLID,
        '=' => TileFlags::ONE_WAY,
        '$' => TileFlags::SENSOR | TileFlags::COLLECTIBLE,
        '^' => TileFlags::DAMAGE,
        '*' => TileFlags::SOLID | TileFlags::COLLECTIBLE,
        '?' => TileFlags::TRIGGER,
        '.' => TileFlags::NONE,
        other => panic!("no tile is drawn as {other:?}"),
    }
}
