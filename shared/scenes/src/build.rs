//! From a scene to a world.

use core::fmt;

use flat_physics::{Effects, Error, Scalar, World};

use crate::parameters::Parameters;
use crate::scene::{Capacity, Scene};

/// Why a scene could not be built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BuildError<S: Scalar> {
    /// The world is too small. It is as it was.
    Capacity {
        /// What the scene needs.
        needed: Capacity,
        /// What the world has.
        available: Capacity,
    },
    /// A body was refused. The world is empty.
    Body {
        /// Its number.
        number: u16,
        /// Why.
        error: Error<S>,
    },
    /// A body needs an effect that the scene does not call for. The world is empty.
    Effect {
        /// Its number.
        number: u16,
        /// The effect.
        missing: Effects,
    },
}

impl<S: Scalar> fmt::Display for BuildError<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Capacity { needed, available } => write!(
                f,
                "needs {} bodies and {} contacts, there is room for {} and {}",
                needed.bodies, needed.contacts, available.bodies, available.contacts
            ),
            Self::Body { number, error } => write!(f, "body {number}: {error}"),
            Self::Effect { number, missing } => {
                write!(f, "body {number} needs {missing}, which the scene does not call for")
            }
        }
    }
}

impl<S: Scalar> core::error::Error for BuildError<S> {}

impl Scene {
    /// Replaces whatever is in the world by this scene.
    ///
    /// # Errors
    /// [`BuildError::Capacity`] before anything changes; the others leave the world empty.
    pub fn build<S: Scalar>(&self, parameters: &Parameters, world: &mut World<'_, S>) -> Result<(), BuildError<S>> {
        let needed = (self.capacity)(parameters);
        let available = Capacity { bodies: world.capacity(), contacts: world.contact_capacity() };
        if needed.bodies > available.bodies || needed.contacts > available.contacts {
            return Err(BuildError::Capacity { needed, available });
        }
        world.clear();
        for number in self.spawn_order(parameters) {
            let def = self.body(parameters, number).convert();
            let missing = def.called_for().without(self.effects);
            let refused = if missing == Effects::NONE {
                world.spawn(&def).err().map(|error| BuildError::Body { number, error })
            } else {
                Some(BuildError::Effect { number, missing })
            };
            if let Some(error) = refused {
                world.clear();
                return Err(error);
            }
        }
        Ok(())
    }
}
