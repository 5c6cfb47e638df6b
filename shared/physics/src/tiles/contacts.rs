//! Where a shape touches a map: one contact for each direction, however many tiles the shape lies on.
//!
//! A solid tile acts through the faces that it has. Of two overlaps with a box the lesser decides, as between bodies; a
//! circle touches the closest point of the tile, and a corner only where both faces at that corner exist and no tile lies
//! before it. Rows of tiles thus act as one surface, at every sub-pixel phase.

use heapless::Vec;

use super::flags::TileFlags;
use super::map::{BLOCKING, Tile, TileMap, is_one_way, is_solid};
use super::touch::{Candidate, Probe, offset};
use crate::geometry::{Bounds, Outline};
use crate::scalar::{Quantity, Scalar};
use crate::vec2::Vec2;

/// A shape touches a tile, or comes close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TileContact<S: Scalar> {
    /// Unit normal from the shape into the tile.
    pub normal: Vec2<S::Unit>,
    /// Overlap along the normal, px; below 0 it is the gap between them.
    pub penetration: S::Real,
    /// The tile; of several that are equally deep, the one nearest to the shape's centre.
    pub tile: Tile,
}

/// Most contacts with solid tiles: four faces, four corners.
const DIRECTIONS: usize = 8;

impl TileMap<'_> {
    /// Visits where a shape touches what blocks in the map, or comes closer than `margin` px (at least 0): at most one contact
    /// for each face direction and corner direction of solid tiles, and those with one-way tiles.
    ///
    /// A one-way tile is reported whenever its top is below the shape's centre: the caller decides whether the shape lands. A
    /// box that overlaps an outer corner by at most 1/16 px in both directions passes it: it neither lands on that sliver nor
    /// is stopped by it.
    #[inline]
    pub fn contacts<S: Scalar>(&self, outline: &Outline<S>, margin: S::Real, mut visit: impl FnMut(TileContact<S>)) {
        // Without one-way tiles, nobody has to know what is around a circle.
        if !outline.circle || self.has_one_way() || !self.contacts_around(outline, margin, &mut visit) {
            self.visit_contacts(outline, margin, &mut visit);
        }
    }

    #[inline(never)]
    fn visit_contacts<S: Scalar>(&self, outline: &Outline<S>, margin: S::Real, visit: &mut dyn FnMut(TileContact<S>)) {
        let around = self.bits_around::<S>(outline.centre, outline.half.map(|half| half.saturating_add(margin)));
        self.contacts_of(outline, margin, around, visit);
    }

    /// The same, where the bits of the tiles around are known.
    #[inline]
    pub(crate) fn contacts_of<S: Scalar>(
        &self,
        outline: &Outline<S>,
        margin: S::Real,
        around: u8,
        visit: &mut dyn FnMut(TileContact<S>),
    ) {
        if around & BLOCKING == 0 {
            return;
        }
        let round = outline.circle && around & TileFlags::ONE_WAY.bits() == 0;
        if !round || !self.contacts_around(outline, margin, visit) {
            self.contacts_among(outline, margin, visit);
        }
    }

    #[inline(never)]
    fn contacts_among<S: Scalar>(&self, outline: &Outline<S>, margin: S::Real, visit: &mut dyn FnMut(TileContact<S>)) {
        let near = Bounds::of(outline).grown(margin);
        let (columns, rows) = self.axes();
        let (columns, rows) = (columns.span::<S>(near.min.x, near.max.x), rows.span::<S>(near.min.y, near.max.y));
        let probe = Probe::near(outline, margin);
        let mut merged = Merged::<S>(Vec::new());
        for row in rows {
            for (column, &bits) in (columns.start..).zip(self.row(row, &columns)) {
                if is_solid(bits) {
                    if let Some(candidate) = self.on_solid(&probe, Tile::new(column, row, bits)) {
                        merged.add(candidate);
                    }
                } else if is_one_way(bits)
                    && let Some(contact) = self.on_one_way(&probe, Tile::new(column, row, bits))
                {
                    visit(contact);
                }
            }
        }
        let overlaps = |candidate: &Candidate<S>| candidate.contact.penetration > S::Real::ZERO;
        if !outline.circle
            && !merged.0.iter().any(overlaps)
            && let Some(tile) = self.at::<S>(outline.centre).filter(|tile| tile.flags.is_solid())
        {
            merged.add(self.way_out(&probe, tile));
        }
        for candidate in &merged.0 {
            visit(candidate.contact);
        }
    }

    /// Visits the sensor tiles that a shape overlaps or touches (a box not by a mere corner), row by row.
    pub fn overlaps<S: Scalar>(&self, outline: &Outline<S>, mut visit: impl FnMut(Tile)) {
        if self.sensors() == 0 {
            return;
        }
        let bounds = Bounds::of(outline);
        for tile in self.tiles_in(&bounds).filter(|tile| tile.flags.is_sensor()) {
            let edges = self.bounds::<S>(tile);
            let touches = if outline.circle {
                S::within(offset(&edges, outline.centre), outline.half.x)
            } else {
                // They touch, or the tile wouldn't be among these: but not only a corner.
                (bounds.min.x < edges.max.x && bounds.max.x > edges.min.x)
                    || (bounds.min.y < edges.max.y && bounds.max.y > edges.min.y)
            };
            if touches {
                visit(tile);
            }
        }
    }
}

/// The deepest contact of each direction.
struct Merged<S: Scalar>(Vec<Candidate<S>, DIRECTIONS>);

impl<S: Scalar> Merged<S> {
    #[inline(never)]
    fn add(&mut self, new: Candidate<S>) {
        if let Some(old) = self.0.iter_mut().find(|old| old.direction == new.direction) {
            let (was, is) = (old.contact.penetration, new.contact.penetration);
            if is > was || (is == was && new.aside < old.aside) {
                *old = new;
            }
        } else {
            let pushed = self.0.push(new);
            debug_assert!(pushed.is_ok(), "there is room for each direction");
        }
    }
}
