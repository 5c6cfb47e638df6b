//! Which shapes overlap or touch, how deep, and the shortest way apart.

use super::{Outline, Sum, away, direction, gap};
use crate::scalar::{Exact, Quantity, Scalar};
use crate::vec2::{Vec2, vec2};

/// How two shapes overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration<S: Scalar> {
    /// Unit vector along which the first one leaves the second by the shortest way.
    pub normal: Vec2<S::Unit>,
    /// Length of that way, px, above 0.
    pub depth: S::Real,
}

/// Whether two shapes overlap, touching apart.
pub fn overlaps<S: Scalar>(first: &Outline<S>, second: &Outline<S>) -> bool {
    Sum::of(first, second).is_entered()
}

/// Whether two shapes overlap or touch, exactly; a shared corner touches.
pub fn touches<S: Scalar>(first: &Outline<S>, second: &Outline<S>) -> bool {
    let sum = Sum::of(first, second);
    let (x, y) = (sum.offset.x.abs(), sum.offset.y.abs());
    x <= sum.reach.x
        && y <= sum.reach.y
        && sum.corner_from(sum.offset).is_none_or(|corner| S::within(corner, sum.round))
}

/// How deep two shapes overlap; none if they don't. Equal centres part vertically, the first one upwards.
pub fn penetration<S: Scalar>(first: &Outline<S>, second: &Outline<S>) -> Option<Penetration<S>> {
    let sum = Sum::of(first, second);
    sum.is_entered().then(|| sum.way_out())
}

impl<S: Scalar> Sum<S> {
    /// Whether the first one's centre lies inside.
    #[inline(never)]
    pub(super) fn is_entered(&self) -> bool {
        self.is_reached() && self.corner_from(self.offset).is_none_or(|corner| S::Real::shorter(corner, self.core()))
    }

    /// Whether the first one's centre lies inside of the rectangle around the sum.
    pub(super) fn is_reached(&self) -> bool {
        let inside = |offset, reach| gap::<S>(offset, reach) < S::Real::ZERO;
        inside(self.offset.x, self.reach.x) && inside(self.offset.y, self.reach.y)
    }

    /// The shortest way out for the first one's centre, which lies inside.
    pub(super) fn way_out(&self) -> Penetration<S> {
        if let Some((direction, distance)) = self.corner_from(self.offset).and_then(direction::<S>) {
            return Penetration { normal: -direction, depth: (self.round - distance).greater(S::Real::NUDGE) };
        }
        self.way_through_a_face()
    }

    /// The shortest way out through a face of the rectangle around the sum.
    pub(super) fn way_through_a_face(&self) -> Penetration<S> {
        let (x, y) = (self.reach.x - self.offset.x.abs(), self.reach.y - self.offset.y.abs());
        if y <= x {
            Penetration { normal: vec2(S::Unit::ZERO, away::<S>(self.offset.y)), depth: y }
        } else {
            Penetration { normal: vec2(away::<S>(self.offset.x), S::Unit::ZERO), depth: x }
        }
    }
}
