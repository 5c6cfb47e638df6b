//! Impulses at contacts: plain sequential impulses (E. Catto, "Iterative Dynamics with Temporal Coherence", 2005, without
//! accumulation), with Coulomb friction.
//!
//! For a contact with unit normal n from a to b, relative velocity v = vb - va and approach speed -v.n > 0, the relative
//! velocity is changed by `dn = -v.n + e u` along n, where u is the approach speed from before this step's gravity, and
//! by at most `mu dn` against the slip along the tangent. Masses split the change: a takes `mb / (ma + mb)` of it.

use crate::contact::Contact;
use crate::effects::{Effects, Switches};
use crate::scalar::{Quantity, Scalar};
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Runs the configured number of passes over all contacts.
pub(crate) fn solve<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let threshold = world.bounce_threshold;
    for _ in 0..world.config.velocity_iterations {
        for contact in world.pool.all_mut() {
            let a = world.bodies[usize::from(contact.a)].velocity;
            let b = world.bodies[usize::from(contact.b)].velocity;
            let Some(change) = impulse(contact, b.saturating_sub(a), threshold, switches) else {
                continue;
            };
            let part = |share| change.map(|speed| S::speed_times(speed, share));
            world.bodies[usize::from(contact.a)].velocity = a.saturating_sub(part(contact.share));
            let other = contact.other_share();
            if other != S::Unit::ZERO {
                world.bodies[usize::from(contact.b)].velocity = b.saturating_add(part(other));
            }
        }
    }
}

/// The change of relative velocity that a contact calls for; none if its bodies part.
#[inline]
fn impulse<S: Scalar>(
    contact: &mut Contact<S>,
    relative: Vec2<S::Speed>,
    threshold: S::Speed,
    switches: impl Switches,
) -> Option<Vec2<S::Speed>> {
    let normal = contact.normal;
    let approach = -S::speed_along(relative, normal);
    if approach <= S::Speed::ZERO {
        return None;
    }
    let mut along_normal = approach;
    if switches.on(Effects::BOUNCE) && contact.restitution > S::Real::ZERO {
        let incoming = contact.approach.lesser(approach);
        if incoming >= threshold {
            along_normal = along_normal.saturating_add(S::speed_scaled(incoming, contact.restitution));
        }
    }
    contact.impulse.x = contact.impulse.x.saturating_add(along_normal);
    let mut change = normal.map(|n| S::speed_times(along_normal, n));

    if switches.on(Effects::FRICTION) && contact.friction > S::Real::ZERO {
        let tangent = vec2(-normal.y, normal.x);
        let most = S::speed_scaled(along_normal, contact.friction);
        let along_tangent = -S::speed_along(relative, tangent).held(most);
        contact.impulse.y = contact.impulse.y.saturating_add(along_tangent);
        change = change.saturating_add(tangent.map(|t| S::speed_times(along_tangent, t)));
    }
    Some(change)
}
