//! One scenario with the parameters that it is to run with.

use std::fmt::Display;

use flat_physics::Effects;
use flat_rig::variant::{self, VariantArgs};
use flat_scenes::{Parameters, Player, SCENES, Scene};
use flat_wire::message::{Order, ScalarKind, SceneRequest};

use crate::cli::{MOST_STEPS, OrderArg, RunArgs};
use crate::error::Error;
use crate::input::Inputs;
use crate::report;
use crate::setting::Setting;

/// What to run.
#[derive(Debug)]
pub struct Job {
    /// The scene.
    pub scene: &'static Scene,
    /// The scene's parameters.
    pub parameters: Parameters,
    /// The same for a device, and how to compute.
    pub request: SceneRequest,
    /// What the player does; none = the scene plays by itself.
    pub inputs: Option<Inputs>,
    /// Steps to run.
    pub steps: u32,
}

/// What a scene may be varied by; none = the scene's.
#[derive(Clone, Copy, Debug, Default)]
pub struct Choice {
    /// Bodies.
    pub bodies: Option<u16>,
    /// Seed of the scene's random numbers.
    pub seed: Option<u32>,
    /// Order of insertion.
    pub order: OrderArg,
    /// Steps to run.
    pub steps: Option<u32>,
    /// Departures from the scene as it is written.
    pub variant: VariantArgs,
}

impl Job {
    /// The jobs that the command line asks for: one, or one for each perturbation.
    ///
    /// # Errors
    /// If the scene doesn't take the parameters.
    pub fn all(scene: &'static Scene, arguments: &RunArgs) -> Result<Vec<Self>, Error> {
        if !arguments.perturbed {
            return Ok(vec![Self::new(scene, arguments)?]);
        }
        let steps = arguments.steps.unwrap_or(scene.battery_steps());
        scene.battery().into_iter().map(|parameters| Self::with(scene, parameters, steps, &arguments.setting)).collect()
    }

    fn new(scene: &'static Scene, arguments: &RunArgs) -> Result<Self, Error> {
        let RunArgs { bodies, seed, order, steps, variant, .. } = *arguments;
        let mut job = Self::of(scene, Choice { bodies, seed, order, steps, variant }, &arguments.setting)?;
        if let Some(inputs) = &arguments.input {
            job.play(inputs.clone(), steps)?;
        }
        if let Some(flip) = arguments.flip {
            let bits = if job.request.scalar == ScalarKind::F64 { 64 } else { 32 };
            let steps = job.steps;
            if flip.point.step > steps {
                return Err(wrong(
                    scene,
                    &format!("--flip at step {} is past the last step, {steps}", flip.point.step),
                ));
            }
            if flip.bit >= bits {
                return Err(wrong(
                    scene,
                    &format!("--flip of bit {}: a velocity has {bits} bits, from 0 on", flip.bit),
                ));
            }
        }
        Ok(job)
    }

    /// A scene with some choices made, computed in some way.
    ///
    /// # Errors
    /// If the scene doesn't take the parameters.
    pub fn of(scene: &'static Scene, choice: Choice, setting: &Setting) -> Result<Self, Error> {
        let parameters = scene
            .parameters(choice.bodies, choice.seed, choice.order.into())
            .and_then(|parameters| scene.vary(parameters, choice.variant.into()))
            .map_err(|error| Error::usage(error.to_string(), "cargo rig run --list"))?;
        Self::with(scene, parameters, choice.steps.unwrap_or(scene.steps), setting)
    }

    fn with(scene: &'static Scene, parameters: Parameters, steps: u32, setting: &Setting) -> Result<Self, Error> {
        let request = SceneRequest {
            name: scene.name.try_into().map_err(|_| wrong(scene, &"the name is too long for the protocol"))?,
            bodies: Some(parameters.bodies),
            seed: Some(parameters.seed),
            order: match parameters.order {
                flat_scenes::Order::Forward => Order::Forward,
                flat_scenes::Order::Reverse => Order::Reverse,
                flat_scenes::Order::Shuffled => Order::Shuffled,
            },
            level: setting.level.into(),
            scalar: setting.scalar.into(),
            iterations: setting.iterations,
            effects: setting.effects.map(Effects::bits),
            variant: variant::requested(&parameters.variant),
        };
        Ok(Self { scene, parameters, request, inputs: None, steps })
    }

    /// Lets a player play, for as long as its inputs last unless there is a number of steps.
    fn play(&mut self, inputs: Inputs, steps: Option<u32>) -> Result<(), Error> {
        if self.scene.demo.is_none() {
            let players = SCENES.iter().filter(|scene| scene.demo.is_some()).map(|scene| scene.name);
            return Err(Error::usage(
                format!("{}: --input, but the scene has no player", self.scene.name),
                format!("one that has: {}", players.collect::<Vec<_>>().join(", ")),
            ));
        }
        self.steps = steps.unwrap_or(inputs.steps());
        if self.steps < inputs.steps() || i64::from(self.steps) > MOST_STEPS {
            let (scene, lasting, run) = (self.scene, inputs.steps(), self.steps.min(MOST_STEPS as u32));
            return Err(wrong(scene, &format!("--input lasts {lasting} steps, the run {run}")));
        }
        self.inputs = Some(inputs);
        Ok(())
    }

    /// Who plays.
    pub fn player(&self) -> Player {
        if self.inputs.is_some() { Player::Host } else { Player::Demo }
    }

    /// The options that ask for it, without those that are the scene's defaults anyway.
    pub fn options(&self) -> Vec<String> {
        let inputs = self.inputs.iter().flat_map(|inputs| ["--input".to_owned(), inputs.to_string()]);
        inputs.chain(variant::options(self.scene, &self.parameters)).collect()
    }

    /// The parameters for the report.
    pub fn reported(&self) -> report::Parameters {
        report::Parameters {
            bodies: self.parameters.bodies,
            seed: self.parameters.seed,
            order: self.request.order,
            level: self.request.level,
            scalar: self.request.scalar,
            options: shell_words::join(self.options()),
        }
    }
}

fn wrong(scene: &Scene, error: &dyn Display) -> Error {
    Error::usage(format!("{}: {error}", scene.name), "cargo rig run --list")
}
