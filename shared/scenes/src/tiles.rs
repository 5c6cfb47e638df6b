//! Maps of tiles for scenes.

use fixed::types::I16F16;
use flat_physics::scalar::px;
use flat_physics::tiles::{BehaviorLayer, TileFlags};
use flat_physics::world::Terrain;
use flat_physics::{Error, Fixed, Material, Scalar, Vec2, World, vec2};

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

    /// Upper left and lower right corner of each solid tile, px.
    pub(crate) fn solid(&self) -> impl Iterator<Item = [Vec2<I16F16>; 2]> {
        let corner =
            |column: usize, row: usize| vec2(column, row).map(|place| px(place as i16) * I16F16::from_num(self.side));
        let is_solid = |flags: &u8| TileFlags::from_bits(*flags).is_some_and(TileFlags::is_solid);
        let places = self.data.iter().enumerate().filter(move |(_, flags)| is_solid(flags));
        places.map(move |(place, _)| {
            let (column, row) = (place % usize::from(self.width), place / usize::from(self.width));
            [corner(column, row), corner(column + 1, row + 1)]
        })
    }
}

/// A map as it is drawn: `#` solid, `-` blocks from above, `o` a coin, `^` spikes, anything else is air.
pub(crate) const fn drawn<const COLUMNS: usize, const ROWS: usize, const TILES: usize>(
    rows: &[&[u8; COLUMNS]; ROWS],
) -> [u8; TILES] {
    assert!(TILES == COLUMNS * ROWS, "one byte a tile");
    let mut tiles = [TileFlags::NONE.bits(); TILES];
    let mut place = 0;
    while place < TILES {
        tiles[place] = match rows[place / COLUMNS][place % COLUMNS] {
            b'#' => TileFlags::SOLID.bits(),
            b'-' => TileFlags::ONE_WAY.bits(),
            b'o' => TileFlags::COLLECTIBLE.bits(),
            b'^' => TileFlags::DAMAGE.bits(),
            _ => TileFlags::NONE.bits(),
        };
        place += 1;
    }
    tiles
}
