//! Whether and how two bodies touch: circle and circle, circle and box, box and box.
//!
//! Bodies that exactly touch are in contact, with penetration 0; boxes that share only a corner are not.

use crate::body::{Body, Profile};
use crate::contact::{Contact, Pool};
use crate::scalar::{Quantity, Scalar};
use crate::vec2::{Vec2, vec2};

/// Unit normal from the first body to the second, and overlap along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Manifold<S: Scalar> {
    pub(crate) normal: Vec2<S::Unit>,
    pub(crate) penetration: S::Real,
}

/// Adds a contact to the pool if the bodies touch and their layers meet.
#[inline]
pub(crate) fn touch<S: Scalar>(a: u16, b: u16, bodies: &[Body<S>], profiles: &[Profile<S>], pool: &mut Pool<'_, S>) {
    let (first, second) = (&bodies[usize::from(a)], &bodies[usize::from(b)]);
    let (own, other) = (&profiles[usize::from(a)], &profiles[usize::from(b)]);
    if !own.meets(other) {
        return;
    }
    let Some(Manifold { normal, penetration }) = collide(first, second) else {
        return;
    };
    let approach = -S::speed_along(second.velocity.saturating_sub(first.velocity), normal);
    let share = if second.status.is_static() { S::UNIT } else { S::mass_share(own.mass, other.mass) };
    pool.push(Contact {
        a,
        b,
        normal,
        penetration,
        approach: approach.greater(S::Speed::ZERO),
        share,
        restitution: own.restitution.lesser(other.restitution),
        friction: own.friction.lesser(other.friction),
        impulse: vec2(S::Speed::ZERO, S::Speed::ZERO),
    });
}

/// How two bodies overlap; none if they don't touch.
#[inline]
pub(crate) fn collide<S: Scalar>(a: &Body<S>, b: &Body<S>) -> Option<Manifold<S>> {
    let offset = b.position - a.position;
    match (a.status.is_circle(), b.status.is_circle()) {
        (true, true) => circles::<S>(offset, a.half.x + b.half.x),
        (false, false) => boxes::<S>(offset, a.half + b.half),
        (true, false) => circle_box::<S>(offset, a.half.x, b.half),
        (false, true) => circle_box::<S>(-offset, b.half.x, a.half).map(|m| Manifold { normal: -m.normal, ..m }),
    }
}

/// Circles: along the line of centres. Equal centres part vertically, the first upwards.
fn circles<S: Scalar>(offset: Vec2<S::Real>, reach: S::Real) -> Option<Manifold<S>> {
    if !S::within(offset, reach) {
        return None;
    }
    Some(match S::direction(offset) {
        Some((normal, distance)) => Manifold { normal, penetration: (reach - distance).greater(S::Real::ZERO) },
        None => Manifold { normal: vec2(S::Unit::ZERO, S::UNIT), penetration: reach },
    })
}

/// Boxes: along the axis of least overlap, the vertical one if equal.
fn boxes<S: Scalar>(offset: Vec2<S::Real>, reach: Vec2<S::Real>) -> Option<Manifold<S>> {
    let overlap = vec2(reach.x - offset.x.abs(), reach.y - offset.y.abs());
    let zero = S::Real::ZERO;
    if overlap.x < zero || overlap.y < zero || (overlap.x == zero && overlap.y == zero) {
        return None;
    }
    Some(along_axis::<S>(offset, overlap))
}

/// The push along one axis that parts two boxes with the least motion.
fn along_axis<S: Scalar>(offset: Vec2<S::Real>, overlap: Vec2<S::Real>) -> Manifold<S> {
    if overlap.y <= overlap.x {
        Manifold { normal: vec2(S::Unit::ZERO, signed::<S>(offset.y)), penetration: overlap.y }
    } else {
        Manifold { normal: vec2(signed::<S>(offset.x), S::Unit::ZERO), penetration: overlap.x }
    }
}

fn signed<S: Scalar>(offset: S::Real) -> S::Unit {
    if offset < S::Real::ZERO { -S::UNIT } else { S::UNIT }
}

/// Circle and box: towards the box's point that is closest to the centre; from inside, out through the nearest face.
fn circle_box<S: Scalar>(offset: Vec2<S::Real>, radius: S::Real, half: Vec2<S::Real>) -> Option<Manifold<S>> {
    let closest = vec2(offset.x - offset.x.held(half.x), offset.y - offset.y.held(half.y));
    if !S::within(closest, radius) {
        return None;
    }
    Some(match S::direction(closest) {
        Some((normal, distance)) => Manifold { normal, penetration: (radius - distance).greater(S::Real::ZERO) },
        None => along_axis::<S>(offset, vec2(half.x - offset.x.abs() + radius, half.y - offset.y.abs() + radius)),
    })
}
