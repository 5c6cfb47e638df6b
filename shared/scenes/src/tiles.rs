//! Maps of tiles for scenes.

use fixed::types::I16F16;
use flat_physics::tiles::BehaviorLayer;
use flat_physics::world::Terrain;
use flat_physics::{Error, Fixed, Material, Scalar, World, vec2};

use crate::parameters::Parameters;

/// A map of tiles and where it lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tiles {
    /// One byte of flags a tile, row by row from the top left.
    pub(crate) data: &'static [u8],
    pub(crate) width: u16,
    pub(crate) height: u16,
    /// Width and height of a tile, px.
    pub(crate) side: u8,
    pub(crate) material: Material<Fixed>,
}

impl Tiles {
    /// Lays the map with its top left corner at the scene's origin.
    pub(crate) fn lay<S: Scalar>(&self, parameters: &Parameters, world: &mut World<'_, S>) -> Result<(), Error<S>> {
        let layer = BehaviorLayer::new(self.data, self.width, self.height)?;
        let real = |value: I16F16| S::real(value);
        let Material { restitution, bounce, friction } = self.material;
        let [x, y] = parameters.variant.shift;
        let terrain = Terrain {
            origin: vec2(x, y),
            tile_size: vec2(self.side, self.side),
            material: Material { restitution: real(restitution), bounce, friction: real(friction) },
            ..Terrain::DEFAULT
        };
        world.set_tiles(&layer, &terrain).map(|_| ())
    }
}
