//! One scenario with the parameters that it is to run with.

use std::fmt::Display;

use flat_physics::Level;
use flat_scenes::{Parameters, Scene};
use flat_wire::message::{ScalarKind, SceneRequest};

use crate::cli::RunArgs;
use crate::error::Error;
use crate::report;

/// What to run.
#[derive(Debug)]
pub struct Job {
    /// The scene.
    pub scene: &'static Scene,
    /// The scene's parameters.
    pub parameters: Parameters,
    /// The same for a device, and how to compute.
    pub request: SceneRequest,
    /// The level that promises are made for.
    pub level: Level,
    /// Steps to run.
    pub steps: u32,
}

impl Job {
    /// The job that the command line asks for.
    ///
    /// # Errors
    /// If the scene doesn't take the parameters.
    pub fn new(scene: &'static Scene, arguments: &RunArgs) -> Result<Self, Error> {
        let wrong = |error: &dyn Display| Error::usage(format!("{}: {error}", scene.name), "cargo rig run --list");
        let order = arguments.order;
        let parameters = scene
            .parameters(arguments.bodies, arguments.seed, order.into())
            .map_err(|error| Error::usage(error.to_string(), "cargo rig run --list"))?;
        let steps = arguments.steps.unwrap_or(scene.steps);
        let scalar = arguments.scalar.into();
        if let Some(flip) = arguments.flip {
            let bits = if scalar == ScalarKind::F64 { 64 } else { 32 };
            if flip.point.step > steps {
                return Err(wrong(&format!("--flip at step {} is past the last step, {steps}", flip.point.step)));
            }
            if flip.bit >= bits {
                return Err(wrong(&format!("--flip of bit {}: a velocity has {bits} bits, from 0 on", flip.bit)));
            }
        }
        let request = SceneRequest {
            name: scene.name.try_into().map_err(|_| wrong(&"the name is too long for the protocol"))?,
            bodies: Some(parameters.bodies),
            seed: Some(parameters.seed),
            order: order.into(),
            level: arguments.level.into(),
            scalar,
        };
        Ok(Self { scene, parameters, request, level: arguments.level.into(), steps })
    }

    /// The parameters for the report.
    pub fn reported(&self) -> report::Parameters {
        report::Parameters {
            bodies: self.parameters.bodies,
            seed: self.parameters.seed,
            order: self.request.order,
            level: self.request.level,
            scalar: self.request.scalar,
        }
    }
}
