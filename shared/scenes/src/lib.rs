//! Scenes with a name: what they are for, what they call for, what they promise. Tests, benchmarks, the harness and the devices
//! all build them from here.
//!
//! A scene is a pure function from [`Parameters`] and a body's number to that body's definition, in fixed point; other number
//! formats convert it. What it does while it runs is a script, called before each step with what the player holds down: see
//! [`Scene::direct`]. Each scene is one file in the catalogue; [`SCENES`] lists them.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod build;
mod buttons;
mod catalogue;
mod control;
mod hand;
mod parameters;
mod perturb;
mod promise;
mod scene;
mod script;
mod tiles;

pub use build::BuildError;
pub use buttons::{Buttons, Hold};
pub use parameters::{Mix, Order, ParameterError, Parameters, Takes, Turns, Variant};
pub use perturb::Battery;
pub use promise::{Promise, Shortfall};
pub use scene::{Capacity, Demo, Player, Promises, Scene};
pub use script::{Cue, Memory};

/// All built-in scenes.
pub static SCENES: &[Scene] = &[
    catalogue::drop::SCENE,
    catalogue::bounce::SCENE,
    catalogue::ball_pit::BALL_PIT,
    catalogue::ball_pit::BALL_PIT_OFFSET,
    catalogue::ball_pit::BALL_PIT_MIXED,
    catalogue::crate_columns::SCENE,
    catalogue::crate_columns::NAPS,
    catalogue::projectile::SCENE,
    catalogue::drift::SCENE,
    catalogue::terminal::SCENE,
    catalogue::cradle::CRADLE,
    catalogue::cradle::CHAINS,
    catalogue::slide::SLIDE,
    catalogue::slide::PIGGYBACK,
    catalogue::stack::STACK,
    catalogue::stack::HEAVY_TOP,
    catalogue::stack::ANVIL,
    catalogue::stack::FEATHER,
    catalogue::pyramid::SCENE,
    catalogue::anvil_drop::SCENE,
    catalogue::overlap::COINCIDENT,
    catalogue::overlap::OVERLAPPING,
    catalogue::heap::HEAP,
    catalogue::heap::ZIGZAG,
    catalogue::tight::WEDGE,
    catalogue::tight::TWO_PIXELS,
    catalogue::tight::TINY_AND_HUGE,
    catalogue::tight::SQUEEZED,
    catalogue::vice::VICE,
    catalogue::vice::CLAMP,
    catalogue::floating::SCENE,
    catalogue::beside::SCENE,
    catalogue::churn::SCENE,
    catalogue::kinematic::PUSH,
    catalogue::kinematic::LIFT,
    catalogue::kinematic::CRUSH,
    catalogue::shots::SCENE,
    catalogue::soak::SCENE,
    catalogue::tile_level::TILE_LEVEL,
    catalogue::tile_level::SEAMS,
    catalogue::tile_shots::SCENE,
    catalogue::platformer::SCENE,
    catalogue::ledges::SCENE,
    catalogue::tripwires::SCENE,
    catalogue::patrol::SCENE,
    catalogue::crumble::SCENE,
];

/// The scene of that name.
pub fn find(name: &str) -> Option<&'static Scene> {
    SCENES.iter().find(|scene| scene.name == name)
}
