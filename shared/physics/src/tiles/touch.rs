//! How a shape touches one tile of a map, given its neighbours.

use super::contacts::TileContact;
use super::map::{Side, Tile, TileMap, is_one_way, is_solid};
use crate::geometry::{Bounds, Outline, direction};
use crate::scalar::{Quantity, Scalar, ratio};
use crate::vec2::{Vec2, vec2};

/// The shape in question.
pub(super) struct Probe<'a, S: Scalar> {
    outline: &'a Outline<S>,
    /// Gap up to which tiles count.
    margin: S::Real,
    /// Overlap up to which the corner of a box passes a corner of the map.
    graze: S::Real,
}

impl<'a, S: Scalar> Probe<'a, S> {
    /// Overlaps, and gaps up to `margin`. What corners graze is more than the slop at which bodies rest.
    pub(super) fn near(outline: &'a Outline<S>, margin: S::Real) -> Self {
        Self { outline, margin, graze: S::real(ratio(1, 16)) }
    }

    /// Touching and overlaps count, by whatever little.
    pub(super) fn exact(outline: &'a Outline<S>) -> Self {
        Self { outline, margin: S::Real::ZERO, graze: S::Real::ZERO }
    }
}

/// A contact on its way to be merged with others of the same direction.
pub(super) struct Candidate<S: Scalar> {
    /// Face 0..4, corner 4..8.
    pub(super) direction: u8,
    /// Orders tiles of equal depth: distance from the centre along the face, doubled.
    pub(super) aside: S::Real,
    pub(super) contact: TileContact<S>,
}

impl TileMap<'_> {
    /// How a shape touches one solid tile, through the faces that the tile has.
    #[inline]
    pub(super) fn on_solid<S: Scalar>(&self, probe: &Probe<'_, S>, tile: Tile) -> Option<Candidate<S>> {
        if probe.outline.circle { self.circle_on_solid(probe, tile) } else { self.box_on_solid(probe, tile) }
    }

    /// A box is pushed out along the axis of least overlap, the vertical one if equal; along the other one if the tile has no
    /// such face.
    #[inline(never)]
    fn box_on_solid<S: Scalar>(&self, probe: &Probe<'_, S>, tile: Tile) -> Option<Candidate<S>> {
        let zero = S::Real::ZERO;
        let [left, right, top, bottom] = self.depths(probe.outline, tile);
        let level = if left <= right { (left, Side::Left) } else { (right, Side::Right) };
        let upright = if top <= bottom { (top, Side::Top) } else { (bottom, Side::Bottom) };
        let (least, other) = if upright.0 <= level.0 { (upright, level) } else { (level, upright) };
        if other.0 <= zero || least.0 < -probe.margin {
            return None; // they are diagonal to each other, or too far apart
        }
        let other_is_open = || self.is_open(tile, other.1);
        let (depth, side) = if self.is_open(tile, least.1) {
            if other.0 <= probe.graze && other_is_open() {
                return None;
            }
            least
        } else if least.0 > zero && other_is_open() {
            other
        } else {
            return None; // the neighbour acts in its place
        };
        let aside = match side {
            Side::Left | Side::Right => top - bottom,
            Side::Top | Side::Bottom => left - right,
        };
        Some(face(side, depth, aside.abs(), tile))
    }

    /// A circle is pushed away from the tile's closest point; from inside, out through the nearest face.
    #[inline(never)]
    fn circle_on_solid<S: Scalar>(&self, probe: &Probe<'_, S>, tile: Tile) -> Option<Candidate<S>> {
        let (zero, centre, radius) = (S::Real::ZERO, probe.outline.centre, probe.outline.half.x);
        let edges = self.bounds::<S>(tile);
        let offset = offset(&edges, centre);
        let level = if offset.x > zero { Side::Left } else { Side::Right };
        let upright = if offset.y > zero { Side::Top } else { Side::Bottom };
        let (side, depth) = match (offset.x == zero, offset.y == zero) {
            (false, false) => return self.circle_on_corner(probe, tile, offset, level, upright),
            (true, false) => (upright, radius - offset.y.abs()),
            (false, true) => (level, radius - offset.x.abs()),
            (true, true) => return Some(self.way_out(probe, tile)),
        };
        (depth >= -probe.margin && self.is_open(tile, side)).then(|| face(side, depth, zero, tile))
    }

    /// `offset` leads from the circle's centre to the corner between two sides.
    fn circle_on_corner<S: Scalar>(
        &self,
        probe: &Probe<'_, S>,
        tile: Tile,
        offset: Vec2<S::Real>,
        level: Side,
        upright: Side,
    ) -> Option<Candidate<S>> {
        if !self.has_corner(tile, level, upright) {
            return None;
        }
        let contact = rounded(offset, probe.outline.half.x, probe.margin, tile)?;
        // For what stands on a one-way tile, the corner of the solid tile beside it is a seam.
        if upright == Side::Top && contact.penetration <= probe.graze && self.continues(tile, level) {
            return None;
        }
        let direction = 4 + u8::from(level == Side::Right) + 2 * u8::from(upright == Side::Bottom);
        Some(Candidate { direction, aside: S::Real::ZERO, contact })
    }

    /// What is above a one-way tile touches its top; a circle beside it the end of the top.
    #[inline(never)]
    pub(super) fn on_one_way<S: Scalar>(&self, probe: &Probe<'_, S>, tile: Tile) -> Option<TileContact<S>> {
        let zero = S::Real::ZERO;
        let edges = self.bounds::<S>(tile);
        if probe.outline.centre.y >= edges.min.y || !self.is_open(tile, Side::Top) {
            return None;
        }
        let centre = probe.outline.centre;
        let aside = if centre.x < edges.min.x {
            Some(Side::Left)
        } else if centre.x >= edges.max.x {
            Some(Side::Right)
        } else {
            None
        };
        if let Some(nearer) = aside {
            if self.continues(tile, nearer) {
                return None; // that tile acts in place of this one
            }
            let offset = offset(&edges, centre);
            if probe.outline.circle && offset.x != zero {
                let radius = probe.outline.half.x;
                let (column, row) = nearer.beside(tile.column.into(), tile.row.into());
                let ends = !self.is_solid(column, row.wrapping_sub(1));
                return if ends { rounded(offset, radius, probe.margin, tile) } else { None };
            }
            let [left, right, ..] = self.depths(probe.outline, tile);
            if left <= S::Real::ZERO || right <= S::Real::ZERO {
                return None;
            }
        }
        let penetration = centre.y - edges.min.y + probe.outline.half.y;
        (penetration >= -probe.margin).then(|| TileContact { normal: Side::Top.inward::<S>(), penetration, tile })
    }

    /// How far a shape's bounding box reaches past each [`Side`] of a tile, px; below 0 it doesn't.
    #[inline]
    fn depths<S: Scalar>(&self, outline: &Outline<S>, tile: Tile) -> [S::Real; 4] {
        let (edges, centre, half) = (self.bounds::<S>(tile), outline.centre, outline.half);
        [
            centre.x - edges.min.x + half.x,
            edges.max.x - centre.x + half.x,
            centre.y - edges.min.y + half.y,
            edges.max.y - centre.y + half.y,
        ]
    }

    /// Whether a solid tile has the corner between two sides: both exist, and no solid tile lies before the corner.
    #[inline]
    pub(super) fn has_corner(&self, tile: Tile, level: Side, upright: Side) -> bool {
        let (column, row) = level.beside(tile.column.into(), tile.row.into());
        let (column, row) = upright.beside(column, row);
        self.is_open(tile, level) && self.is_open(tile, upright) && !self.is_solid(column, row)
    }

    /// Whether the top of a one-way tile goes on beyond one of its sides.
    #[inline]
    pub(super) fn continues(&self, tile: Tile, side: Side) -> bool {
        let (column, row) = side.beside(tile.column.into(), tile.row.into());
        let bits = self.bits(column, row);
        is_solid(bits) || is_one_way(bits)
    }

    /// The shortest way out along an axis for a shape whose centre is in a solid tile: through a face of that tile or of the
    /// last of those beside it. Downwards, to the left or to the right only if that is shorter than upwards.
    #[cold]
    pub(super) fn way_out<S: Scalar>(&self, probe: &Probe<'_, S>, inside: Tile) -> Candidate<S> {
        let mut best = self.way_through(probe, inside, Side::Top);
        for side in [Side::Bottom, Side::Left, Side::Right] {
            let next = self.way_through(probe, inside, side);
            if next.contact.penetration < best.contact.penetration {
                best = next;
            }
        }
        best
    }

    #[cold]
    #[inline(never)]
    fn way_through<S: Scalar>(&self, probe: &Probe<'_, S>, inside: Tile, side: Side) -> Candidate<S> {
        let mut tile = inside;
        while let Some(next) = side.solid_beside(self, tile) {
            tile = next;
        }
        let penetration = self.depths(probe.outline, tile)[side as usize];
        face(side, penetration, S::Real::ZERO, tile)
    }
}

#[inline]
fn face<S: Scalar>(side: Side, penetration: S::Real, aside: S::Real, tile: Tile) -> Candidate<S> {
    let contact = TileContact { normal: side.inward::<S>(), penetration, tile };
    Candidate { direction: side as u8, aside, contact }
}

/// A circle near a point of a tile, to which `offset` leads from its centre; none if it is further away than `margin`.
#[inline(never)]
pub(super) fn rounded<S: Scalar>(
    offset: Vec2<S::Real>,
    radius: S::Real,
    margin: S::Real,
    tile: Tile,
) -> Option<TileContact<S>> {
    if !S::within(offset, radius + margin) {
        return None;
    }
    let (normal, distance) = direction::<S>(offset)?;
    Some(TileContact { normal, penetration: radius - distance, tile })
}

/// From a point to the closest one of a box.
#[inline]
pub(super) fn offset<S: Scalar>(edges: &Bounds<S>, point: Vec2<S::Real>) -> Vec2<S::Real> {
    let component = |low: S::Real, high: S::Real, at: S::Real| {
        if at < low {
            low - at
        } else if at > high {
            high - at
        } else {
            S::Real::ZERO
        }
    };
    vec2(component(edges.min.x, edges.max.x, point.x), component(edges.min.y, edges.max.y, point.y))
}
