//! Impulses, levels Grounded and Exact.
//!
//! 1. *Warm start*: every contact begins with the impulse that it ended the last step with (E. Catto, "Iterative Dynamics with
//!    Temporal Coherence", 2005).
//! 2. *Iterations*: accumulated impulses. With relative velocity v and gap d, a contact asks for `v.n + d >= 0` and may push,
//!    never pull: `dn = max(-(v.n + d), -N)`, where N is its impulse so far. Friction keeps `|T| <= mu N`.
//! 3. *Shock*: one pass from the ground up. Where a chain of contacts carries a body down to something immovable, the body below
//!    counts as immovable too (after E. Guendelman, R. Bridson and R. Fedkiw, "Nonconvex Rigid Bodies with Stacking", 2003). The
//!    push goes along gravity alone, so that a slanted contact doesn't drive a heap sideways.

use crate::body::{Body, Marks};
use crate::contact::{Axis, Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::pipeline::narrowphase::GRAZE;
use crate::pipeline::pairs::NONE;
use crate::scalar::{Quantity, Scalar, px};
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Solves all contacts for velocities.
pub(crate) fn solve<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let friction = switches.on(Effects::FRICTION);
    warm_start(world, friction);
    for _ in 0..world.config.velocity_iterations {
        for_each_live(world, |contact, a, b| visit(contact, a, b, friction));
    }
    shock(world);
}

/// Calls a function for every live contact, with the velocities of its bodies.
#[inline(always)] // each caller's loop keeps the upper body's velocity in registers
fn for_each_live<S: Scalar>(
    world: &mut World<'_, S>,
    mut visit: impl FnMut(&mut Contact<S>, &mut Vec2<S::Speed>, &mut Vec2<S::Speed>),
) {
    let World { pool, bodies, .. } = world;
    let mut a = Vec2::default();
    let mut upper = NONE;
    for contact in pool.all_mut() {
        if contact.flags.has(Flags::FAR) {
            continue;
        }
        if contact.a != upper {
            if upper != NONE {
                bodies[usize::from(upper)].velocity = a;
            }
            upper = contact.a;
            a = bodies[usize::from(upper)].velocity;
        }
        visit(contact, &mut a, &mut bodies[usize::from(contact.b)].velocity);
    }
    if upper != NONE {
        bodies[usize::from(upper)].velocity = a;
    }
}

/// Applies the impulses of the last step. Deeply pressed contacts start with half of theirs: after a crush, bodies would shoot out.
fn warm_start<S: Scalar>(world: &mut World<'_, S>, friction: bool) {
    let crushed = S::per_step(S::real(px(-1)));
    for_each_live(world, |contact, a, b| {
        if contact.impulse.x == S::Speed::ZERO {
            return;
        }
        if contact.gap < crushed {
            contact.impulse = contact.impulse.map(S::half_speed);
        }
        if !friction {
            contact.impulse.y = S::Speed::ZERO;
        }
        let change = contact.impulse;
        (*a, *b) = if S::is_tame(*a, *b, change.x) {
            pushed_apart(contact, change, *a, *b)
        } else {
            pushed_apart_widely(contact, change, *a, *b)
        };
    });
}

/// Changes the velocities as a contact calls for.
#[inline(always)] // into the loop over contacts
fn visit<S: Scalar>(contact: &mut Contact<S>, a: &mut Vec2<S::Speed>, b: &mut Vec2<S::Speed>, friction: bool) {
    let zero = S::Speed::ZERO;
    let pushed = contact.impulse;
    if !S::is_tame(*a, *b, pushed.x) {
        (*a, *b) = visit_widely(contact, *a, *b, friction);
        return;
    }
    // Tame speeds are below 23 px/step, tame impulses below 32, gaps at most 100: no sum here leaves the format.
    let velocity = contact.in_frame(*b - *a);
    let short = velocity.x + contact.gap.greater(zero);
    if short >= zero && pushed.x == zero {
        return;
    }
    if S::is_negligible(vec2(short, velocity.y)) {
        return; // most contacts at rest
    }
    let mut change = vec2((-short).greater(-pushed.x), zero);
    let along_normal = pushed.x + change.x;
    let mut along_tangent = pushed.y;
    if friction && contact.friction > 0 {
        along_tangent = (pushed.y - velocity.y).held(S::coulomb(along_normal, contact.friction));
        change.y = along_tangent - pushed.y;
    }
    if S::is_negligible(change) {
        return;
    }
    contact.impulse = vec2(along_normal, along_tangent);
    (*a, *b) = pushed_apart(contact, change, *a, *b);
}

/// Tame velocities after a tame change of their difference, each by its share.
#[inline(always)] // into the loop over contacts
fn pushed_apart<S: Scalar>(
    contact: &Contact<S>,
    change: Vec2<S::Speed>,
    a: Vec2<S::Speed>,
    b: Vec2<S::Speed>,
) -> (Vec2<S::Speed>, Vec2<S::Speed>) {
    let change = contact.out_of_frame(change);
    if contact.flags.has(Flags::IMMOVABLE) {
        (a - change, b)
    } else if contact.flags.has(Flags::EVEN) {
        let half = change.map(S::half_speed);
        (a - half, b + half)
    } else {
        let rest = S::UNIT - contact.share;
        (a - change.map(|v| S::tame_share(v, contact.share)), b + change.map(|v| S::tame_share(v, rest)))
    }
}

/// [`visit`] for fast bodies.
#[cold]
#[inline(never)]
fn visit_widely<S: Scalar>(
    contact: &mut Contact<S>,
    a: Vec2<S::Speed>,
    b: Vec2<S::Speed>,
    friction: bool,
) -> (Vec2<S::Speed>, Vec2<S::Speed>) {
    let zero = S::Speed::ZERO;
    let (pushed, velocity) = (contact.impulse, wide_frame(contact, a, b));
    let short = velocity.x.saturating_add(contact.gap.greater(zero));
    if short >= zero && pushed.x == zero {
        return (a, b);
    }
    let mut change = vec2((-short).greater(-pushed.x), zero);
    contact.impulse.x = pushed.x.saturating_add(change.x).lesser(S::MOST_IMPULSE);
    if friction && contact.friction > 0 {
        let most = S::coulomb(contact.impulse.x, contact.friction);
        contact.impulse.y = pushed.y.saturating_sub(velocity.y).held(most);
        change.y = contact.impulse.y.saturating_sub(pushed.y);
    }
    pushed_apart_widely(contact, change, a, b)
}

/// Relative velocity in a contact's frame, where it may need more than 32 bits on the way.
#[cold]
#[inline(never)]
fn wide_frame<S: Scalar>(contact: &Contact<S>, a: Vec2<S::Speed>, b: Vec2<S::Speed>) -> Vec2<S::Speed> {
    let relative = b.saturating_sub(a);
    let tangent = vec2(-contact.normal.y, contact.normal.x);
    vec2(S::speed_along(relative, contact.normal), S::speed_along(relative, tangent))
}

/// [`pushed_apart`] for fast bodies.
#[cold]
#[inline(never)]
fn pushed_apart_widely<S: Scalar>(
    contact: &Contact<S>,
    change: Vec2<S::Speed>,
    a: Vec2<S::Speed>,
    b: Vec2<S::Speed>,
) -> (Vec2<S::Speed>, Vec2<S::Speed>) {
    let normal = contact.normal;
    let tangent = vec2(-normal.y, normal.x);
    let change =
        normal.map(|n| S::speed_times(change.x, n)).saturating_add(tangent.map(|t| S::speed_times(change.y, t)));
    let part = |share| change.map(|speed| S::speed_times(speed, share));
    let a = a.saturating_sub(part(contact.own_share()));
    if contact.flags.has(Flags::IMMOVABLE) { (a, b) } else { (a, b.saturating_add(part(S::UNIT - contact.share))) }
}

/// From the ground up: whoever stands on firm ground stops at what it stands on. Notes on the way which bodies are held, and
/// which are grounded.
fn shock<S: Scalar>(world: &mut World<'_, S>) {
    let ground = world.layers.ground();
    let (zero, graze) = (S::Speed::ZERO, S::per_step(S::real(GRAZE)));
    let World { pool, bodies, .. } = world;
    let mut upper = NONE;
    let (mut a, mut marks) = (Vec2::default(), Marks::default());
    for contact in pool.all() {
        if contact.flags.has(Flags::FAR) {
            continue;
        }
        let pushes = contact.impulse.x > zero;
        if !pushes && contact.gap > zero && !contact.flags.has(Flags::BEARS) {
            continue;
        }
        if contact.a != upper {
            if upper != NONE {
                settle(&mut bodies[usize::from(upper)], a, marks);
            }
            upper = contact.a;
            (a, marks) = (bodies[usize::from(upper)].velocity, Marks::default());
        }
        let b = &mut bodies[usize::from(contact.b)];
        if pushes {
            let held = held(contact);
            marks.set(held);
            b.marks.set(held);
        }
        let firm = contact.flags.has(Flags::IMMOVABLE) || b.marks.has(Marks::GROUNDED);
        if !firm || !contact.flags.has(Flags::CONNECTS) {
            continue;
        }
        if pushes || contact.gap <= graze {
            marks.set(Marks::GROUNDED);
        }
        if !contact.flags.has(Flags::BEARS) {
            continue;
        }
        let velocity = if S::is_tame(a, b.velocity, zero) {
            contact.in_frame(b.velocity - a)
        } else {
            wide_frame(contact, a, b.velocity)
        };
        let short = velocity.x.saturating_add(contact.gap.greater(zero));
        if short < zero {
            let lift =
                if contact.flags.has(Flags::AXIS) { short } else { S::over_slope(short, ground.depth(contact.normal)) };
            ground.lower(&mut a, lift);
            marks.set(held(contact).or(Marks::GROUNDED));
        }
    }
    if upper != NONE {
        settle(&mut bodies[usize::from(upper)], a, marks);
    }
}

#[inline]
fn settle<S: Scalar>(body: &mut Body<S>, velocity: Vec2<S::Speed>, marks: Marks) {
    body.velocity = velocity;
    body.marks.set(marks);
}

/// The axes along which a contact pushes.
#[inline]
fn held<S: Scalar>(contact: &Contact<S>) -> Marks {
    if !contact.flags.has(Flags::AXIS) {
        return Marks::HELD_X.or(Marks::HELD_Y);
    }
    match contact.flags.axis() {
        Axis::Down | Axis::Up => Marks::HELD_Y,
        Axis::Right | Axis::Left => Marks::HELD_X,
    }
}
