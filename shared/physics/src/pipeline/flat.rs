//! Impulses, level Flat: plain sequential impulses (E. Catto, "Iterative Dynamics with Temporal Coherence", 2005, without
//! accumulation), with Coulomb friction.
//!
//! For a contact with unit normal n from a to b, relative velocity v = vb - va and approach speed -v.n > 0, the relative
//! velocity is changed by `dn = -v.n + e u` along n, where u is the approach speed from before this step's gravity, and
//! by at most `mu dn` against the slip along the tangent. Masses split the change: a takes `mb / (ma + mb)` of it.

use crate::body::Body;
use crate::contact::{Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::pipeline::{bounce, integrate};
use crate::scalar::{Quantity, Scalar};
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Runs the configured number of passes over all bodies that touch.
pub(crate) fn solve<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let threshold = bounce::threshold(world, integrate::gravity(world, switches));
    for contact in world.pool.all_mut() {
        contact.impulse = Vec2::default();
    }
    for _ in 0..world.config.velocity_iterations {
        for place in 0..world.pool.all().len() {
            let contact = &world.pool.all()[place];
            if contact.flags.has(Flags::FAR) || contact.gap > S::Speed::ZERO {
                continue;
            }
            let restitution = if switches.on(Effects::BOUNCE) && contact.flags.has(Flags::BOUNCY) {
                rebound(contact, world, threshold)
            } else {
                S::Speed::ZERO
            };
            visit(&mut world.pool.all_mut()[place], restitution, world.bodies, switches);
        }
    }
}

/// The speed that a contact returns, from the approach before gravity.
fn rebound<S: Scalar>(contact: &Contact<S>, world: &World<'_, S>, threshold: S::Speed) -> S::Speed {
    let (a, b) = (usize::from(contact.a), usize::from(contact.b));
    let approach = -S::speed_along(world.before[b].saturating_sub(world.before[a]), contact.normal);
    if approach < threshold {
        return S::Speed::ZERO;
    }
    S::speed_scaled(approach, world.profiles[a].restitution.lesser(world.profiles[b].restitution))
}

/// Changes the velocities as a contact calls for, if its bodies approach each other.
#[inline]
fn visit<S: Scalar>(contact: &mut Contact<S>, rebound: S::Speed, bodies: &mut [Body<S>], switches: impl Switches) {
    let (a, b) = (usize::from(contact.a), usize::from(contact.b));
    let normal = contact.normal;
    let relative = bodies[b].velocity.saturating_sub(bodies[a].velocity);
    let approach = -S::speed_along(relative, normal);
    if approach <= S::Speed::ZERO {
        return;
    }
    let along_normal = approach.saturating_add(rebound);
    contact.impulse.x = contact.impulse.x.saturating_add(along_normal);
    let mut change = normal.map(|n| S::speed_times(along_normal, n));
    if along_normal > S::FASTEST {
        // More than the format holds, in two parts.
        push(contact, normal.map(|n| S::speed_times(approach, n)), bodies);
        change = normal.map(|n| S::speed_times(rebound, n));
    }
    if switches.on(Effects::FRICTION) && contact.friction > 0 {
        let tangent = vec2(-normal.y, normal.x);
        let most = S::coulomb(along_normal, contact.friction);
        let along_tangent = -S::speed_along(relative, tangent).held(most);
        contact.impulse.y = contact.impulse.y.saturating_add(along_tangent);
        change = change.saturating_add(tangent.map(|t| S::speed_times(along_tangent, t)));
    }
    push(contact, change, bodies);
}

/// Changes the relative velocity, each body's by its share.
#[inline]
fn push<S: Scalar>(contact: &Contact<S>, change: Vec2<S::Speed>, bodies: &mut [Body<S>]) {
    let (a, b) = (usize::from(contact.a), usize::from(contact.b));
    let part = |share| change.map(|speed| S::speed_times(speed, share));
    bodies[a].velocity = bodies[a].velocity.saturating_sub(part(contact.own_share()));
    if !contact.flags.has(Flags::IMMOVABLE) {
        bodies[b].velocity = bodies[b].velocity.saturating_add(part(S::UNIT - contact.share));
    }
}
