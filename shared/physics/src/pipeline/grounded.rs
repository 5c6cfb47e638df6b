//! Impulses, levels Grounded and Exact.
//!
//! 1. *Rows* with light bodies in between, or that a kinematic one pushes, stop where there is no room for them: see `carry`.
//! 2. *Warm start*: every contact begins with the impulse that it ended the last step with: see `warm_start`.
//! 3. *Iterations*: accumulated impulses. With relative velocity v and gap d, a contact asks for `v.n + d >= 0` and may push,
//!    never pull: `dn = max(-(v.n + d), -N)`, where N is its impulse so far. Friction keeps `|T| <= mu N`. A contact under load
//!    between equal masses pushes by half as much again (successive over-relaxation, D. Young, 1954), by no more than N / 16: deep
//!    heaps settle sooner, what just meets isn't thrown apart. Letting go is not exaggerated; nor is the push on what is light and
//!    lies between heavy bodies, which in time would lift them.
//! 4. *Shock*: one pass from the ground up. Where a chain of contacts carries a body down to something immovable, the body below
//!    counts as immovable too (after E. Guendelman, R. Bridson and R. Fedkiw, "Nonconvex Rigid Bodies with Stacking", 2003). The
//!    push goes along gravity alone, so that a slanted contact doesn't drive a heap sideways. Bodies that move next to nothing
//!    relative to what they stand on stand still.
//! 5. *Clamp*: where some bodies are a thousand times lighter than others, nobody ends faster than the fastest was before.

use ::fixed::types::I16F16;

use crate::body::{Body, Marks};
use crate::contact::{Axis, Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::pipeline::narrowphase::GRAZE;
use crate::pipeline::{carry, ccd, warm_start};
use crate::scalar::{Quantity, Scalar, ratio};
use crate::variety::Variety;
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Solves all contacts for velocities.
pub(crate) fn solve<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let uneven = switches.variety().contain(Variety::MASSES) && world.uneven;
    let most = if uneven { most(world) } else { None };
    // First: what it undid of a warm start would stay in the impulses, and come out once the row is let go.
    carry::velocities(world, switches);
    warm_start::apply(world, switches);
    for _ in 0..world.config.velocity_iterations {
        if !pass(world, switches) {
            break; // what is left is for the next step
        }
    }
    shock(world, switches);
    if let Some(most) = most {
        hold(world, most);
    }
}

/// The largest speed of any body where some are a thousand times lighter than others; or up to an eighth more, as the longer
/// component and half of the other take no root.
#[cold]
#[inline(never)]
fn most<S: Scalar>(world: &World<'_, S>) -> Option<S::Speed> {
    let slots = world.layers.dynamics();
    let [lightest, heaviest] = carry::masses(slots, world.bodies, world.profiles)?;
    let part = S::unit_ratio(1, 32);
    if lightest >= S::length_times(S::length_times(heaviest, part), part) {
        return None;
    }
    let speed = |velocity: Vec2<S::Speed>| {
        let Vec2 { x, y } = velocity.map(Quantity::abs);
        x.greater(y).saturating_add(S::half_speed(x.lesser(y)))
    };
    let speeds = slots.iter().map(|&slot| speed(world.bodies[usize::from(slot)].velocity));
    Some(speeds.fold(S::Speed::ZERO, Quantity::greater))
}

/// Contacts take energy, never give any. But a few passes leave a light body under a heavy one with a part of the impulse that the
/// heavy one needs, and it would shoot out of the heap.
#[cold]
#[inline(never)]
fn hold<S: Scalar>(world: &mut World<'_, S>, most: S::Speed) {
    for &slot in world.layers.dynamics() {
        let body = &mut world.bodies[usize::from(slot)];
        if body.status.is_rigid() {
            body.velocity = body.velocity.map(|speed| speed.held(most));
        }
    }
}

/// Looks at every live contact once; whether that changed something worth another pass.
#[inline(never)]
fn pass<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) -> bool {
    let mut changed = false;
    for_each_live(world, |contact, flags, a, b| {
        if visit(contact, flags, a, b, switches) {
            changed = true;
        }
    });
    changed
}

/// What parts by less in a step (0.06 px/s) hasn't parted. With a quarter of it, one in seven pyramids that were dropped hops on for
/// seconds.
const ADRIFT: I16F16 = ratio(1, 1024);

/// What solving leaves of a velocity in a heap at rest, at most, px a step (0.004 px/s).
const RESIDUE: I16F16 = ratio(1, 1 << 14);

/// Calls a function for every live contact, with the velocities of its bodies.
#[inline(always)] // each caller's loop keeps the upper body's velocity in registers
fn for_each_live<S: Scalar>(
    world: &mut World<'_, S>,
    mut visit: impl FnMut(&mut Contact<S>, Flags, &mut Vec2<S::Speed>, &mut Vec2<S::Speed>),
) {
    let World { pool, bodies, .. } = world;
    let contacts = pool.all_mut();
    let Some(first) = contacts.first() else { return };
    let mut upper = first.a;
    let mut a = bodies[usize::from(upper)].velocity;
    for contact in contacts {
        let flags = contact.flags;
        if flags.has(Flags::FAR) {
            continue;
        }
        if contact.a != upper {
            bodies[usize::from(upper)].velocity = a;
            upper = contact.a;
            a = bodies[usize::from(upper)].velocity;
        }
        visit(contact, flags, &mut a, &mut bodies[usize::from(contact.b)].velocity);
    }
    bodies[usize::from(upper)].velocity = a;
}

/// Changes the velocities as a contact calls for; whether by more than a [`RESIDUE`].
#[inline(always)] // into the loop over contacts
fn visit<S: Scalar>(
    contact: &mut Contact<S>,
    flags: Flags,
    a: &mut Vec2<S::Speed>,
    b: &mut Vec2<S::Speed>,
    switches: impl Switches,
) -> bool {
    let zero = S::Speed::ZERO;
    let pushed = contact.impulse;
    if S::is_nearly_same(*a, *b) && (contact.gap <= zero || pushed.x == zero) {
        return false; // most contacts at rest
    }
    if !S::is_tame(*a, *b, pushed.x) {
        (*a, *b) = visit_widely(contact, *a, *b, switches);
        return true;
    }
    if flags.is_plain(switches) {
        answer::<S, true>(contact, a, b, switches)
    } else {
        answer::<S, false>(contact, a, b, switches)
    }
}

/// [`visit`] for tame bodies: below 23 px/step against each other, impulses below 32, gaps at most 100, so no sum here leaves the
/// format. `PLAIN`: whether the contact [is](Flags::is_plain).
#[inline(always)] // into the loop over contacts
fn answer<S: Scalar, const PLAIN: bool>(
    contact: &mut Contact<S>,
    a: &mut Vec2<S::Speed>,
    b: &mut Vec2<S::Speed>,
    switches: impl Switches,
) -> bool {
    let (zero, pushed) = (S::Speed::ZERO, contact.impulse);
    let relative = *b - *a;
    let velocity = if PLAIN { S::into_frame(relative, contact.normal) } else { contact.in_frame(relative, switches) };
    let short = velocity.x + contact.gap.greater(zero);
    if short >= zero && pushed.x == zero {
        return false;
    }
    // What is under load pushes half as much again as called for, by at most a sixteenth of the load.
    let exaggerates = (PLAIN || contact.flags.has(Flags::EVEN)) && contact.gap >= ccd::deep::<S>();
    let more = if exaggerates { S::half_speed(-short).lesser(S::sixteenth(pushed.x)).greater(zero) } else { zero };
    let mut change = vec2((more - short).greater(-pushed.x), zero);
    let along_normal = pushed.x + change.x;
    let mut along_tangent = pushed.y;
    if switches.on(Effects::FRICTION) && contact.friction > 0 {
        along_tangent = (pushed.y - velocity.y).held(S::coulomb(along_normal, contact.friction));
        change.y = along_tangent - pushed.y;
    }
    if S::is_negligible(change) {
        return false;
    }
    contact.impulse = vec2(along_normal, along_tangent);
    (*a, *b) =
        if PLAIN { pushed_alike(contact, change, *a, *b) } else { pushed_apart(contact, change, *a, *b, switches) };
    !change.x.is_within(S::per_step(S::real(RESIDUE)))
}

/// [`pushed_apart`] where the contact is [plain](Flags::is_plain).
#[inline(always)] // into the loops over contacts
pub(crate) fn pushed_alike<S: Scalar>(
    contact: &Contact<S>,
    change: Vec2<S::Speed>,
    a: Vec2<S::Speed>,
    b: Vec2<S::Speed>,
) -> (Vec2<S::Speed>, Vec2<S::Speed>) {
    let half = S::out_of_frame(change, contact.normal).map(S::half_speed);
    (a - half, b + half)
}

/// Tame velocities after a tame change of their difference, each by its share.
#[inline(always)] // into the loop over contacts
pub(crate) fn pushed_apart<S: Scalar>(
    contact: &Contact<S>,
    change: Vec2<S::Speed>,
    a: Vec2<S::Speed>,
    b: Vec2<S::Speed>,
    switches: impl Switches,
) -> (Vec2<S::Speed>, Vec2<S::Speed>) {
    let change = contact.out_of_frame(change, switches);
    if contact.flags.has(Flags::IMMOVABLE) {
        (a - change, b)
    } else if contact.is_even(switches) {
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
    switches: impl Switches,
) -> (Vec2<S::Speed>, Vec2<S::Speed>) {
    let zero = S::Speed::ZERO;
    let (pushed, velocity) = (contact.impulse, wide_frame(contact, a, b));
    let short = velocity.x.saturating_add(contact.gap.greater(zero));
    if short >= zero && pushed.x == zero {
        return (a, b);
    }
    let mut change = vec2((-short).greater(-pushed.x), zero);
    contact.impulse.x = pushed.x.saturating_add(change.x).lesser(S::MOST_IMPULSE);
    if switches.on(Effects::FRICTION) && contact.friction > 0 {
        let most = S::coulomb(contact.impulse.x, contact.friction);
        contact.impulse.y = pushed.y.saturating_sub(velocity.y).held(most);
        change.y = contact.impulse.y.saturating_sub(pushed.y);
    }
    pushed_apart_widely(contact, change, a, b, switches)
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
pub(crate) fn pushed_apart_widely<S: Scalar>(
    contact: &Contact<S>,
    change: Vec2<S::Speed>,
    a: Vec2<S::Speed>,
    b: Vec2<S::Speed>,
    switches: impl Switches,
) -> (Vec2<S::Speed>, Vec2<S::Speed>) {
    let normal = contact.normal;
    let tangent = vec2(-normal.y, normal.x);
    let change =
        normal.map(|n| S::speed_times(change.x, n)).saturating_add(tangent.map(|t| S::speed_times(change.y, t)));
    let [own, other] = contact.parts(change, switches);
    (a.saturating_sub(own), b.saturating_add(other))
}

/// From the ground up: whoever stands on firm ground stops at what it stands on. Notes on the way which bodies are held, and
/// which are grounded.
#[inline(never)]
fn shock<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let ground = world.layers.ground();
    let (zero, graze, adrift) = (S::Speed::ZERO, S::per_step(S::real(GRAZE)), S::per_step(S::real(ADRIFT)));
    let World { pool, bodies, .. } = world;
    let contacts = pool.all();
    let Some(first) = contacts.first() else { return };
    let mut upper = first.a;
    let (mut a, mut marks) = (bodies[usize::from(upper)].velocity, Marks::default());
    for contact in contacts {
        let flags = contact.flags;
        if flags.has(Flags::FAR) {
            continue;
        }
        let pushes = contact.impulse.x > zero;
        if !pushes && contact.gap > zero && !flags.has(Flags::BEARS) {
            continue;
        }
        if contact.a != upper {
            settle(&mut bodies[usize::from(upper)], a, marks);
            upper = contact.a;
            (a, marks) = (bodies[usize::from(upper)].velocity, Marks::default());
        }
        let b = &mut bodies[usize::from(contact.b)];
        let held = held(contact, switches);
        if pushes {
            marks.set(held);
            b.marks.set(held);
        }
        if !flags.has(Flags::CONNECTS) {
            continue;
        }
        if !flags.has(Flags::IMMOVABLE) && !b.marks.has(Marks::GROUNDED) {
            continue;
        }
        if pushes || contact.gap <= graze {
            marks.set(Marks::GROUNDED);
        }
        if !flags.has(Flags::BEARS) || (contact.gap <= zero && a == b.velocity) {
            continue;
        }
        if pushes && contact.gap <= zero && S::is_at_rest(a, b.velocity) {
            a = b.velocity; // or heaps would never become still
            marks.set(held.or(Marks::GROUNDED));
            continue;
        }
        // As in `visit`, no sum of tame quantities leaves the format.
        let (tame, ahead) = (S::is_tame(a, b.velocity, zero), contact.gap.greater(zero));
        let short = if tame {
            contact.in_frame(b.velocity - a, switches).x + ahead
        } else {
            wide_frame(contact, a, b.velocity).x.saturating_add(ahead)
        };
        if short < if pushes { adrift } else { zero } {
            let lift =
                if contact.slopes(switches) { S::over_slope(short, ground.depth(contact.normal)) } else { short };
            if tame {
                ground.add(&mut a, lift);
            } else {
                ground.lower(&mut a, lift);
            }
            marks.set(held.or(Marks::GROUNDED));
        }
    }
    settle(&mut bodies[usize::from(upper)], a, marks);
}

#[inline]
fn settle<S: Scalar>(body: &mut Body<S>, velocity: Vec2<S::Speed>, marks: Marks) {
    body.velocity = velocity;
    body.marks.set(marks);
}

/// The axes along which a contact pushes.
#[inline]
fn held<S: Scalar>(contact: &Contact<S>, switches: impl Switches) -> Marks {
    if contact.slopes(switches) {
        return Marks::HELD_X.or(Marks::HELD_Y);
    }
    match contact.flags.axis() {
        Axis::Down | Axis::Up => Marks::HELD_Y,
        Axis::Right | Axis::Left => Marks::HELD_X,
    }
}
