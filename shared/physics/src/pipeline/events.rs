//! What a step leaves for the game to read: its contacts, which of them began and ended, and the bodies that left the world.

use crate::contact::{Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::scalar::{POSITION_LIMIT, Quantity, Scalar, px, ratio};
use crate::world::World;

/// How far apart bodies that touched may come and still be said to touch, px. Less is what rounding and the slop leave between
/// bodies at rest.
const TOLERANCE: ::fixed::types::I16F16 = ratio(1, 16);

/// Notes high-water marks and events, and disables bodies whose centre is beyond [`POSITION_LIMIT`].
pub(crate) fn publish<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    world.pool.count();
    if core::mem::take(&mut world.strays) {
        disable_strays(world);
    }
    if switches.on(Effects::EVENTS) {
        note(world);
    }
    world.steps = world.steps.wrapping_add(1);
}

/// Bodies whose centre is beyond the limit leave the world.
#[cold]
fn disable_strays<S: Scalar>(world: &mut World<'_, S>) {
    for &slot in world.layers.dynamics() {
        let body = &mut world.bodies[usize::from(slot)];
        if body.is_beyond_limit() {
            body.position = body.position.map(|p| p.held(S::real(px(POSITION_LIMIT))));
            body.status.disable();
            world.escaped = world.escaped.saturating_add(1);
        }
    }
    world.layers.changed(false);
}

/// Notes which contacts touch, and which did a step ago: two flags a contact are all that events are made of. If events were off
/// in the last step, whatever touches begins. Where events are off, this is not run, no contact is ever flagged as touching, and
/// so none is kept beyond its end.
fn note<S: Scalar>(world: &mut World<'_, S>) {
    let follows = world.told_at == Some(world.steps);
    for contact in world.pool.all_mut() {
        let touched = follows && contact.flags.has(Flags::TOUCHING);
        let touches = touches(contact, touched);
        contact.flags.clear(Flags::TOUCHING.or(Flags::TOUCHED));
        if contact.flags.has(Flags::BOUNCED) {
            contact.flags.set(Flags::NEW); // that is forgotten when the contact is looked at
        }
        if touched {
            contact.flags.set(Flags::TOUCHED);
        }
        if touches {
            contact.flags.set(Flags::TOUCHING);
        }
    }
    world.pool.end_aside();
    world.told_at = Some(world.steps.wrapping_add(1));
}

/// Whether bodies touch, push each other or have bounced; still do, if they did.
fn touches<S: Scalar>(contact: &Contact<S>, touched: bool) -> bool {
    let near = if touched { S::per_step(S::real(TOLERANCE)) } else { S::Speed::ZERO };
    let flags = contact.flags;
    if contact.has_parted() || (flags.has(Flags::FAR) && !flags.has(Flags::SENSOR)) {
        return false;
    }
    contact.gap <= near || contact.impulse.x > S::Speed::ZERO || flags.has(Flags::BOUNCED)
}
