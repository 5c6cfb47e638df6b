//! Restitution, in a phase of its own before gravity: fast contacts return their approach speed, one after the other, until
//! none approaches fast any more. So a row of balls passes an impact on, and a bounce gives back what the flight brought.
//!
//! A contact bounces in the step in which its bodies would meet, from where they are: reversing early by a part of a step. The
//! speed that it leaves with is what a bounce at the surface would have at that height: with approach speed v at height h over
//! something immovable, the surface is reached at `v^2 + 2 g h`, left with `e^2` of it, and the height is regained with
//! `e^2 (v^2 + 2 g h) - 2 g h`, all squares (conservation of energy).

use crate::body::{Body, Marks, Profile};
use crate::contact::{Contact, Flags};
use crate::effects::Switches;
use crate::scalar::{Quantity, Scalar};
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Passes over the contacts: back and forth, so that an impact runs through a row in either direction, and its echo back.
const PASSES: usize = 4;

/// Lets contacts bounce; whether any did.
pub(crate) fn bounce<S: Scalar>(world: &mut World<'_, S>, gravity: Vec2<S::Speed>, switches: impl Switches) -> bool {
    let threshold = threshold(world, gravity);
    // No two bodies approach each other faster than this.
    let closing = world.fastest.saturating_add(world.fastest).saturating_add(world.fastest);
    if closing < threshold {
        return false;
    }
    let mut any = false;
    for pass in 0..PASSES {
        let World { pool, bodies, profiles, .. } = world;
        let mut bounced = false;
        let contacts = pool.all_mut();
        let (count, forth) = (contacts.len(), pass % 2 == 0);
        for place in 0..count {
            let contact = &mut contacts[if forth { place } else { count - 1 - place }];
            if !contact.flags.has(Flags::BOUNCY) || contact.flags.has(Flags::FAR) {
                continue;
            }
            let jolted = bodies[usize::from(contact.a)].marks.or(bodies[usize::from(contact.b)].marks);
            if pass > 0 && !jolted.has(Marks::JOLTED) {
                continue;
            }
            let approach = approach(contact, bodies, switches);
            if approach >= threshold {
                bounced |= rebound(contact, approach, gravity, bodies, profiles, switches);
            }
        }
        if !bounced {
            break;
        }
        any = true;
    }
    any
}

/// Approach speed below which nothing bounces: never less than what gravity adds in two steps, or a body at rest would bounce for
/// ever.
pub(crate) fn threshold<S: Scalar>(world: &World<'_, S>, gravity: Vec2<S::Speed>) -> S::Speed {
    let pull = gravity.x.abs() + gravity.y.abs();
    world.bounce_threshold.greater(pull + pull)
}

/// Speed at which a contact's bodies approach each other.
#[inline]
fn approach<S: Scalar>(contact: &Contact<S>, bodies: &[Body<S>], switches: impl Switches) -> S::Speed {
    let (a, b) = (bodies[usize::from(contact.a)].velocity, bodies[usize::from(contact.b)].velocity);
    if S::is_tame(a, b, S::Speed::ZERO) {
        -contact.in_frame(b - a, switches).x
    } else {
        -S::speed_along(b.saturating_sub(a), contact.normal)
    }
}

/// Turns an approach around, if the bodies would meet in this step; whether it did.
#[cold]
#[inline(never)]
fn rebound<S: Scalar>(
    contact: &mut Contact<S>,
    approach: S::Speed,
    gravity: Vec2<S::Speed>,
    bodies: &mut [Body<S>],
    profiles: &[Profile<S>],
    switches: impl Switches,
) -> bool {
    let zero = S::Speed::ZERO;
    let pull = if contact.flags.has(Flags::IMMOVABLE) { S::speed_along(gravity, contact.normal) } else { zero };
    if contact.gap >= approach.saturating_add(pull) {
        return false;
    }
    let [own, other] = [contact.a, contact.b].map(|slot| profiles[usize::from(slot)].restitution);
    let restitution = own.lesser(other);
    let height = contact.gap.greater(zero);
    let rebound = if height > zero && pull > zero {
        let impact = S::fallen(approach, pull, height);
        S::fallen(S::speed_scaled(impact, restitution), -pull, height)
    } else {
        S::speed_scaled(approach, restitution)
    };
    if height > zero && rebound <= zero {
        return false; // too weak to regain this height: it bounces once it is closer
    }
    contact.impulse = vec2(zero, zero);
    contact.flags.set(Flags::BOUNCED);
    for slot in [contact.a, contact.b] {
        bodies[usize::from(slot)].marks.set(Marks::JOLTED);
    }
    let change = approach.saturating_add(rebound);
    if change > S::FASTEST {
        // More than the format holds.
        apply(contact, approach, bodies, switches);
        apply(contact, rebound, bodies, switches);
    } else {
        apply(contact, change, bodies, switches);
    }
    true
}

fn apply<S: Scalar>(contact: &Contact<S>, change: S::Speed, bodies: &mut [Body<S>], switches: impl Switches) {
    let change = contact.normal.map(|n| S::speed_times(change, n));
    let [own, other] = contact.parts(change, switches);
    let a = &mut bodies[usize::from(contact.a)].velocity;
    *a = a.saturating_sub(own);
    let b = &mut bodies[usize::from(contact.b)].velocity;
    *b = b.saturating_add(other);
}
