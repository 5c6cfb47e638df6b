//! What is looked up of a body once per pair or per step.

use ::fixed::types::I16F16;

use super::BodyDef;
use crate::material::Material;
use crate::pipeline::sleep;
use crate::scalar::{Quantity, Scalar};

/// Properties of a body that the stages look up once per pair or per step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Profile<S: Scalar> {
    pub(crate) mass: S::Real,
    pub(crate) gravity_scale: S::Real,
    /// What the surface would return if it bounced.
    pub(crate) restitution: S::Real,
    pub(crate) user_data: u32,
    /// In 1/32768.
    pub(crate) friction: u16,
    pub(crate) layer: u16,
    pub(crate) mask: u16,
    /// Counts the bodies that the slot has held.
    pub(crate) generation: u16,
    /// Next free slot, plus 1; 0 = none.
    pub(crate) next_free: u16,
    pub(crate) bounce: bool,
    /// For how many steps the body has been at rest; all ones in an island that sleeps.
    pub(crate) rest: u8,
}

impl<S: Scalar> Profile<S> {
    pub(crate) const EMPTY: Self = Self {
        mass: S::Real::ZERO,
        gravity_scale: S::Real::ZERO,
        restitution: S::Real::ZERO,
        user_data: 0,
        friction: 0,
        layer: 0,
        mask: 0,
        generation: 0,
        next_free: 0,
        bounce: false,
        rest: 0,
    };

    /// Takes over everything but what belongs to the slot.
    pub(crate) fn define(&mut self, def: &BodyDef<S>) {
        *self = Self {
            mass: def.mass,
            gravity_scale: def.gravity_scale,
            user_data: def.user_data,
            layer: def.layer,
            mask: def.mask,
            generation: self.generation,
            // If the slot's last body slept, its island has yet to wake.
            rest: if self.rest == sleep::ASLEEP { sleep::ASLEEP } else { 0 },
            ..Self::EMPTY
        };
        self.set_material(&def.material);
    }

    pub(crate) fn set_material(&mut self, material: &Material<S>) {
        self.restitution = material.restitution;
        self.bounce = material.bounce;
        self.friction = S::coefficient(material.friction);
    }

    pub(crate) fn material(&self) -> Material<S> {
        let friction = S::real(I16F16::from_bits(i32::from(self.friction) << 1));
        Material { restitution: self.restitution, bounce: self.bounce, friction }
    }

    /// What the surface returns. A body that doesn't bounce returns nothing: the lesser of a pair is then 0, as the pair rule
    /// wants.
    pub(crate) fn returns(&self) -> S::Real {
        if self.bounce { self.restitution } else { S::Real::ZERO }
    }

    #[inline]
    pub(crate) fn meets(&self, other: &Self) -> bool {
        (self.mask & other.layer) | (other.mask & self.layer) != 0
    }
}
