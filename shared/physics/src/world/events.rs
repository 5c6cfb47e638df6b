//! Begin, stay and end of contacts.

use super::World;
use crate::body::Marks;
use crate::contact::{Contact, Flags};
use crate::handle::Handle;
use crate::kinematics::Collider;
use crate::pipeline::terrain;
use crate::scalar::{Quantity, Scalar};
use crate::tiles::Tile;
use crate::vec2::Vec2;

/// Where a contact is in its life.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The two touch, and didn't a step ago.
    Begin,
    /// They still touch.
    Stay,
    /// They touch no more, or one of them is gone, hidden or disabled.
    End,
}

/// Something about two that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event<S: Scalar> {
    /// Begin, stay or end.
    pub phase: Phase,
    /// A body. At an end, it may be gone.
    pub body: Handle,
    /// The other body, or a tile of the map. A body that slides over tiles stays in one contact with the map: the tile is the
    /// one that it touches most.
    pub other: Collider,
    /// Unit normal from the body to the other. At an end: when they were last near.
    pub normal: Vec2<S::Unit>,
    /// Change of relative velocity in the step, px per step: along the normal (x) and the tangent (y).
    ///
    /// What a bounce changed is told from the speed `u` at which it left the two, as `u + u / e` with restitution `e`: less than
    /// it was if a third body took some of that speed in the same step. 0 at an end.
    pub impulse: Vec2<S::Speed>,
    /// Whether one of the two only notices the other.
    pub sensor: bool,
}

impl<S: Scalar> Event<S> {
    /// The other one, as seen from one of the two; none if the body has no part in this.
    pub fn of(&self, handle: Handle) -> Option<Collider> {
        if handle == self.body {
            Some(self.other)
        } else if self.other == Collider::Body(handle) {
            Some(Collider::Body(self.body))
        } else {
            None
        }
    }
}

impl<'a, S: Scalar> World<'a, S> {
    /// What began, lasted and ended in the last step, if [`EVENTS`](crate::Effects::EVENTS) was on: first the ends of pairs that
    /// parted for good, then one event a pair that is still near, in the order in which the solver took the contacts.
    ///
    /// Sensors notice what overlaps them at the start of a step. With [`CCD`](crate::Effects::CCD) or at
    /// [`Level::Exact`](crate::Level::Exact), bodies that are sensors also notice what passes them within one; sensor tiles don't.
    ///
    /// A contact begins once and ends once, also when a body is removed: its end is told by the step after that, with the handle
    /// that it had. Bodies at rest don't flicker: what touched lasts until the gap exceeds 1/16 px. Only
    /// [`clear`](Self::clear) leaves contacts without an end.
    pub fn events(&self) -> impl Iterator<Item = Event<S>> {
        let mut place = 0;
        core::iter::from_fn(move || self.next_event(&mut place))
    }

    /// Calls a function for each of the [`events`](Self::events), which may change the world: spawn, despawn, set. A body that
    /// one event's handler removes still gets the others' events of this step, and the ends of them all after the next one.
    ///
    /// A step within a handler ends the round: the events are then others.
    pub fn dispatch(&mut self, mut handler: impl FnMut(&mut World<'a, S>, Event<S>)) {
        let (steps, mut place) = (self.steps, 0);
        while self.steps == steps
            && let Some(event) = self.next_event(&mut place)
        {
            handler(self, event);
        }
    }

    /// The next event at or after a place in the pool, which moves on.
    fn next_event(&self, place: &mut usize) -> Option<Event<S>> {
        if self.told_at != Some(self.steps) {
            return None;
        }
        loop {
            let contact = self.pool.at(*place)?;
            *place += 1;
            let phase = match (contact.flags.has(Flags::TOUCHED), contact.flags.has(Flags::TOUCHING)) {
                (false, false) => continue,
                (false, true) => Phase::Begin,
                (true, true) => Phase::Stay,
                (true, false) => Phase::End,
            };
            return Some(self.event(phase, contact));
        }
    }

    fn event(&self, phase: Phase, contact: &Contact<S>) -> Event<S> {
        let [body, other] = if contact.has_parted() {
            let [first, second] = contact.generations();
            [Handle { slot: contact.a, generation: first }, Handle { slot: contact.b, generation: second }]
        } else {
            [self.handle(contact.a), self.handle(contact.b)]
        };
        Event {
            phase,
            body,
            other: if contact.b == self.terrain { self.tile_of(contact) } else { Collider::Body(other) },
            normal: contact.normal,
            impulse: if phase == Phase::End { Vec2::default() } else { self.impulse(contact) },
            sensor: contact.flags.has(Flags::SENSOR),
        }
    }

    fn tile_of(&self, contact: &Contact<S>) -> Collider {
        let [column, row] = terrain::tile(&self.tiles, contact);
        Collider::Tile(Tile { column, row, flags: self.tiles.flags(column, row) })
    }

    fn impulse(&self, contact: &Contact<S>) -> Vec2<S::Speed> {
        let mut impulse = contact.impulse;
        if contact.flags.has(Flags::BOUNCED) && !contact.has_parted() {
            let (a, b) = (usize::from(contact.a), usize::from(contact.b));
            let restitution = self.profiles[a].returns().lesser(self.profiles[b].returns());
            let [va, vb] = [a, b].map(|slot| self.after_bouncing(slot));
            let parting = S::speed_along(vb.saturating_sub(va), contact.normal);
            if parting > S::Speed::ZERO && restitution > S::Real::ZERO {
                let approach = S::over_mass(S::in_a_step(parting), restitution, 1);
                impulse.x = impulse.x.saturating_add(parting).saturating_add(approach);
            }
        }
        impulse
    }

    /// A body's velocity in the last step between bouncing and everything else.
    fn after_bouncing(&self, slot: usize) -> Vec2<S::Speed> {
        let body = &self.bodies[slot];
        // Static bodies and forces for the next step leave it nowhere: then the velocity after the step comes closest.
        if body.status.is_static() || body.marks.has(Marks::FORCED) { body.velocity } else { self.before[slot] }
    }
}
