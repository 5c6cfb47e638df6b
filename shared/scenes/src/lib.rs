//! Scenes with a name: what they are for, what they call for, what they promise. Tests, benchmarks, the harness and the devices
//! all build them from here.
//!
//! A scene is a pure function from [`Parameters`] and a body's number to that body's definition, in fixed point; other number
//! formats convert it. Each scene is one file in the catalogue; [`SCENES`] lists them.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod build;
mod catalogue;
mod parameters;
mod promise;
mod scene;

pub use build::BuildError;
pub use parameters::{Order, ParameterError, Parameters};
pub use promise::Promise;
pub use scene::{Capacity, Promises, Scene};

/// All built-in scenes.
pub static SCENES: &[Scene] =
    &[catalogue::drop::SCENE, catalogue::bounce::SCENE, catalogue::ball_pit::SCENE, catalogue::crate_columns::SCENE];

/// The scene of that name.
pub fn find(name: &str) -> Option<&'static Scene> {
    SCENES.iter().find(|scene| scene.name == name)
}
