//! The tile map of a world: one collider, a byte a tile, and one slot that stands for it.

use super::World;
use crate::body::BodyDef;
use crate::contact::Flags;
use crate::effects::Effects;
use crate::error::Error;
use crate::handle::Handle;
use crate::material::Material;
use crate::scalar::Scalar;
use crate::shape::Shape;
use crate::tiles::{BehaviorLayer, TileFlags, TileMap};
use crate::variety::Variety;
use crate::vec2::{Vec2, vec2};

/// No slot: a world without tiles.
pub(crate) const NO_TERRAIN: u16 = u16::MAX;

/// Where a map of tiles lies, and what its tiles have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terrain<S: Scalar> {
    /// Top left corner, px.
    pub origin: Vec2<i16>,
    /// Width and height of a tile, px, above 0.
    pub tile_size: Vec2<u8>,
    /// Surface of all tiles.
    pub material: Material<S>,
    /// Layers that the map is on.
    pub layer: u16,
    /// Layers that the map collides with.
    pub mask: u16,
}

impl<S: Scalar> Terrain<S> {
    /// Tiles of 16 x 16 px from (0, 0) on that neither bounce nor rub.
    pub const DEFAULT: Self = Self {
        origin: vec2(0, 0),
        tile_size: vec2(16, 16),
        material: Material { bounce: false, ..Material::DEFAULT },
        layer: 1,
        mask: u16::MAX,
    };
}

impl<S: Scalar> Default for Terrain<S> {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl<S: Scalar> World<'_, S> {
    /// Lays a map of tiles, in place of the one that there was. It takes one body slot, whose handle stands for it in contacts and
    /// events: a disabled static body; to despawn that removes the map.
    ///
    /// # Errors
    /// [`Error::Tile`] if the map is too large for the storage's `TILES` or reaches out of the coordinate range; otherwise as
    /// [`spawn`](Self::spawn). Nothing changes then.
    pub fn set_tiles(&mut self, layer: &BehaviorLayer<'_>, terrain: &Terrain<S>) -> Result<Handle, Error<S>> {
        let Terrain { origin, tile_size, material, layer: on, mask } = *terrain;
        let shape = Shape::Box { half: vec2(S::ONE, S::ONE) };
        let place = vec2(S::Real::default(), S::Real::default());
        let def = BodyDef { material, layer: on, mask, enabled: false, ..BodyDef::fixed(shape, place) };
        def.validate()?;
        let before = self.terrain;
        if before == NO_TERRAIN && self.count_free() == 0 {
            return Err(Error::Full { capacity: self.capacity() });
        }
        let effects = called_for(layer);
        self.check_declared(None, effects)?;
        self.tiles.load(layer, origin, tile_size)?;
        if before != NO_TERRAIN {
            let mut tiles = core::mem::replace(&mut self.tiles, TileMap::new(&mut []));
            let gone = self.handle(before);
            self.terrain = NO_TERRAIN;
            self.despawn(gone)?;
            core::mem::swap(&mut self.tiles, &mut tiles);
        }
        let handle = self.spawn(&def)?;
        self.call_for(handle.slot, effects, Variety::BOXES)?;
        self.terrain = handle.slot;
        self.wake_all();
        Ok(handle)
    }

    /// The map; empty if there is none.
    pub fn tiles(&self) -> &TileMap<'_> {
        &self.tiles
    }

    /// Switches a tile on or off; whether that changed it. What stood on it falls, what lies in it is pushed out.
    ///
    /// # Errors
    /// [`Error::Tile`] if the tile is not in the map.
    pub fn set_tile_active(&mut self, column: u16, row: u16, active: bool) -> Result<bool, Error<S>> {
        let changed = self.tiles.set_active(column, row, active)?;
        if changed {
            self.changed(false);
            let terrain = self.terrain;
            self.contacts_of(terrain).for_each(|contact| contact.flags.set(Flags::NEW));
            self.wake_all();
        }
        Ok(changed)
    }

    /// Lets a body fall through the one-way platforms and tiles that it stands on; they hold it again once it has passed.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`] if the body is gone.
    pub fn drop_through(&mut self, handle: Handle) -> Result<(), Error<S>> {
        self.slot(handle)?;
        self.disturb(handle.slot);
        for contact in self.contacts_of(handle.slot).filter(|contact| contact.flags.has(Flags::LANDED)) {
            contact.flags.clear(Flags::LANDED);
            contact.flags.set(Flags::DROPPED.or(Flags::NEW));
        }
        Ok(())
    }

    /// Slots without a body.
    fn count_free(&self) -> u16 {
        self.capacity() - self.count
    }
}

/// The effects without which a map would not do what its tiles say.
fn called_for(layer: &BehaviorLayer<'_>) -> Effects {
    let any = |condition: fn(TileFlags) -> bool, effect| {
        let there = layer.bytes().iter().any(|&bits| TileFlags::from_bits(bits).is_some_and(condition));
        if there { effect } else { Effects::NONE }
    };
    Effects::TILES | any(TileFlags::is_one_way, Effects::ONE_WAY) | any(TileFlags::is_sensor, Effects::SENSORS)
}
