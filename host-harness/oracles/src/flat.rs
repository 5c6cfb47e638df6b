//! flat itself, at its default level: the same program, compiled by the same compiler, for the same counter.

use flat_physics::{Effects, Level, Scalar, Storage, World, step};
use flat_scenes::{Parameters, Scene};

use crate::engine::Engine;

const BODIES: usize = 1024;
const CONTACTS: usize = 8192;

/// A world and what its scene calls for.
pub struct Flat<S: Scalar> {
    world: World<'static, S>,
    effects: Effects,
}

impl<S: Scalar> Flat<S> {
    /// Builds the scene.
    ///
    /// # Errors
    /// In words, if it has no room.
    pub fn new(scene: &Scene, parameters: &Parameters) -> Result<Self, String> {
        // There is one world for the rest of the program: the engine borrows its storage.
        let storage: &'static mut Storage<S, BODIES, CONTACTS> = Box::leak(Box::new(Storage::new()));
        let mut world = storage.world();
        scene.build(parameters, Level::Grounded, &mut world).map_err(|error| format!("{}: {error}", scene.name))?;
        Ok(Self { world, effects: scene.effects })
    }
}

impl<S: Scalar> Engine for Flat<S> {
    fn step(&mut self) {
        step(&mut self.world, self.effects);
    }
}
