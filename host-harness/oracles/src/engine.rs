//! What every engine can do here, and how a scene looks to engines that count in metres.

use fixed::types::I16F16;
use flat_physics::{BodyDef, Fixed, Vec2};
use flat_scenes::{Parameters, Scene};

/// px in a metre: engines with a notion of metres are tuned for bodies of about one.
pub const PX_PER_M: f32 = 16.0;
/// Seconds in a step.
pub const STEP_S: f32 = 1.0 / 60.0;

/// A scene in an engine.
pub trait Engine {
    /// Goes on by 1/60 s.
    fn step(&mut self);
}

/// An engine whose results are looked at here; flat's are elsewhere, bit by bit.
pub trait Peer: Engine {
    /// All bodies, by number.
    fn states(&mut self) -> Vec<State>;
}

/// Where a body is, px and px/s.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// Its centre.
    pub position: [f32; 2],
    /// Its velocity.
    pub velocity: [f32; 2],
}

impl State {
    /// From metres.
    pub fn from_metres(position: [f32; 2], velocity: [f32; 2]) -> Self {
        Self { position: position.map(|m| m * PX_PER_M), velocity: velocity.map(|m| m * PX_PER_M) }
    }
}

/// A scene's bodies, by number.
pub fn bodies(scene: &Scene, parameters: &Parameters) -> Vec<BodyDef<Fixed>> {
    scene.spawn_order(parameters).map(|number| scene.body(parameters, number)).collect()
}

/// A length or a speed in metres.
pub fn metres(px: I16F16) -> f32 {
    px.to_num::<f32>() / PX_PER_M
}

/// A point or a velocity in metres.
pub fn metres_of(px: Vec2<I16F16>) -> [f32; 2] {
    [metres(px.x), metres(px.y)]
}

/// Part of the approach speed that comes back.
pub fn restitution(def: &BodyDef<Fixed>) -> f32 {
    if def.material.bounce { def.material.restitution.to_num() } else { 0.0 }
}

/// Whether it meets nobody: the one rule of layers that plain scenes have.
pub fn is_ghost(def: &BodyDef<Fixed>) -> bool {
    def.layer == 0 && def.mask == 0
}
