//! Overlap is pushed apart without touching velocities: a part of what exceeds the slop, each step (J. Baumgarte's
//! stabilization, 1972, applied to positions).

use crate::scalar::{Quantity, Scalar};
use crate::world::World;

/// One pass over all contacts.
pub(crate) fn correct<S: Scalar>(world: &mut World<'_, S>) {
    let (slop, bias) = (world.config.slop, world.config.bias);
    for contact in world.pool.all() {
        if contact.penetration <= slop {
            continue;
        }
        let correction = S::length_scaled(contact.penetration - slop, bias);
        let apart = contact.normal.map(|n| S::length_times(correction, n));
        let part = |share| apart.map(|length| S::length_times(length, share));
        let a = &mut world.bodies[usize::from(contact.a)].position;
        *a = a.saturating_sub(part(contact.share));
        let other = contact.other_share();
        if other != S::Unit::ZERO {
            let b = &mut world.bodies[usize::from(contact.b)].position;
            *b = b.saturating_add(part(other));
        }
    }
}
