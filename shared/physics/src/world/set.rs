//! Changing bodies between steps: everything that a definition says.
//!
//! Each setter checks what it is given as [`BodyDef::validate`](crate::BodyDef::validate) does; when it returns an error, nothing
//! has changed. Each wakes the body.

use super::World;
use crate::body::{self, BodyDef, Kind, Marks, Status};
use crate::effects::Effects;
use crate::error::Error;
use crate::handle::Handle;
use crate::material::Material;
use crate::pipeline::pairs;
use crate::scalar::Scalar;
use crate::shape::Shape;
use crate::variety::Variety;
use crate::vec2::Vec2;

impl<S: Scalar> World<'_, S> {
    /// Puts a body elsewhere, px, whatever is in between. Its velocity stays.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::OutOfRange`].
    pub fn set_position(&mut self, handle: Handle, position: Vec2<S::Real>) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        body::check_position(position)?;
        let body = &mut self.bodies[slot];
        let travel = position.saturating_sub(body.position);
        body.position = position;
        body.remainder = Vec2::default();
        self.moved(handle.slot, travel);
        Ok(())
    }

    /// Sets a body's velocity, px/s. It carries a kinematic body, whatever is in the way.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::OutOfRange`]: for static bodies the range is 0.
    pub fn set_velocity(&mut self, handle: Handle, velocity: Vec2<S::Real>) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        body::check_velocity(self.bodies[slot].status.kind(), velocity)?;
        self.accelerated(handle.slot, velocity.map(S::speed));
        Ok(())
    }

    /// Changes what moves a body. A body that becomes static stops. Its contacts end; those that it still has begin anew.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::Undeclared`]; [`Error::OtherVariety`].
    pub fn set_kind(&mut self, handle: Handle, kind: Kind) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        let was = self.bodies[slot].status.kind();
        if kind == was {
            return Ok(());
        }
        let def = BodyDef { kind, ..BodyDef::of(&self.bodies[slot], &self.profiles[slot]) };
        self.call_for(handle.slot, def.called_for(), def.variety())?;
        self.part_contacts(handle.slot);
        let body = &mut self.bodies[slot];
        body.status.set_kind(kind);
        body.marks = Marks::default();
        if kind == Kind::Static {
            body.velocity = Vec2::default();
            body.remainder = Vec2::default();
        }
        self.changed(kind == Kind::Static || was == Kind::Static);
        self.disturb(handle.slot);
        Ok(())
    }

    /// Gives a body another shape around the same centre.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::OutOfRange`] or [`Error::NotPositive`]; [`Error::OtherVariety`].
    pub fn set_shape(&mut self, handle: Handle, shape: Shape<S>) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        shape.validate()?;
        let round = matches!(shape, Shape::Circle { .. });
        self.turn_into(handle.slot, round, Variety::CIRCLES)?;
        let body = &mut self.bodies[slot];
        body.half = shape.half_extents();
        body.status.set(Status::CIRCLE, round);
        let is_static = body.status.is_static();
        self.changed(is_static);
        self.disturb(handle.slot);
        Ok(())
    }

    /// Sets a body's mass. Only rigid bodies make use of it.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::OutOfRange`] or [`Error::NotPositive`]; [`Error::OtherVariety`].
    pub fn set_mass(&mut self, handle: Handle, mass: S::Real) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        body::check_mass(mass)?;
        self.turn_into(handle.slot, mass != S::ONE && self.bodies[slot].status.is_rigid(), Variety::MASSES)?;
        self.profiles[slot].mass = mass;
        self.redefined(handle.slot);
        self.changed(false);
        Ok(())
    }

    /// Sets which multiple of gravity a rigid body feels.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::OutOfRange`]; [`Error::OtherVariety`].
    pub fn set_gravity_scale(&mut self, handle: Handle, scale: S::Real) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        body::check_gravity_scale(scale)?;
        self.turn_into(handle.slot, scale != S::ONE && self.bodies[slot].status.is_rigid(), Variety::GRAVITY_SCALES)?;
        self.profiles[slot].gravity_scale = scale;
        self.disturb(handle.slot);
        Ok(())
    }

    /// Gives a body another surface.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::OutOfRange`]; [`Error::Undeclared`].
    pub fn set_material(&mut self, handle: Handle, material: Material<S>) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        material.validate()?;
        self.call_for(handle.slot, material.called_for(), Variety::BOXES)?;
        self.profiles[slot].set_material(&material);
        self.redefined(handle.slot);
        Ok(())
    }

    /// Sets a body's restitution alone: see [`Material::restitution`].
    ///
    /// # Errors
    /// As [`set_material`](Self::set_material).
    pub fn set_restitution(&mut self, handle: Handle, restitution: S::Real) -> Result<(), Error<S>> {
        let material = self.profiles[self.slot(handle)?].material();
        self.set_material(handle, Material { restitution, ..material })
    }

    /// Sets whether a body bounces: see [`Material::bounce`].
    ///
    /// # Errors
    /// As [`set_material`](Self::set_material).
    pub fn set_bounce(&mut self, handle: Handle, bounce: bool) -> Result<(), Error<S>> {
        let material = self.profiles[self.slot(handle)?].material();
        self.set_material(handle, Material { bounce, ..material })
    }

    /// Sets a body's friction alone: see [`Material::friction`].
    ///
    /// # Errors
    /// As [`set_material`](Self::set_material).
    pub fn set_friction(&mut self, handle: Handle, friction: S::Real) -> Result<(), Error<S>> {
        let material = self.profiles[self.slot(handle)?].material();
        self.set_material(handle, Material { friction, ..material })
    }

    /// Sets the layers that a body is on.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`].
    pub fn set_layer(&mut self, handle: Handle, layer: u16) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        self.profiles[slot].layer = layer;
        self.regroup(handle.slot);
        Ok(())
    }

    /// Sets the layers that a body collides with.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`].
    pub fn set_mask(&mut self, handle: Handle, mask: u16) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        self.profiles[slot].mask = mask;
        self.regroup(handle.slot);
        Ok(())
    }

    /// Sets whether a body only notices what it touches.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::Undeclared`].
    pub fn set_sensor(&mut self, handle: Handle, sensor: bool) -> Result<(), Error<S>> {
        self.set_status(handle, Status::SENSOR, sensor, Effects::SENSORS)?;
        self.redefined(handle.slot);
        self.changed(false);
        Ok(())
    }

    /// Sets whether a body holds only what lands on it from above.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::Undeclared`].
    pub fn set_one_way(&mut self, handle: Handle, one_way: bool) -> Result<(), Error<S>> {
        self.set_status(handle, Status::ONE_WAY, one_way, Effects::ONE_WAY)?;
        self.redefined(handle.slot);
        Ok(())
    }

    /// Sets whether a body collides. A hidden one still moves.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`].
    pub fn set_visible(&mut self, handle: Handle, visible: bool) -> Result<(), Error<S>> {
        self.set_status(handle, Status::HIDDEN, !visible, Effects::NONE)?;
        self.changed(false);
        Ok(())
    }

    /// Sets whether a body takes part in physics. A body that left the coordinate range was disabled by the step; it can be
    /// enabled again.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`].
    pub fn set_enabled(&mut self, handle: Handle, enabled: bool) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        self.set_status(handle, Status::DISABLED, !enabled, Effects::NONE)?;
        self.changed(self.bodies[slot].status.is_static());
        Ok(())
    }

    /// Sets what the body carries for the user.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`].
    pub fn set_user_data(&mut self, handle: Handle, user_data: u32) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        self.profiles[slot].user_data = user_data;
        Ok(())
    }

    /// Notes what a body is from now on, if that is declared.
    fn turn_into(&mut self, slot: u16, is: bool, what: Variety) -> Result<(), Error<S>> {
        self.call_for(slot, Effects::NONE, if is { what } else { Variety::BOXES })
    }

    fn set_status(&mut self, handle: Handle, bit: u8, on: bool, calls_for: Effects) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        if on {
            self.call_for(handle.slot, calls_for, Variety::BOXES)?;
        }
        self.bodies[slot].status.set(bit, on);
        self.disturb(handle.slot);
        Ok(())
    }

    /// A body meets others than before.
    fn regroup(&mut self, slot: u16) {
        self.changed(false);
        self.disturb(slot);
    }

    /// What contacts take over from a body has changed.
    fn redefined(&mut self, slot: u16) {
        let Self { pool, bodies, profiles, .. } = self;
        for contact in pool.waking_and_asleep_mut() {
            if contact.is_of(slot) {
                pairs::define(contact, bodies, profiles, Effects::ALL);
            }
        }
        self.disturb(slot);
    }
}
