//! Forces and impulses.

use super::World;
use crate::body::Marks;
use crate::error::{Error, Field, check};
use crate::handle::Handle;
use crate::scalar::{Quantity, STEP_HZ, Scalar};
use crate::vec2::Vec2;

/// Largest component of a force or an impulse.
const PUSH_LIMIT: i16 = i16::MAX;

impl<S: Scalar> World<'_, S> {
    /// Changes a rigid body's velocity at once, by `impulse / mass`.
    ///
    /// `impulse` is in px/s times mass, each component within +-32767. The velocity is held within
    /// [`SPEED_LIMIT`](crate::scalar::SPEED_LIMIT).
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::NotRigid`]; [`Error::OutOfRange`]. Nothing changes then.
    pub fn apply_impulse(&mut self, handle: Handle, impulse: Vec2<S::Real>) -> Result<(), Error<S>> {
        let slot = self.rigid(handle)?;
        check(Field::ImpulseX, impulse.x, -PUSH_LIMIT, PUSH_LIMIT)?;
        check(Field::ImpulseY, impulse.y, -PUSH_LIMIT, PUSH_LIMIT)?;
        let mass = self.profiles[usize::from(slot)].mass;
        let change = impulse.map(|component| S::over_mass(component, mass, STEP_HZ));
        let velocity = self.bodies[usize::from(slot)].velocity.saturating_add(change);
        self.accelerated(slot, velocity);
        Ok(())
    }

    /// Pushes a rigid body during the next step: it accelerates by `force / mass`, as by gravity. Forces add up.
    ///
    /// `force` is in px/s2 times mass, each component within +-32767. What several add to the velocity in a step is held within
    /// the range of the number format.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::NotRigid`]; [`Error::OutOfRange`]. Nothing changes then.
    pub fn apply_force(&mut self, handle: Handle, force: Vec2<S::Real>) -> Result<(), Error<S>> {
        let slot = self.rigid(handle)?;
        check(Field::ForceX, force.x, -PUSH_LIMIT, PUSH_LIMIT)?;
        check(Field::ForceY, force.y, -PUSH_LIMIT, PUSH_LIMIT)?;
        let mass = self.profiles[usize::from(slot)].mass;
        let change = force.map(|component| S::over_mass(component, mass, STEP_HZ * STEP_HZ));
        self.disturb(slot);
        let marks = &mut self.bodies[usize::from(slot)].marks;
        // Between steps, nobody needs the velocities from the start of one.
        let pending = &mut self.before[usize::from(slot)];
        *pending = if marks.has(Marks::FORCED) { pending.saturating_add(change) } else { change };
        marks.set(Marks::FORCED);
        Ok(())
    }

    /// Gives a body a velocity, held within the speed limit.
    pub(super) fn accelerated(&mut self, slot: u16, velocity: Vec2<S::Speed>) {
        let velocity = velocity.map(|component| component.held(S::FASTEST));
        self.bodies[usize::from(slot)].velocity = velocity;
        // Contacts reach as far as bodies can come in a step.
        self.fastest = self.fastest.greater(velocity.x.abs()).greater(velocity.y.abs());
        self.disturb(slot);
    }

    /// The slot of a rigid body.
    fn rigid(&self, handle: Handle) -> Result<u16, Error<S>> {
        let slot = self.slot(handle)?;
        if self.bodies[slot].status.is_rigid() { Ok(handle.slot) } else { Err(Error::NotRigid { handle }) }
    }
}
