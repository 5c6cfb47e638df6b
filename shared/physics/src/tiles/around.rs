//! The common case of a shape near tiles: it reaches no further than the eight tiles around the place where its centre is.

use super::contacts::TileContact;
use super::flags::TileFlags;
use super::map::{BLOCKING, Side, Tile, TileMap, is_solid};
use super::touch::rounded;
use crate::geometry::Outline;
use crate::scalar::{Quantity, Scalar};
use crate::vec2::{Vec2, vec2};

/// What is near a shape.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Around {
    /// Nothing that blocks: so it is with most shapes.
    Nothing,
    /// The shape is a circle with its centre in a free place, and of the eight tiles around that place some are solid.
    Solid,
    /// Something else.
    Other,
}

/// A place inside a map, with tiles on all sides, as seen from a point in it.
struct Place<S: Scalar> {
    column: u32,
    row: u32,
    /// Distance to the left and upper edges, px.
    before: Vec2<S::Real>,
    /// Distance to the right and lower edges, px.
    beyond: Vec2<S::Real>,
}

const SIDES: [Side; 4] = [Side::Left, Side::Right, Side::Top, Side::Bottom];

impl TileMap<'_> {
    /// Looks at the tiles around a shape.
    #[inline(never)]
    pub(super) fn around<S: Scalar>(&self, outline: &Outline<S>, margin: S::Real) -> Around {
        let reach = outline.half.map(|half| half.saturating_add(margin));
        let Some(place) = self.place::<S>(outline.centre).filter(|place| place.covers(reach)) else {
            return Around::Other;
        };
        let mask = |near: bool| if near { BLOCKING } else { 0 };
        let (left, right) = (mask(place.before.x <= reach.x), mask(place.beyond.x <= reach.x));
        let row = |row: u32| {
            let around = self.row(row, &(place.column - 1..place.column + 2));
            around.first_chunk().map_or(0, |[l, own, r]| l & left | own & BLOCKING | r & right)
        };
        let own = row(place.row);
        let over = if place.before.y <= reach.y { row(place.row - 1) } else { 0 };
        let under = if place.beyond.y <= reach.y { row(place.row + 1) } else { 0 };
        let all = own | over | under;
        if all == 0 {
            Around::Nothing
        } else if outline.circle && all & TileFlags::ONE_WAY.bits() == 0 && !self.is_solid(place.column, place.row) {
            Around::Solid
        } else {
            Around::Other
        }
    }

    #[inline]
    fn place<S: Scalar>(&self, point: Vec2<S::Real>) -> Option<Place<S>> {
        let (columns, rows) = self.axes();
        let (column, row) = (columns.inner(S::floor(point.x))?, rows.inner(S::floor(point.y))?);
        let before = point - vec2(columns.edge::<S>(column), rows.edge::<S>(row));
        let beyond = vec2(columns.pitch::<S>(), rows.pitch::<S>()) - before;
        Some(Place { column, row, before, beyond })
    }

    /// Visits where a circle with [`Around::Solid`] touches tiles, or comes closer than `margin`. Their faces towards the free
    /// place exist.
    #[inline(never)]
    pub(super) fn contacts_around<S: Scalar>(
        &self,
        circle: &Outline<S>,
        margin: S::Real,
        visit: &mut dyn FnMut(TileContact<S>),
    ) {
        let Some(place) = self.place::<S>(circle.centre) else {
            return;
        };
        let radius = circle.half.x;
        let reach = radius.saturating_add(margin);
        // Sides without a face, within reach.
        let mut open = [false; 4];
        for side in SIDES {
            let (gap, (column, row)) = (place.gap(side), side.beside(place.column, place.row));
            if gap > reach {
                continue;
            }
            if let Some(tile) = self.solid_at(column, row) {
                visit(TileContact { normal: side.opposite().inward::<S>(), penetration: radius - gap, tile });
            } else {
                open[side as usize] = true;
            }
        }
        // Where a side has a face, the tile there acts in place of the corners beside it.
        for upright in [Side::Top, Side::Bottom] {
            for level in [Side::Left, Side::Right] {
                if open[upright as usize] && open[level as usize] {
                    let (column, _) = level.beside(place.column, place.row);
                    let (_, row) = upright.beside(place.column, place.row);
                    if let Some(tile) = self.solid_at(column, row) {
                        let offset = vec2(place.edge(level), place.edge(upright));
                        visit_corner(offset, radius, margin, tile, visit);
                    }
                }
            }
        }
    }

    /// The tile at coordinates that are in the map, if it is solid.
    #[inline]
    fn solid_at(&self, column: u32, row: u32) -> Option<Tile> {
        let bits = self.byte(row * self.axes().0.count() + column);
        is_solid(bits).then(|| Tile::new(column, row, bits))
    }
}

#[inline(never)]
fn visit_corner<S: Scalar>(
    offset: Vec2<S::Real>,
    radius: S::Real,
    margin: S::Real,
    tile: Tile,
    visit: &mut dyn FnMut(TileContact<S>),
) {
    if let Some(contact) = rounded(offset, radius, margin, tile) {
        visit(contact);
    }
}

impl<S: Scalar> Place<S> {
    /// Whether what reaches so far from the point, which is in no other place, ends in the places around this one.
    #[inline]
    fn covers(&self, reach: Vec2<S::Real>) -> bool {
        let inside =
            |before: S::Real, beyond: S::Real, reach: S::Real| before > S::Real::ZERO && reach <= before + beyond;
        inside(self.before.x, self.beyond.x, reach.x) && inside(self.before.y, self.beyond.y, reach.y)
    }

    /// Distance to an edge, px.
    fn gap(&self, side: Side) -> S::Real {
        match side {
            Side::Left => self.before.x,
            Side::Right => self.beyond.x,
            Side::Top => self.before.y,
            Side::Bottom => self.beyond.y,
        }
    }

    /// Coordinate of an edge as seen from the point, px.
    fn edge(&self, side: Side) -> S::Real {
        if matches!(side, Side::Left | Side::Top) { -self.gap(side) } else { self.gap(side) }
    }
}
