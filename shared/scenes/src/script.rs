//! What a scene does to its world while it runs: before each step, a pure function of the parameters and the step.

use fixed::types::I16F16;
use flat_physics::{Error, Handle, Scalar, Vec2, World};

use crate::parameters::Parameters;
use crate::scene::Scene;

/// Called before each step.
pub(crate) type Script = fn(&Parameters, Cue, &mut dyn Control);

/// When a script is called, and what the player does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cue {
    /// The step to come, counted from 1.
    pub step: u32,
    /// What the player holds down: left, right, jump, down, a bit each, from the lowest.
    pub buttons: u8,
}

/// What a script can do, by the bodies' numbers and in the scene's own coordinates.
pub(crate) trait Control {
    /// Gives a body another velocity, px/s.
    fn set_velocity(&mut self, number: u16, velocity: Vec2<I16F16>);
    /// Puts a body elsewhere, px.
    fn set_position(&mut self, number: u16, position: Vec2<I16F16>);
    /// Removes a body and puts it back as the scene defines it.
    fn replace(&mut self, number: u16);
}

impl Scene {
    /// Does what the scene does before a step; [`build`](Self::build) comes before the first.
    ///
    /// # Errors
    /// The first thing that the world refused; the rest was done.
    pub fn direct<S: Scalar>(
        &self,
        parameters: &Parameters,
        cue: Cue,
        world: &mut World<'_, S>,
    ) -> Result<(), Error<S>> {
        let Some(script) = self.script else {
            return Ok(());
        };
        let mut hand = Hand { scene: self, parameters, world, refused: None };
        script(parameters, cue, &mut hand);
        hand.refused.map_or(Ok(()), Err)
    }
}

/// Turns what a script says into what the world understands.
struct Hand<'h, 'w, S: Scalar> {
    scene: &'h Scene,
    parameters: &'h Parameters,
    world: &'h mut World<'w, S>,
    refused: Option<Error<S>>,
}

impl<'w, S: Scalar> Hand<'_, 'w, S> {
    /// The body of that number: its user data says so.
    fn find(&self, number: u16) -> Option<Handle> {
        self.world.bodies().find(|body| body.user_data == u32::from(number)).map(|body| body.handle)
    }

    /// Does something to a body, if it is there.
    fn with(&mut self, number: u16, act: impl FnOnce(&mut World<'w, S>, Handle) -> Result<(), Error<S>>) {
        if let Some(handle) = self.find(number) {
            let outcome = act(self.world, handle);
            self.note(outcome);
        }
    }

    fn note(&mut self, outcome: Result<(), Error<S>>) {
        self.refused = self.refused.or(outcome.err());
    }
}

impl<S: Scalar> Control for Hand<'_, '_, S> {
    fn set_velocity(&mut self, number: u16, velocity: Vec2<I16F16>) {
        let velocity = self.parameters.variant.turn(velocity).map(S::real);
        self.with(number, |world, handle| world.set_velocity(handle, velocity));
    }

    fn set_position(&mut self, number: u16, position: Vec2<I16F16>) {
        let position = self.parameters.variant.place(position).map(S::real);
        self.with(number, |world, handle| world.set_position(handle, position));
    }

    fn replace(&mut self, number: u16) {
        // The slot that is given back first is taken first: the body keeps its slot.
        self.with(number, World::despawn);
        let def = self.scene.body(self.parameters, number).convert();
        let back = self.world.spawn(&def).map(|_| ());
        self.note(back);
    }
}
