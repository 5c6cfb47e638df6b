//! What is around a shape: mostly nothing; and the common case of a circle that reaches no further than the eight tiles around the
//! place where its centre is.

use super::contacts::TileContact;
use super::map::{Side, Tile, TileMap, is_solid};
use super::touch::rounded;
use crate::geometry::Outline;
use crate::scalar::{Quantity, Scalar};
use crate::vec2::{Vec2, vec2};

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
    /// The bits of all tiles that something around a point overlaps or touches, and perhaps of some beside them.
    #[inline(always)] // asked of every body, mostly for nothing
    pub(crate) fn bits_around<S: Scalar>(&self, centre: Vec2<S::Real>, reach: Vec2<S::Real>) -> u8 {
        self.bits_inside::<S>(centre, reach).unwrap_or_else(|| self.bits_across_edges::<S>(centre, reach))
    }

    /// The same around what reaches over no more than three columns, and over no edge of the map.
    #[inline(always)] // for the same reason
    fn bits_inside<S: Scalar>(&self, centre: Vec2<S::Real>, reach: Vec2<S::Real>) -> Option<u8> {
        let (columns, rows) = self.axes();
        let [left, right] = columns.both(whole_px::<S>(centre.x, reach.x))?;
        let width = right.wrapping_sub(left);
        if width > 2 {
            return None;
        }
        let [top, bottom] = rows.both(whole_px::<S>(centre.y, reach.y))?;
        let third = if width == 2 { u8::MAX } else { 0 };
        let mut place = top * columns.count() + left;
        let mut bits = 0;
        let rows = (bottom + 1).saturating_sub(top);
        for _ in 0..rows {
            let row = self.bytes_from(place).first_chunk::<3>()?;
            bits |= row[0] | row[1] | row[2] & third;
            place += columns.count();
        }
        Some(bits)
    }

    /// The same around whatever is large, or near the edges of the map.
    #[inline(never)]
    fn bits_across_edges<S: Scalar>(&self, centre: Vec2<S::Real>, reach: Vec2<S::Real>) -> u8 {
        let (columns, rows) = self.axes();
        let columns = columns.between(whole_px::<S>(centre.x, reach.x));
        let rows = rows.between(whole_px::<S>(centre.y, reach.y));
        rows.flat_map(|row| self.row(row, &columns)).fold(0, |bits, tile| bits | tile)
    }

    #[inline]
    fn place<S: Scalar>(&self, point: Vec2<S::Real>) -> Option<Place<S>> {
        let (columns, rows) = self.axes();
        let (column, row) = (columns.inner(S::floor(point.x))?, rows.inner(S::floor(point.y))?);
        let before = point - vec2(columns.edge::<S>(column), rows.edge::<S>(row));
        let beyond = vec2(columns.pitch::<S>(), rows.pitch::<S>()) - before;
        Some(Place { column, row, before, beyond })
    }

    /// Visits where a circle touches solid tiles, or comes closer than `margin`: if its centre is in a free place, it reaches none
    /// but the eight tiles around that, and none of those is one-way. Their faces towards the free place exist. False, and nothing
    /// visited, if its centre is in no such place.
    #[inline(never)]
    pub(super) fn contacts_around<S: Scalar>(
        &self,
        circle: &Outline<S>,
        margin: S::Real,
        visit: &mut dyn FnMut(TileContact<S>),
    ) -> bool {
        let radius = circle.half.x;
        let reach = radius.saturating_add(margin);
        let is_free = |place: &Place<S>| place.covers(reach) && self.solid_at(place.column, place.row).is_none();
        let Some(place) = self.place::<S>(circle.centre).filter(is_free) else {
            return false;
        };
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
        true
    }

    /// The tile at coordinates that are in the map, if it is solid.
    #[inline]
    fn solid_at(&self, column: u32, row: u32) -> Option<Tile> {
        let bits = self.byte(row * self.axes().0.count() + column);
        is_solid(bits).then(|| Tile::new(column, row, bits))
    }
}

/// The first and the last of the whole px around a coordinate that something overlaps or touches, and at most one more on each side.
#[inline]
fn whole_px<S: Scalar>(centre: S::Real, reach: S::Real) -> [i32; 2] {
    let (centre, reach) = (S::floor(centre), S::floor(reach).saturating_add(1));
    [centre.saturating_sub(reach), centre.saturating_add(reach)]
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
    fn covers(&self, reach: S::Real) -> bool {
        let inside = |before: S::Real, beyond: S::Real| before > S::Real::ZERO && reach <= before + beyond;
        inside(self.before.x, self.beyond.x) && inside(self.before.y, self.beyond.y)
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
