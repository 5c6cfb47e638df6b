//! What a scene does to its world while it runs: before each step, by the parameters, the step and the player.

use fixed::types::I16F16;
use flat_physics::{Collider, Error, Scalar, Vec2, World};

use crate::buttons::{Buttons, Hold};
use crate::control::Control;
use crate::hand::Hand;
use crate::parameters::Parameters;
use crate::scene::Scene;

/// Called before each step.
pub(crate) type Script = fn(&Parameters, Moment, &mut dyn Control);

/// When a scene is directed, and what the player does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cue {
    /// The step to come, counted from 1.
    pub step: u32,
    /// What the player holds down; none = nobody plays, and the scene plays by itself.
    pub buttons: Option<Buttons>,
}

impl Cue {
    /// A step of a scene that nobody plays.
    pub const fn unattended(step: u32) -> Self {
        Self { step, buttons: None }
    }
}

/// What a script is told of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    /// The step to come, counted from 1.
    pub(crate) step: u32,
    /// What is held down, by whoever plays.
    pub(crate) buttons: Buttons,
}

/// What a script keeps from step to step besides the world: how its player moves. New whenever the scene is built.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Memory {
    /// The player's velocity, px/s.
    pub(crate) velocity: Vec2<I16F16>,
    /// What the player stands on, and where it stands there, px.
    pub(crate) footing: Option<(Collider, Vec2<I16F16>)>,
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
        memory: &mut Memory,
        world: &mut World<'_, S>,
    ) -> Result<(), Error<S>> {
        let Some(script) = self.script else {
            return Ok(());
        };
        let by_itself = || self.demo.map_or(Buttons::IDLE, |demo| Hold::at(demo.holds, cue.step));
        let moment = Moment { step: cue.step, buttons: cue.buttons.unwrap_or_else(by_itself) };
        let mut hand = Hand { scene: self, parameters, memory, world, refused: None };
        script(parameters, moment, &mut hand);
        hand.refused.map_or(Ok(()), Err)
    }
}
