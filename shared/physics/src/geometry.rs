//! Shapes as plain values: which overlap, and when a moving one meets a resting one.
//!
//! Nothing here knows a world. Two moving shapes are a moving and a resting one: pass the difference of their motions.
//!
//! Shapes don't rotate, so two of them overlap exactly if the centre of the first lies in the sum of both around the centre of
//! the second (H. Minkowski): a rectangle for boxes, a disc for circles, a rectangle with round corners for one of each. All
//! tests are tests of a point against that sum.
//!
//! Overlap means more than touching. Decisions are exact in fixed point; floats decide to within
//! [`Exact::SLACK`].

pub mod bounds;
pub mod cast;
pub mod overlap;
pub mod ray;

pub use bounds::Bounds;
pub(crate) use cast::cast_box;
pub use cast::{Hit, cast};
pub use overlap::{Penetration, overlaps, penetration, touches};
pub use ray::ray;

use crate::body::Body;
use crate::scalar::{Exact, Quantity, Scalar};
use crate::shape::Shape;
use crate::vec2::{Vec2, vec2};

/// A shape at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline<S: Scalar> {
    /// Centre, px, each coordinate within +-[`POSITION_LIMIT`](crate::scalar::POSITION_LIMIT).
    pub centre: Vec2<S::Real>,
    /// Half width and half height, px, 0 to [`EXTENT_LIMIT`](crate::scalar::EXTENT_LIMIT); both the radius for a circle.
    pub half: Vec2<S::Real>,
    /// Whether it is a circle; a box otherwise.
    pub circle: bool,
}

impl<S: Scalar> Outline<S> {
    /// A shape around a centre.
    pub fn new(shape: &Shape<S>, centre: Vec2<S::Real>) -> Self {
        Self { centre, half: shape.half_extents(), circle: matches!(shape, Shape::Circle { .. }) }
    }

    /// A single point.
    pub fn point(at: Vec2<S::Real>) -> Self {
        Self { centre: at, half: vec2(S::Real::ZERO, S::Real::ZERO), circle: false }
    }

    /// The same shape elsewhere.
    #[must_use]
    pub fn at(self, centre: Vec2<S::Real>) -> Self {
        Self { centre, ..self }
    }

    #[inline(never)]
    pub(crate) fn of(body: &Body<S>) -> Self {
        Self { centre: body.position, half: body.half, circle: body.status.is_circle() }
    }
}

/// What is left of a motion's start and end: the part of it that is done at `time`, 0..=1.
#[must_use]
#[inline(never)]
pub fn part<S: Scalar>(motion: Vec2<S::Real>, time: S::Unit) -> Vec2<S::Real> {
    if time == S::UNIT { motion } else { motion.map(|component| S::length_times(component, time)) }
}

/// The sum of two shapes as seen from the first one's centre: a rectangle with rounded corners.
#[derive(Clone, Copy)]
struct Sum<S: Scalar> {
    /// From the first one's centre to the second's.
    offset: Vec2<S::Real>,
    /// Half extents between the centres of the round corners.
    rect: Vec2<S::Real>,
    /// Radius of the corners; 0 if both are boxes.
    round: S::Real,
    /// Half extents in all.
    reach: Vec2<S::Real>,
}

impl<S: Scalar> Sum<S> {
    fn of(first: &Outline<S>, second: &Outline<S>) -> Self {
        let zero = S::Real::ZERO;
        let (mut rect, mut round) = (vec2(zero, zero), zero);
        for outline in [first, second] {
            if outline.circle {
                round = round + outline.half.x;
            } else {
                rect = rect + outline.half;
            }
        }
        // Only the two far ends of the world are too far apart for the format; held there, they are nearer by its last place.
        let offset = second.centre.saturating_sub(first.centre);
        Self { offset, rect, round, reach: first.half + second.half }
    }

    /// The sum of two boxes.
    fn of_boxes(first: &Outline<S>, second: &Outline<S>) -> Self {
        let (offset, reach) = (second.centre.saturating_sub(first.centre), first.half + second.half);
        Self { offset, rect: reach, round: S::Real::ZERO, reach }
    }

    /// From a point to the centre of the round corner in whose quarter it lies; none if it lies beside, above or inside the
    /// rectangle. `offset` leads from the point to the sum's centre.
    fn corner_from(&self, offset: Vec2<S::Real>) -> Option<Vec2<S::Real>> {
        let beyond = |along: S::Real, half: S::Real| along - along.held(half);
        let (x, y) = (beyond(offset.x, self.rect.x), beyond(offset.y, self.rect.y));
        (x != S::Real::ZERO && y != S::Real::ZERO && self.round > S::Real::ZERO).then_some(vec2(x, y))
    }

    /// The radius within which a point has entered a corner rather than touched it.
    fn core(&self) -> S::Real {
        let slack = S::Real::SLACK;
        if self.round > slack + slack { self.round - slack } else { self.round }
    }
}

/// Distance along one axis between a point and the near edge of a span, below 0 inside. Less than the rounding of floats is 0.
fn gap<S: Scalar>(offset: S::Real, reach: S::Real) -> S::Real {
    let gap = offset.abs().saturating_sub(reach);
    if gap < S::Real::ZERO && gap > -S::Real::SLACK { S::Real::ZERO } else { gap }
}

/// The unit vector along one axis away from what lies at `offset`; upwards or to the left if that is 0.
fn away<S: Scalar>(offset: S::Real) -> S::Unit {
    if offset < S::Real::ZERO { S::UNIT } else { -S::UNIT }
}

/// [`Scalar::direction`] where code counts for more than speed.
#[inline(never)]
pub(crate) fn direction<S: Scalar>(offset: Vec2<S::Real>) -> Option<(Vec2<S::Unit>, S::Real)> {
    S::direction(offset)
}

/// Component of a vector along a direction.
#[inline(never)]
pub(crate) fn along<S: Scalar>(vector: Vec2<S::Real>, direction: Vec2<S::Unit>) -> S::Real {
    S::length_times(vector.x, direction.x).saturating_add(S::length_times(vector.y, direction.y))
}

/// A vector without its component against a normal.
#[inline(never)]
pub(crate) fn without<S: Scalar>(vector: Vec2<S::Real>, normal: Vec2<S::Unit>) -> Vec2<S::Real> {
    let into = along::<S>(vector, normal).lesser(S::Real::ZERO);
    vector.saturating_sub(normal.map(|component| S::length_times(into, component)))
}
