//! What users read of a world between steps.

use super::World;
use crate::body::{Body, BodyDef, Kind};
use crate::error::Error;
use crate::handle::Handle;
use crate::scalar::{Quantity, Scalar};
use crate::shape::Shape;
use crate::vec2::Vec2;

/// Counters of a world since it was last empty.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Steps done.
    pub steps: u32,
    /// Bodies present.
    pub bodies: u16,
    /// Contacts of the last step.
    pub contacts: u16,
    /// Most contacts of any step: what to size the storage by.
    pub contacts_peak: u16,
    /// Contacts that found no room, over all steps.
    pub contacts_lost: u32,
    /// Bodies that left the coordinate range and were disabled.
    pub escaped: u16,
    /// Velocity changes that were held at the speed limit, over all bodies and steps.
    pub saturations: u32,
}

/// A body's state, as read between steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyView<S: Scalar> {
    /// Its handle.
    pub handle: Handle,
    /// Centre, px.
    pub position: Vec2<S::Real>,
    /// Velocity, px per step; [`Scalar::px_per_second`] converts.
    pub velocity: Vec2<S::Speed>,
    /// What rounding the position has carried over to the next step: see [`Scalar::advance`].
    pub remainder: Vec2<i16>,
    /// What moves it.
    pub kind: Kind,
    /// Its shape.
    pub shape: Shape<S>,
    /// Whether it collides.
    pub visible: bool,
    /// Whether it takes part in physics. False once it has left the coordinate range.
    pub enabled: bool,
    /// Whether it sleeps.
    pub asleep: bool,
    /// Free for the user.
    pub user_data: u32,
}

/// A contact of the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactView<S: Scalar> {
    /// The two bodies; the first is rigid.
    pub bodies: [Handle; 2],
    /// Unit normal from the first to the second.
    pub normal: Vec2<S::Unit>,
    /// Overlap along the normal when it was detected, px, held at 100.
    pub penetration: S::Real,
    /// Change of relative velocity that the solver applied, px per step: along the normal (x) and the tangent (y).
    pub impulse: Vec2<S::Speed>,
}

impl<S: Scalar> World<'_, S> {
    /// A body's state.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`] if it is gone.
    pub fn body(&self, handle: Handle) -> Result<BodyView<S>, Error<S>> {
        let slot = self.slot(handle)?;
        Ok(self.view(slot as u16, &self.bodies[slot]))
    }

    /// Everything that can be set of a body, as it is now.
    ///
    /// Velocity is rounded to 2^-16 px/s and friction to 2^-15, which is how much a body spawned from it may differ.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`] if it is gone.
    pub fn definition(&self, handle: Handle) -> Result<BodyDef<S>, Error<S>> {
        let slot = self.slot(handle)?;
        Ok(BodyDef::of(&self.bodies[slot], &self.profiles[slot]))
    }

    /// All bodies, by ascending slot.
    pub fn bodies(&self) -> impl Iterator<Item = BodyView<S>> {
        self.bodies_from(0)
    }

    /// The bodies in a slot and those after it, by ascending slot: for reading them in parts.
    pub fn bodies_from(&self, slot: u16) -> impl Iterator<Item = BodyView<S>> {
        self.slots_from(slot).map(|(slot, body)| self.view(slot, body))
    }

    /// The contacts of the last step, in the order in which the solver took them.
    pub fn contacts(&self) -> impl Iterator<Item = ContactView<S>> {
        self.contacts_from(0)
    }

    /// The contacts of the last step without so many first ones: for reading them in parts.
    pub fn contacts_from(&self, place: u16) -> impl Iterator<Item = ContactView<S>> {
        let touching = self.pool.waking_and_asleep().filter(|contact| contact.touches());
        touching.skip(usize::from(place)).map(|contact| ContactView {
            bodies: [self.handle(contact.a), self.handle(contact.b)],
            normal: contact.normal,
            penetration: S::in_a_step(-contact.gap).greater(S::Real::ZERO),
            impulse: contact.impulse,
        })
    }

    /// Counters since the world was last empty.
    pub fn statistics(&self) -> Statistics {
        Statistics {
            steps: self.steps,
            bodies: self.count,
            contacts: self.pool.waking_and_asleep().filter(|contact| contact.touches()).count() as u16,
            contacts_peak: self.pool.peak,
            contacts_lost: self.pool.lost,
            escaped: self.escaped,
            saturations: self.saturations,
        }
    }

    /// The slots that hold a body, from one on.
    pub(crate) fn slots_from(&self, slot: u16) -> impl Iterator<Item = (u16, &Body<S>)> {
        let bodies = self.bodies.iter().skip(usize::from(slot));
        (slot..self.used).zip(bodies).filter(|(_, body)| body.status.is_taken())
    }

    /// All bodies, empty slots among them.
    pub(crate) fn slots(&self) -> &[Body<S>] {
        &self.bodies[..usize::from(self.used)]
    }

    fn view(&self, slot: u16, body: &Body<S>) -> BodyView<S> {
        BodyView {
            handle: self.handle(slot),
            position: body.position,
            velocity: body.velocity,
            remainder: body.remainder,
            kind: body.status.kind(),
            shape: body.shape(),
            visible: body.status.is_visible(),
            enabled: body.status.is_enabled(),
            asleep: body.is_asleep(),
            user_data: self.profiles[usize::from(slot)].user_data,
        }
    }
}
