//! When a moving shape meets a map: exact, however far it moves, at a cost of the tiles that it sweeps over.
//!
//! A hit on a face or corner that doesn't exist is none: the neighbouring tile acts there.

use super::map::{Side, Tile, TileMap};
use super::touch::Probe;
use crate::geometry::{self, Bounds, Hit, Outline, along};
use crate::scalar::{Exact, Quantity, Scalar, ratio};
use crate::vec2::{Vec2, vec2};

/// Where a moving shape meets a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TileHit<S: Scalar> {
    /// When, and with which side.
    pub hit: Hit<S>,
    /// What it meets.
    pub tile: Tile,
}

impl TileMap<'_> {
    /// Sweeps a shape along a motion, |component| <= 32767 px, and names the first tile that blocks it. Only tiles that `counts`
    /// says yes to can be met; faces between them and others don't exist all the same.
    ///
    /// As between shapes, touching is not meeting. Solid tiles that overlap the shape from the start block at time 0 what moves
    /// further into one of their faces; along or out of them the shape may move. One-way tiles block what comes from above:
    /// what moves downwards and began above them, or at most 1/16 px in them.
    pub fn cast<S: Scalar>(
        &self,
        mover: &Outline<S>,
        motion: Vec2<S::Real>,
        counts: impl Fn(Tile) -> bool,
    ) -> Option<TileHit<S>> {
        let zero = S::Real::ZERO;
        let bounds = Bounds::of(mover);
        let (columns, rows) = self.axes();
        // Slabs of tiles across the longer component of the motion, in the order in which the shape gets there.
        let level = motion.x.abs() >= motion.y.abs();
        let turned = |v: Vec2<S::Real>| if level { v } else { vec2(v.y, v.x) };
        let (along, across) = if level { (columns, rows) } else { (rows, columns) };
        let (min, max, way) = (turned(bounds.min), turned(bounds.max), turned(motion));
        let slabs =
            along.span::<S>(min.x.saturating_add(way.x.lesser(zero)), max.x.saturating_add(way.x.greater(zero)));
        let ahead = |to: S::Real, from: S::Real| to.saturating_sub(from);
        let mut first: Option<TileHit<S>> = None;
        for step in 0..slabs.end - slabs.start {
            let (slab, near, far) = if way.x >= zero {
                let slab = slabs.start + step;
                (slab, ahead(along.edge::<S>(slab), max.x), ahead(along.edge::<S>(slab + 1), min.x))
            } else {
                let slab = slabs.end - 1 - step;
                (slab, ahead(min.x, along.edge::<S>(slab + 1)), ahead(max.x, along.edge::<S>(slab)))
            };
            let enters = progress::<S>(near, way.x.abs());
            if first.is_some_and(|first| first.hit.time < enters) {
                break;
            }
            let drift = [enters, progress::<S>(far, way.x.abs())].map(|time| S::length_times(way.y, time));
            // A px more on both sides than where the shape is meanwhile: times are rounded.
            let lanes = across.span::<S>(
                min.y.saturating_add(drift[0].lesser(drift[1])).saturating_sub(S::ONE),
                max.y.saturating_add(drift[0].greater(drift[1])).saturating_add(S::ONE),
            );
            for lane in lanes {
                let (column, row) = if level { (slab, lane) } else { (lane, slab) };
                let hit = self
                    .tile(column, row)
                    .filter(|&tile| counts(tile))
                    .and_then(|tile| Some(TileHit { hit: self.meet(mover, &bounds, motion, tile)?, tile }));
                if let Some(next) = hit
                    && first.is_none_or(|first| next.hit.time < first.hit.time)
                {
                    first = Some(next);
                }
            }
        }
        first
    }

    /// Casts a ray from `origin` to `origin + way`, |component| <= 32767 px: the first tile that it meets, of those that
    /// `counts` says yes to. A ray that begins inside a solid tile meets it at once.
    pub fn ray<S: Scalar>(
        &self,
        origin: Vec2<S::Real>,
        way: Vec2<S::Real>,
        counts: impl Fn(Tile) -> bool,
    ) -> Option<TileHit<S>> {
        let point = Outline::point(origin);
        if let Some(tile) = self.at::<S>(origin).filter(|&tile| tile.flags.is_solid() && counts(tile)) {
            let way_out = self.way_out(&Probe::exact(&point), tile).contact;
            if way_out.penetration > S::Real::ZERO {
                let (normal, depth) = (-way_out.normal, way_out.penetration);
                return Some(TileHit { hit: Hit { time: S::Unit::ZERO, normal, depth }, tile });
            }
        }
        self.cast(&point, way, counts)
    }

    /// When a moving shape meets one tile, through the faces and corners that the tile has.
    fn meet<S: Scalar>(
        &self,
        mover: &Outline<S>,
        bounds: &Bounds<S>,
        motion: Vec2<S::Real>,
        tile: Tile,
    ) -> Option<Hit<S>> {
        let edges = self.bounds::<S>(tile);
        let one_way = tile.flags.is_one_way();
        if one_way {
            let began_above = bounds.max.y <= edges.min.y.saturating_add(S::real(ratio(1, 16)));
            if !began_above || motion.y <= S::Real::ZERO || !self.is_open(tile, Side::Top) {
                return None;
            }
        } else if !tile.flags.is_solid() {
            return None;
        }
        let half = vec2(S::half(edges.max.x - edges.min.x), S::half(edges.max.y - edges.min.y));
        let hit = geometry::cast(mover, motion, &Outline { centre: edges.min + half, half, circle: false })?;
        if hit.depth > S::Real::ZERO {
            return if one_way {
                let depth = (bounds.max.y - edges.min.y).greater(S::Real::ZERO);
                Some(Hit { time: S::Unit::ZERO, normal: -Side::Top.inward::<S>(), depth })
            } else {
                let contact = self.on_solid(&Probe::exact(mover), tile)?.contact;
                let further_in = along::<S>(motion, contact.normal) > S::Real::ZERO;
                further_in.then(|| Hit { time: S::Unit::ZERO, normal: -contact.normal, depth: contact.penetration })
            };
        }
        let acts = |side: Side| if one_way { side == Side::Top } else { self.is_open(tile, side) };
        let level = if hit.normal.x < S::Unit::ZERO { Side::Left } else { Side::Right };
        let upright = if hit.normal.y < S::Unit::ZERO { Side::Top } else { Side::Bottom };
        if hit.normal.y == S::Unit::ZERO {
            return acts(level).then_some(hit);
        }
        if hit.normal.x == S::Unit::ZERO {
            return acts(upright).then_some(hit);
        }
        let steep = hit.normal.y.abs() > hit.normal.x.abs();
        let has_corner = if one_way {
            // The end of a run of tops, unless it is met from the side.
            let tenth = S::real(ratio(1, 10));
            S::length_times(S::ONE, hit.normal.y) < -tenth && !self.continues(tile, level)
        } else {
            self.has_corner(tile, level, upright)
        };
        if has_corner {
            return Some(hit);
        }
        // Right at a seam, rounding can take a face for the end of one.
        let side = if steep { upright } else { level };
        let slant = S::length_times(S::ONE, if steep { hit.normal.x } else { hit.normal.y }).abs();
        let normal = -side.inward::<S>();
        let is_face = slant <= S::real(ratio(1, 256)) && acts(side) && along::<S>(motion, normal) < S::Real::ZERO;
        is_face.then_some(Hit { normal, ..hit })
    }
}

/// The part of a way that is done once a distance is covered, 0..=1, rounded down.
fn progress<S: Scalar>(distance: S::Real, whole: S::Real) -> S::Unit {
    if distance <= S::Real::ZERO {
        S::Unit::ZERO
    } else if distance >= whole {
        S::UNIT
    } else {
        distance.fraction_of(whole)
    }
}
