//! Whether and how two bodies touch: circle and circle, circle and box, box and box.
//!
//! Bodies that exactly touch are in contact, with a gap of 0; boxes that share only a corner are not. A contact is live before
//! its bodies touch, from as far away as they may come in this step, so that the solver can stop them at the surface.

use ::fixed::types::I16F16;

use crate::body::{Body, Marks};
use crate::contact::{Axis, Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::geometry::direction;
use crate::pipeline::order::Ground;
use crate::pipeline::{ccd, one_way, terrain};
use crate::scalar::{Quantity, Scalar, ratio};
use crate::variety::Variety;
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Overlap along the surface that two boxes need to block each other: less is the seam between two floors, not a wall.
pub(crate) const GRAZE: I16F16 = ratio(1, 16);

/// How far apart slow bodies may be and still be in contact, px.
const MARGIN: I16F16 = ratio(1, 4);

/// How two bodies lie: unit normal from the first to the second, and the distance along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Manifold<S: Scalar> {
    pub(crate) normal: Vec2<S::Unit>,
    pub(crate) axis: Option<Axis>,
    /// Negative = overlap.
    pub(crate) gap: S::Real,
}

impl<S: Scalar> Manifold<S> {
    pub(crate) fn along(axis: Axis, gap: S::Real) -> Self {
        Self { normal: axis.normal::<S>(), axis: Some(axis), gap }
    }
}

/// Looks again at every contact of a body that has moved.
pub(crate) fn refresh<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let ground = world.layers.ground();
    let World { pool, bodies, terrain, deep, fastest, .. } = world;
    // Two come together by twice that along either axis, and along a diagonal by less than a half more.
    let farthest = S::real(MARGIN) + S::in_a_step(fastest.saturating_add(*fastest).saturating_add(*fastest));
    let round = switches.variety().contain(Variety::CIRCLES);
    let (mut with_terrain, mut at_corner, mut deepest) = (false, false, S::Speed::ZERO);
    for contact in pool.all_mut() {
        let (a, b) = (&bodies[usize::from(contact.a)], &bodies[usize::from(contact.b)]);
        if !(a.marks.or(b.marks).has(Marks::MOVED) || contact.flags.has(Flags::NEW)) {
            continue;
        }
        if switches.on(Effects::TILES) && contact.b == *terrain {
            with_terrain = true;
            continue;
        }
        let may_pass = switches.on(Effects::ONE_WAY) && b.status.is_one_way();
        let known = if round && !may_pass { circles(contact, a, b, farthest, ground) } else { None };
        let gap = known.unwrap_or_else(|| {
            at_corner |= look(contact, a, b, may_pass, ground, round);
            contact.gap
        });
        deepest = deepest.lesser(gap);
        // No pass after this one looks at what is far: so sensors notice and never block, and cost no pass anything.
        if switches.on(Effects::SENSORS) && contact.flags.has(Flags::SENSOR) {
            contact.flags.set(Flags::FAR);
        }
    }
    *deep |= deepest < ccd::deep::<S>();
    if round && at_corner {
        close_seams(world);
    }
    if with_terrain {
        refresh_terrain(world, switches);
    }
}

/// Looks again at a contact of two circles, the commonest kind, of which no two come closer in this step than by `farthest`: its
/// gap. None, and nothing done, if that is not what they are or they have one centre.
#[inline(always)] // as a call, detection costs a tenth more
fn circles<S: Scalar>(
    contact: &mut Contact<S>,
    a: &Body<S>,
    b: &Body<S>,
    farthest: S::Real,
    ground: Ground,
) -> Option<S::Speed> {
    if !a.status.and(b.status).is_circle() {
        return None;
    }
    let (offset, touch) = (b.position - a.position, a.half.x + b.half.x);
    let outer = touch + farthest;
    if !offset.x.is_within(outer) || !offset.y.is_within(outer) || !S::within(offset, outer) {
        leave(contact);
        return Some(S::FASTEST);
    }
    let (normal, distance) = S::direction(offset)?;
    let mut gap = distance - touch;
    if gap > S::real(GRAZE) {
        let Some(leeway) = between(a, b, normal, gap) else {
            leave(contact);
            return Some(S::FASTEST);
        };
        gap = leeway;
    }
    if along::<S>(normal).is_some() {
        write(contact, &Manifold { normal, axis: along::<S>(normal), gap }, ground);
    } else {
        contact.normal = normal;
        contact.gap = S::per_step(gap);
        contact.flags.forget_geometry();
        contact.flags.set(bearing::<S>(normal, ground));
    }
    Some(contact.gap)
}

/// How far two circles may come along the normal in this step; none if they can't touch.
#[cold]
#[inline(never)]
fn between<S: Scalar>(a: &Body<S>, b: &Body<S>, normal: Vec2<S::Unit>, gap: S::Real) -> Option<S::Real> {
    nearing::<S>(b.position - a.position, a.half.x + b.half.x, normal, gap, &Approach::of(a, b))
}

/// Looks again at any contact; whether it is one with the corner of a static box.
#[inline(never)]
fn look<S: Scalar>(
    contact: &mut Contact<S>,
    a: &Body<S>,
    b: &Body<S>,
    may_pass: bool,
    ground: Ground,
    round: bool,
) -> bool {
    let mut manifold = near(a, b, round, || scattered::<S>(contact.b) - scattered::<S>(contact.a));
    if may_pass {
        manifold = one_way::hold(&mut contact.flags, manifold, a, b, ground);
    }
    let Some(manifold) = manifold else {
        leave(contact);
        return false;
    };
    write(contact, &manifold, ground);
    manifold.axis.is_none() && b.status.is_static() && !b.status.is_circle()
}

/// A circle that lies on the face of a static box rolls over corners of others that are flush with it.
#[cold]
#[inline(never)]
fn close_seams<S: Scalar>(world: &mut World<'_, S>) {
    let World { pool, bodies, .. } = world;
    let graze = S::real(GRAZE);
    let is_static_box = |contact: &Contact<S>| {
        let status = bodies[usize::from(contact.b)].status;
        status.is_static() && !status.is_circle() && !contact.flags.has(Flags::FAR)
    };
    for group in pool.all_mut().chunk_by_mut(|one, next| one.a == next.a) {
        for place in 0..group.len() {
            let corner = &group[place];
            if corner.flags.has(Flags::AXIS) || !is_static_box(corner) || corner.gap <= -S::per_step(graze) {
                continue;
            }
            let box_there = &bodies[usize::from(corner.b)];
            let is_flush = |face: &Contact<S>| {
                let box_here = &bodies[usize::from(face.b)];
                let (slope, step) = match face.flags.axis() {
                    Axis::Down => (corner.normal.y, box_there.top() - box_here.top()),
                    Axis::Up => (-corner.normal.y, box_here.bottom() - box_there.bottom()),
                    Axis::Right => (corner.normal.x, box_there.left() - box_here.left()),
                    Axis::Left => (-corner.normal.x, box_here.right() - box_there.right()),
                };
                face.gap <= S::per_step(graze) && slope > S::Unit::ZERO && step >= -graze
            };
            if group.iter().any(|face| face.flags.has(Flags::AXIS) && is_static_box(face) && is_flush(face)) {
                leave(&mut group[place]);
            }
        }
    }
}

/// Looks again at the contacts with the tile map, body by body.
fn refresh_terrain<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let ground = world.layers.ground();
    let World { pool, bodies, terrain, tiles, deep, .. } = world;
    let mut complete = true;
    for group in pool.all_mut().chunk_by_mut(|one, next| one.a == next.a && one.b == next.b) {
        let body = &bodies[usize::from(group[0].a)];
        let stale = body.marks.has(Marks::MOVED) || group.iter().any(|contact| contact.flags.has(Flags::NEW));
        if group[0].b == *terrain && stale {
            complete &= terrain::look(tiles, body, group, ground, switches);
            *deep |= group.iter().any(|contact| contact.gap < ccd::deep::<S>());
        }
    }
    if !complete {
        world.layers.changed(false); // more room, in the next step
    }
}

/// Takes over how the bodies lie.
#[inline(never)]
pub(crate) fn write<S: Scalar>(contact: &mut Contact<S>, manifold: &Manifold<S>, ground: Ground) {
    contact.normal = manifold.normal;
    contact.gap = S::per_step(manifold.gap);
    contact.flags.forget_geometry();
    contact
        .flags
        .set(manifold.axis.map_or_else(Flags::default, Flags::along).or(bearing::<S>(manifold.normal, ground)));
}

/// Notes that the bodies can't touch in this step.
#[inline]
pub(crate) fn leave<S: Scalar>(contact: &mut Contact<S>) {
    contact.flags.forget_geometry();
    contact.flags.set(Flags::FAR);
    contact.gap = S::FASTEST;
    contact.impulse = Vec2::default();
}

/// Whether the second body bears the first, or connects it to the ground.
#[inline]
fn bearing<S: Scalar>(normal: Vec2<S::Unit>, ground: Ground) -> Flags {
    let down = ground.depth(normal);
    if down >= S::unit_ratio(1, 2) {
        Flags::CONNECTS.or(Flags::BEARS)
    } else if down >= S::unit_ratio(1, 5) {
        Flags::CONNECTS
    } else {
        Flags::default()
    }
}

/// How two bodies may come together in this step.
struct Approach<S: Scalar> {
    /// What the first does, as seen from the second.
    closing: Vec2<S::Real>,
    /// How far apart they may be and still touch.
    reach: S::Real,
}

impl<S: Scalar> Approach<S> {
    fn of(a: &Body<S>, b: &Body<S>) -> Self {
        let [va, vb] = [a, b].map(|body| body.velocity.map(S::in_a_step));
        let closing = va - vb;
        // Whichever of them something stops in this step, the other may still come as far as its own velocity says.
        Self { closing, reach: reach::<S>(closing).greater(reach::<S>(va)).greater(reach::<S>(vb)) }
    }
}

/// How two bodies lie, which are boxes unless there may be `round` ones; none if they can't touch in this step.
#[inline(always)] // so that what isn't called for isn't there
pub(crate) fn near<S: Scalar>(
    a: &Body<S>,
    b: &Body<S>,
    round: bool,
    scattered: impl FnOnce() -> Vec2<S::Real>,
) -> Option<Manifold<S>> {
    let (offset, touch) = (b.position - a.position, a.half + b.half);
    let Approach { closing, reach } = Approach::of(a, b);
    match (round && a.status.is_circle(), round && b.status.is_circle()) {
        both if offset == Vec2::default() => Some(coincident(touch, both == (true, true), scattered())),
        (false, false) => boxes::<S>(offset, touch, closing, reach),
        (true, true) => circle_box::<S>(offset, touch.x, Vec2::default(), closing, reach),
        (true, false) => circle_box::<S>(offset, a.half.x, b.half, closing, reach),
        (false, true) => circle_box::<S>(-offset, b.half.x, a.half, -closing, reach).map(turned),
    }
}

/// Bodies with one centre: `scattered` says which way from the first to the second, where nothing else does.
#[cold]
fn coincident<S: Scalar>(touch: Vec2<S::Real>, circles: bool, scattered: Vec2<S::Real>) -> Manifold<S> {
    if circles && let Some((normal, _)) = direction::<S>(scattered) {
        return Manifold { normal, axis: along::<S>(normal), gap: -touch.x };
    }
    let upright = if touch.x == touch.y { scattered.y.abs() >= scattered.x.abs() } else { touch.y < touch.x };
    if upright {
        Manifold::along(vertical::<S>(scattered), -touch.y)
    } else {
        Manifold::along(horizontal::<S>(scattered), -touch.x)
    }
}

/// A place in a square of 1/256 px for each slot: what parts bodies that have one centre, each on a way of its own.
#[cold]
fn scattered<S: Scalar>(slot: u16) -> Vec2<S::Real> {
    // Multiplicative hashing (D. Knuth, "The Art of Computer Programming" 3, 6.4) by 2^32 over the golden ratio.
    let hash = (u32::from(slot) + 1).wrapping_mul(0x9e37_79b9);
    let coordinate = |bits: u32| S::real(I16F16::from_bits((bits & 0xff) as i32 - 128));
    vec2(coordinate(hash >> 24), coordinate(hash >> 16))
}

/// As seen from the other body.
fn turned<S: Scalar>(manifold: Manifold<S>) -> Manifold<S> {
    let axis = manifold.axis.map(|axis| match axis {
        Axis::Down => Axis::Up,
        Axis::Up => Axis::Down,
        Axis::Right => Axis::Left,
        Axis::Left => Axis::Right,
    });
    Manifold { normal: -manifold.normal, axis, ..manifold }
}

/// How far apart bodies may be and still touch in this step.
#[inline]
pub(crate) fn reach<S: Scalar>(closing: Vec2<S::Real>) -> S::Real {
    S::real(MARGIN) + closing.x.abs().greater(closing.y.abs())
}

/// How far a circle of radius `touch` may come along the normal to a point, at a gap of more than a graze; none if it can't touch
/// in this step.
#[inline]
fn nearing<S: Scalar>(
    offset: Vec2<S::Real>,
    touch: S::Real,
    normal: Vec2<S::Unit>,
    gap: S::Real,
    approach: &Approach<S>,
) -> Option<S::Real> {
    let &Approach { closing, reach } = approach;
    let limit = touch + reach;
    // Along a diagonal, motion leads farther than along either axis: by less than a half of the longer.
    let diagonal = reach + S::half(reach - S::real(MARGIN));
    if gap > diagonal || !offset.x.is_within(limit) || !offset.y.is_within(limit) {
        return None;
    }
    Some(leeway::<S>(offset, touch, closing, normal, gap))
}

/// The axis that a normal lies on.
#[inline]
fn along<S: Scalar>(normal: Vec2<S::Unit>) -> Option<Axis> {
    let zero = S::Unit::ZERO;
    if normal.x == zero {
        Some(if normal.y > zero { Axis::Down } else { Axis::Up })
    } else if normal.y == zero {
        Some(if normal.x > zero { Axis::Right } else { Axis::Left })
    } else {
        None
    }
}

/// How far a circle of radius `touch` may come along the normal when it moves by `motion` past a point at `offset`: what it would
/// do if that lets it pass but for a graze, else the gap.
#[cold]
#[inline(never)]
pub(crate) fn leeway<S: Scalar>(
    offset: Vec2<S::Real>,
    touch: S::Real,
    motion: Vec2<S::Real>,
    normal: Vec2<S::Unit>,
    gap: S::Real,
) -> S::Real {
    let towards = S::length_times(motion.x, normal.x) + S::length_times(motion.y, normal.y);
    if towards <= gap {
        return gap;
    }
    let Some((direction, _)) = direction::<S>(motion) else {
        return gap;
    };
    let aside = S::length_times(offset.x, direction.y) - S::length_times(offset.y, direction.x);
    if aside.abs() >= touch - S::real(GRAZE) { towards } else { gap }
}

/// Boxes: along the axis of least overlap, the vertical one if equal.
#[inline(never)]
fn boxes<S: Scalar>(
    offset: Vec2<S::Real>,
    touch: Vec2<S::Real>,
    closing: Vec2<S::Real>,
    reach: S::Real,
) -> Option<Manifold<S>> {
    let gap = vec2(offset.x.abs() - touch.x, offset.y.abs() - touch.y);
    if gap.x > reach || gap.y > reach {
        return None;
    }
    let graze = -S::real(GRAZE);
    if gap.x > graze && gap.y > graze {
        return corner::<S>(offset, gap, closing);
    }
    Some(if gap.y >= gap.x {
        Manifold::along(vertical::<S>(offset), gap.y)
    } else {
        Manifold::along(horizontal::<S>(offset), gap.x)
    })
}

fn vertical<S: Scalar>(offset: Vec2<S::Real>) -> Axis {
    if offset.y < S::Real::ZERO { Axis::Up } else { Axis::Down }
}

fn horizontal<S: Scalar>(offset: Vec2<S::Real>) -> Axis {
    if offset.x < S::Real::ZERO { Axis::Left } else { Axis::Right }
}

/// Boxes that overlap, if at all, by no more than a graze on either axis. If they lie apart, they meet on the axis on which they
/// come together last, or not at all.
#[cold]
fn corner<S: Scalar>(offset: Vec2<S::Real>, gap: Vec2<S::Real>, closing: Vec2<S::Real>) -> Option<Manifold<S>> {
    let zero = S::Real::ZERO;
    let towards = |offset: S::Real, closing: S::Real| if offset < zero { -closing } else { closing };
    let (x, y) = (towards(offset.x, closing.x), towards(offset.y, closing.y));
    if gap.x <= zero && gap.y <= zero && (gap.x < zero || gap.y < zero) {
        // Whichever way they slide, they slide over each other.
        let upright = if x > zero || y > zero { x >= y } else { gap.y >= gap.x };
        return Some(if upright {
            Manifold::along(vertical::<S>(offset), gap.y)
        } else {
            Manifold::along(horizontal::<S>(offset), gap.x)
        });
    }
    if x <= zero || y <= zero {
        return None;
    }
    // Times of meeting, gap / speed, compared without dividing: what overlaps by less than a graze then is a seam.
    let graze = S::real(GRAZE);
    let upright = if gap.x <= zero {
        S::area(gap.y, x) > S::area(gap.x + graze, y)
    } else {
        S::area(gap.x, y) <= S::area(gap.y + graze, x)
    };
    Some(if upright {
        Manifold::along(vertical::<S>(offset), gap.y)
    } else {
        Manifold::along(horizontal::<S>(offset), gap.x)
    })
}

/// Circle and box: towards the box's point that is closest to the centre; from inside, out through the nearest face.
#[inline(never)]
fn circle_box<S: Scalar>(
    offset: Vec2<S::Real>,
    radius: S::Real,
    half: Vec2<S::Real>,
    closing: Vec2<S::Real>,
    reach: S::Real,
) -> Option<Manifold<S>> {
    let zero = S::Real::ZERO;
    // From the centre to the closest point of the box.
    let closest = vec2(offset.x - offset.x.held(half.x), offset.y - offset.y.held(half.y));
    if closest.x == zero && closest.y == zero {
        let gap = vec2(offset.x.abs() - half.x, offset.y.abs() - half.y);
        return Some(if gap.y >= gap.x {
            Manifold::along(vertical::<S>(offset), gap.y - radius)
        } else {
            Manifold::along(horizontal::<S>(offset), gap.x - radius)
        });
    }
    if closest.x == zero {
        let gap = closest.y.abs() - radius;
        return (gap <= reach).then(|| Manifold::along(vertical::<S>(closest), gap));
    }
    if closest.y == zero {
        let gap = closest.x.abs() - radius;
        return (gap <= reach).then(|| Manifold::along(horizontal::<S>(closest), gap));
    }
    let Some((normal, distance)) = direction::<S>(closest) else {
        return Some(Manifold::along(Axis::Down, -radius));
    };
    // Who passes the corner may meet a face beyond it.
    let end = offset - closing;
    let end = vec2(end.x - end.x.held(half.x), end.y - end.y.held(half.y));
    let passes = !S::within(end, radius - S::real(GRAZE));
    let closing = if passes { closing } else { Vec2::default() };
    let mut gap = distance - radius;
    if gap > S::real(GRAZE) {
        gap = nearing::<S>(closest, radius, normal, gap, &Approach { closing, reach })?;
    }
    Some(Manifold { normal, axis: along::<S>(normal), gap })
}
