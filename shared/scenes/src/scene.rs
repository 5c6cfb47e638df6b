//! A scene.

use core::ops::RangeInclusive;

use flat_physics::{BodyDef, Effects, Fixed, Level};
use heapless::Vec;

use crate::parameters::{Order, ParameterError, Parameters};
use crate::promise::Promise;

/// Promises of one scene.
pub type Promises = Vec<Promise, 6>;

/// A scene with a name.
#[derive(Debug)]
pub struct Scene {
    /// What it is called by.
    pub name: &'static str,
    /// What it is for, in one line.
    pub purpose: &'static str,
    /// What it calls for.
    pub effects: Effects,
    /// Steps of a usual run.
    pub steps: u32,
    /// Parameters of a usual run.
    pub defaults: Parameters,
    /// Rigid bodies that it can do.
    pub bodies: RangeInclusive<u16>,
    /// Bodies and contacts that it needs room for.
    pub capacity: fn(&Parameters) -> Capacity,
    pub(crate) body: fn(&Parameters, u16) -> BodyDef<Fixed>,
    pub(crate) promises: fn(&Parameters, Level) -> Promises,
}

/// Room in a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capacity {
    /// Bodies, static ones included.
    pub bodies: u16,
    /// Contacts in a step.
    pub contacts: u16,
}

impl Scene {
    /// Parameters for a run; what isn't given is the scene's default.
    ///
    /// # Errors
    /// A body count outside the scene's range.
    pub fn parameters(
        &self,
        bodies: Option<u16>,
        seed: Option<u32>,
        order: Order,
    ) -> Result<Parameters, ParameterError> {
        let bodies = bodies.unwrap_or(self.defaults.bodies);
        if !self.bodies.contains(&bodies) {
            return Err(ParameterError { scene: self.name, bodies, range: self.bodies.clone() });
        }
        Ok(Parameters { bodies, seed: seed.unwrap_or(self.defaults.seed), order })
    }

    /// The numbers of the bodies in the order of their insertion. In an empty world the n-th gets slot n.
    pub fn spawn_order(&self, parameters: &Parameters) -> impl Iterator<Item = u16> + use<> {
        let (parameters, total) = (*parameters, (self.capacity)(parameters).bodies);
        (0..total).map(move |place| parameters.nth(place, total))
    }

    /// The body of that number.
    pub fn body(&self, parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
        (self.body)(parameters, number)
    }

    /// What must hold at a level of accuracy.
    pub fn promises(&self, parameters: &Parameters, level: Level) -> Promises {
        (self.promises)(parameters, level)
    }
}
