//! Warm start: every contact begins with the impulse that it ended the last step with (E. Catto, "Iterative Dynamics with Temporal
//! Coherence", 2005).
//!
//! It runs from the top down: a body that stood on one other alone hands down what it lacks for standing on, so that each contact
//! of a column knows the load above it at once.

use crate::body::{Body, Marks};
use crate::contact::{Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::pipeline::grounded::{pushed_alike, pushed_apart, pushed_apart_widely};
use crate::pipeline::order::Ground;
use crate::scalar::{Quantity, Scalar, px, ratio};
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Applies the impulses of the last step. What is crushed starts without: bodies would shoot out afterwards.
#[inline(never)]
pub(crate) fn apply<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let friction = switches.on(Effects::FRICTION);
    let ground = world.layers.ground();
    let crushed = S::per_step(S::real(px(-1)));
    let World { pool, bodies, before, .. } = world;
    let contacts = pool.all_mut();
    let Some(last) = contacts.last() else { return };
    let mut upper = last.a;
    let mut a = bodies[usize::from(upper)].velocity;
    // How many contacts bear the upper body, and the last of them.
    let (mut bearers, mut bearer) = (0, None);
    for contact in contacts.iter_mut().rev() {
        if contact.flags.has(Flags::FAR) {
            continue;
        }
        if contact.a != upper {
            hand_down(bearers, bearer, &mut a, bodies, before, ground, switches);
            bodies[usize::from(upper)].velocity = a;
            upper = contact.a;
            a = bodies[usize::from(upper)].velocity;
            (bearers, bearer) = (0, None);
        }
        if contact.impulse.x != S::Speed::ZERO {
            if contact.gap < crushed {
                contact.impulse = Vec2::default();
            }
            if !friction {
                contact.impulse.y = S::Speed::ZERO;
            }
            let b = &mut bodies[usize::from(contact.b)].velocity;
            let change = contact.impulse;
            (a, *b) = if !S::is_tame(a, *b, change.x) {
                pushed_apart_widely(contact, change, a, *b, switches)
            } else if contact.flags.is_plain(switches) {
                pushed_alike(contact, change, a, *b)
            } else {
                pushed_apart(contact, change, a, *b, switches)
            };
        }
        if contact.flags.has(Flags::BEARS) {
            (bearers, bearer) = (bearers + 1, Some(contact));
        }
    }
    hand_down(bearers, bearer, &mut a, bodies, before, ground, switches);
    bodies[usize::from(upper)].velocity = a;
}

/// What a body that stood lacks for staying on the only contact that bears it, that one has to carry.
#[inline(always)] // into the loop over contacts
fn hand_down<S: Scalar>(
    bearers: u32,
    bearer: Option<&mut Contact<S>>,
    a: &mut Vec2<S::Speed>,
    bodies: &mut [Body<S>],
    before: &[Vec2<S::Speed>],
    ground: Ground,
    switches: impl Switches,
) {
    let Some(contact) = bearer else { return };
    if bearers > 1 || contact.slopes(switches) {
        return;
    }
    let stood = bodies[usize::from(contact.a)].marks.has(Marks::STOOD);
    if !stood || contact.impulse.x <= S::Speed::ZERO {
        return;
    }
    let lower = usize::from(contact.b);
    let b = &mut bodies[lower].velocity;
    let firm = if contact.flags.has(Flags::IMMOVABLE) { *b } else { before[lower] };
    if !S::is_nearly_same(*a, firm) {
        (*a, *b) = hand(contact, ground.depth(firm), ground, *a, *b, switches);
    }
}

/// Lets a contact carry what brings the upper body to the speed towards the ground that the lower one had.
#[cold]
#[inline(never)]
fn hand<S: Scalar>(
    contact: &mut Contact<S>,
    firm: S::Speed,
    ground: Ground,
    a: Vec2<S::Speed>,
    b: Vec2<S::Speed>,
    switches: impl Switches,
) -> (Vec2<S::Speed>, Vec2<S::Speed>) {
    let zero = S::Speed::ZERO;
    // What little the lower one moved is noise, which mustn't travel up and down.
    let firm = if firm.is_within(S::per_step(S::real(ratio(1, 1024)))) { zero } else { firm };
    let excess = ground.depth(a).saturating_sub(firm);
    if S::is_negligible(vec2(excess, zero)) {
        return (a, b);
    }
    let change = if contact.flags.has(Flags::IMMOVABLE) {
        excess
    } else if contact.is_even(switches) {
        excess.saturating_add(excess)
    } else {
        S::over_share(excess, contact.share)
    };
    let change = change.lesser(S::MOST_IMPULSE - contact.impulse.x).greater(-contact.impulse.x);
    contact.impulse.x = contact.impulse.x + change;
    pushed_apart_widely(contact, vec2(change, zero), a, b, switches)
}
