//! From a scene to a world.

use core::fmt;

use flat_physics::{Config, Error, Level, Scalar, World};

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
    /// The settings were refused. The world is empty.
    Config {
        /// Why.
        error: Error<S>,
    },
    /// The tiles were refused. The world is empty.
    Tiles {
        /// Why.
        error: Error<S>,
    },
    /// A body was refused. The world is empty.
    Body {
        /// Its number.
        number: u16,
        /// Why.
        error: Error<S>,
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
            Self::Config { error } => write!(f, "settings: {error}"),
            Self::Tiles { error } => write!(f, "tiles: {error}"),
            Self::Body { number, error } => write!(f, "body {number}: {error}"),
        }
    }
}

impl<S: Scalar> core::error::Error for BuildError<S> {}

impl Scene {
    /// Replaces whatever is in the world by this scene, with a level's settings and the scene's gravity.
    ///
    /// # Errors
    /// [`BuildError::Capacity`] before anything changes; the others leave the world empty.
    pub fn build<S: Scalar>(
        &self,
        parameters: &Parameters,
        level: Level,
        world: &mut World<'_, S>,
    ) -> Result<(), BuildError<S>> {
        let needed = self.capacity(parameters, level);
        let available = Capacity { bodies: world.capacity(), contacts: world.contact_capacity() };
        if needed.bodies > available.bodies || needed.contacts > available.contacts {
            return Err(BuildError::Capacity { needed, available });
        }
        world.clear();
        let built = self.fill(parameters, level, world);
        if built.is_err() {
            world.clear();
        }
        built
    }

    fn fill<S: Scalar>(
        &self,
        parameters: &Parameters,
        level: Level,
        world: &mut World<'_, S>,
    ) -> Result<(), BuildError<S>> {
        let gravity = self.gravity(parameters).map(S::real);
        let configured = world.configure(Config { gravity, ..Config::at(level) });
        configured.and_then(|()| world.declare(self.effects)).map_err(|error| BuildError::Config { error })?;
        for number in self.spawn_order(parameters) {
            let def = self.body(parameters, number).convert();
            world.spawn(&def).map_err(|error| BuildError::Body { number, error })?;
        }
        match &self.tiles {
            None => Ok(()),
            Some(tiles) => tiles.lay(parameters, world).map_err(|error| BuildError::Tiles { error }),
        }
    }
}
