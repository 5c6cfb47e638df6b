//! The world: bodies, contacts and settings, on storage that somebody else owns.

use crate::body::{Body, BodyDef, Profile};
use crate::config::Config;
use crate::contact::{Contact, Pool};
use crate::effects::Effects;
use crate::error::Error;
use crate::handle::Handle;
use crate::pipeline::broadphase::Layers;
use crate::scalar::{Quantity, Scalar};
use crate::vec2::Vec2;

/// Room for a world: at most `BODIES` bodies and `CONTACTS` contacts a step. All zeros when new, so a static one costs no flash.
#[derive(Debug)]
pub struct Storage<S: Scalar, const BODIES: usize, const CONTACTS: usize> {
    bodies: [Body<S>; BODIES],
    profiles: [Profile<S>; BODIES],
    contacts: [Contact<S>; CONTACTS],
    /// Scratch lists of the broadphase.
    lists: [[u16; BODIES]; 6],
}

impl<S: Scalar, const BODIES: usize, const CONTACTS: usize> Storage<S, BODIES, CONTACTS> {
    /// Empty storage.
    pub const fn new() -> Self {
        const { assert!(BODIES < u16::MAX as usize && CONTACTS <= u16::MAX as usize, "slots are 16-bit numbers") };
        Self {
            bodies: [Body::EMPTY; BODIES],
            profiles: [Profile::EMPTY; BODIES],
            contacts: [Contact::EMPTY; CONTACTS],
            lists: [[0; BODIES]; 6],
        }
    }

    /// An empty world with default settings on this storage; whatever an earlier one held is gone.
    pub fn world(&mut self) -> World<'_, S> {
        let [dynamics, links, candidates, statics, entries @ ..] = &mut self.lists;
        let mut world = World {
            config: Config::default(),
            gravity: Vec2::default(),
            bounce_threshold: S::Speed::ZERO,
            bodies: &mut self.bodies,
            profiles: &mut self.profiles,
            pool: Pool::new(&mut self.contacts),
            layers: Layers::new(dynamics, links, candidates, statics, entries.as_flattened_mut()),
            used: 0,
            free: 0,
            count: 0,
            called_for: Effects::NONE,
            steps: 0,
            escaped: 0,
            saturations: 0,
        };
        world.clear();
        world
    }
}

impl<S: Scalar, const BODIES: usize, const CONTACTS: usize> Default for Storage<S, BODIES, CONTACTS> {
    fn default() -> Self {
        Self::new()
    }
}

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
    /// False once it has left the coordinate range.
    pub enabled: bool,
    /// What the definition said.
    pub user_data: u32,
}

/// A contact of the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactView<S: Scalar> {
    /// The two bodies; the first is rigid.
    pub bodies: [Handle; 2],
    /// Unit normal from the first to the second.
    pub normal: Vec2<S::Unit>,
    /// Overlap along the normal when it was detected, px.
    pub penetration: S::Real,
    /// Change of relative velocity that the solver applied, px per step: along the normal (x) and the tangent (y).
    pub impulse: Vec2<S::Speed>,
}

/// Bodies, contacts and settings of one world.
#[derive(Debug)]
pub struct World<'a, S: Scalar> {
    pub(crate) config: Config<S>,
    /// Velocity that gravity adds in a step.
    pub(crate) gravity: Vec2<S::Speed>,
    pub(crate) bounce_threshold: S::Speed,
    pub(crate) bodies: &'a mut [Body<S>],
    pub(crate) profiles: &'a mut [Profile<S>],
    pub(crate) pool: Pool<'a, S>,
    pub(crate) layers: Layers<'a>,
    /// Slots below this have held a body since the world was last empty.
    used: u16,
    /// First free slot below `used`, plus 1; 0 = none.
    free: u16,
    count: u16,
    called_for: Effects,
    pub(crate) steps: u32,
    pub(crate) escaped: u16,
    pub(crate) saturations: u32,
}

impl<S: Scalar> World<'_, S> {
    /// Removes all bodies, resets all counters and settings.
    pub fn clear(&mut self) {
        for (body, profile) in self.bodies.iter_mut().zip(self.profiles.iter_mut()) {
            if body.status.is_taken() {
                body.status = Body::<S>::EMPTY.status;
                profile.generation = profile.generation.wrapping_add(1);
            }
        }
        self.pool.reset();
        self.layers.dynamics_changed();
        self.layers.statics_changed();
        (self.used, self.free, self.count) = (0, 0, 0);
        self.called_for = Effects::NONE;
        (self.steps, self.escaped, self.saturations) = (0, 0, 0);
        self.apply(Config::default());
    }

    /// Adds a body.
    ///
    /// # Errors
    /// [`Error::Full`] if all slots are taken; what [`BodyDef::validate`] finds. Nothing changes then.
    pub fn spawn(&mut self, def: &BodyDef<S>) -> Result<Handle, Error<S>> {
        def.validate()?;
        let slot = if self.free != 0 {
            self.free - 1
        } else if usize::from(self.used) < self.bodies.len() {
            self.used
        } else {
            return Err(Error::Full { capacity: self.capacity() });
        };
        let profile = &mut self.profiles[usize::from(slot)];
        if self.free != 0 {
            self.free = profile.next_free;
        } else {
            self.used += 1;
        }
        profile.define(def);
        let body = Body::new(def);
        self.bodies[usize::from(slot)] = body;
        self.count += 1;
        self.called_for = self.called_for | def.called_for();
        self.changed(body.status.is_static());
        Ok(self.handle(slot))
    }

    /// Removes a body.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`] if it is gone already.
    pub fn despawn(&mut self, handle: Handle) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        let was_static = self.bodies[slot].status.is_static();
        self.bodies[slot] = Body::EMPTY;
        let profile = &mut self.profiles[slot];
        profile.generation = profile.generation.wrapping_add(1);
        profile.next_free = self.free;
        self.free = handle.slot + 1;
        self.count -= 1;
        self.pool.forget(handle.slot);
        self.changed(was_static);
        Ok(())
    }

    /// A body's state.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`] if it is gone.
    pub fn body(&self, handle: Handle) -> Result<BodyView<S>, Error<S>> {
        let slot = self.slot(handle)?;
        Ok(self.view(slot as u16, &self.bodies[slot]))
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
        self.pool.all().iter().skip(usize::from(place)).map(|contact| ContactView {
            bodies: [self.handle(contact.a), self.handle(contact.b)],
            normal: contact.normal,
            penetration: contact.penetration,
            impulse: contact.impulse,
        })
    }

    /// Settings in force.
    pub fn config(&self) -> &Config<S> {
        &self.config
    }

    /// Replaces the settings.
    ///
    /// # Errors
    /// What [`Config::validate`] finds; the old settings then stay.
    pub fn configure(&mut self, config: Config<S>) -> Result<(), Error<S>> {
        config.validate()?;
        self.apply(config);
        Ok(())
    }

    /// The effects without which the bodies and settings would not do what they say.
    pub fn called_for(&self) -> Effects {
        let gravity = self.gravity != Vec2::default();
        self.called_for | if gravity { Effects::GRAVITY } else { Effects::NONE }
    }

    /// Counters since the world was last empty.
    pub fn statistics(&self) -> Statistics {
        Statistics {
            steps: self.steps,
            bodies: self.count,
            contacts: self.pool.all().len() as u16,
            contacts_peak: self.pool.peak,
            contacts_lost: self.pool.lost,
            escaped: self.escaped,
            saturations: self.saturations,
        }
    }

    /// Most bodies.
    pub fn capacity(&self) -> u16 {
        self.bodies.len() as u16
    }

    /// Most contacts in a step.
    pub fn contact_capacity(&self) -> u16 {
        self.pool.capacity()
    }

    /// Fault injection: inverts one bit of a body's horizontal velocity, 0..32 (`f64`: 0..64). For proving that a comparison would notice.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`] if the slot is empty.
    pub fn flip_velocity_bit(&mut self, slot: u16, bit: u8) -> Result<(), Error<S>> {
        let handle = Handle { slot, generation: self.profiles.get(usize::from(slot)).map_or(0, |p| p.generation) };
        let slot = self.slot(handle)?;
        let velocity = &mut self.bodies[slot].velocity.x;
        *velocity = S::speed_from_bits(velocity.bits() ^ 1i64.wrapping_shl(bit.into()));
        Ok(())
    }

    /// The slots that hold a body, from one on.
    pub(crate) fn slots_from(&self, slot: u16) -> impl Iterator<Item = (u16, &Body<S>)> {
        let bodies = self.bodies.iter().skip(usize::from(slot));
        (slot..self.used).zip(bodies).filter(|(_, body)| body.status.is_taken())
    }

    fn apply(&mut self, config: Config<S>) {
        self.gravity = config.gravity.map(S::acceleration);
        self.bounce_threshold = config.bounce_threshold();
        self.config = config;
    }

    fn changed(&mut self, is_static: bool) {
        if is_static {
            self.layers.statics_changed();
        } else {
            self.layers.dynamics_changed();
        }
    }

    fn handle(&self, slot: u16) -> Handle {
        Handle { slot, generation: self.profiles[usize::from(slot)].generation }
    }

    fn slot(&self, handle: Handle) -> Result<usize, Error<S>> {
        let slot = usize::from(handle.slot);
        let present = handle.slot < self.used
            && self.bodies[slot].status.is_taken()
            && self.profiles[slot].generation == handle.generation;
        if present { Ok(slot) } else { Err(Error::NoSuchBody { handle }) }
    }

    fn view(&self, slot: u16, body: &Body<S>) -> BodyView<S> {
        BodyView {
            handle: self.handle(slot),
            position: body.position,
            velocity: body.velocity,
            remainder: body.remainder,
            enabled: body.status.is_enabled(),
            user_data: self.profiles[usize::from(slot)].user_data,
        }
    }
}
