//! Bodies as the checks see them: px, px/s, `f64`.

use std::collections::HashMap;

use fixed::types::I16F16;
use flat_physics::{Fixed, Kind, Shape};
use flat_scenes::{Parameters, Scene};
use flat_wire::message::{BodyState, ScalarKind};

use crate::number::{Quantity, decode};

/// Steps per second: velocities are streamed per step.
const STEP_HZ: f64 = flat_physics::scalar::STEP_HZ as f64;

/// A shape's size, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// A disc.
    Circle {
        /// Its radius.
        radius: f64,
    },
    /// An axis-aligned box.
    Box {
        /// Half width and half height.
        half: [f64; 2],
    },
}

/// One body.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Its size.
    pub extent: Extent,
    /// Whether anything can move it.
    pub moves: bool,
    /// Whether the latest state has it.
    pub present: bool,
    /// Centre, px.
    pub position: [f64; 2],
    /// Velocity, px/s.
    pub velocity: [f64; 2],
}

impl Body {
    /// A body at rest that can move.
    #[cfg(test)]
    pub fn at(position: [f64; 2], extent: Extent) -> Self {
        Self { extent, moves: true, present: true, position, velocity: [0.0; 2] }
    }

    /// Half width and half height of its bounding box.
    pub fn half_extent(&self) -> [f64; 2] {
        match self.extent {
            Extent::Circle { radius } => [radius; 2],
            Extent::Box { half } => half,
        }
    }
}

/// A scene's bodies by slot.
#[derive(Clone, Debug)]
pub struct Bodies {
    scalar: ScalarKind,
    by_slot: Vec<Body>,
    /// Slot by number in the scene.
    slots: HashMap<u16, usize>,
}

impl Bodies {
    /// The bodies as the scene defines them: slots are given out in the order of insertion.
    pub fn of(scene: &Scene, parameters: &Parameters, scalar: ScalarKind) -> Self {
        let by_slot = scene
            .spawn_order(parameters)
            .map(|index| {
                let def = scene.body(parameters, index);
                let px = |a: I16F16, b: I16F16| [f64::from(a), f64::from(b)];
                let extent = match def.shape {
                    Shape::<Fixed>::Circle { radius } => Extent::Circle { radius: radius.into() },
                    Shape::Box { half } => Extent::Box { half: px(half.x, half.y) },
                };
                Body {
                    extent,
                    moves: def.kind == Kind::Rigid,
                    present: true,
                    position: px(def.position.x, def.position.y),
                    velocity: px(def.velocity.x, def.velocity.y),
                }
            })
            .collect();
        let slots = scene.spawn_order(parameters).zip(0..).collect();
        Self { scalar, by_slot, slots }
    }

    /// The slot of a body by its number in the scene; none if the scene has no such body.
    pub fn slot_of(&self, number: u16) -> Option<usize> {
        self.slots.get(&number).copied()
    }

    /// Takes over a whole state; a body that it lacks is no longer present.
    pub fn update(&mut self, states: &[BodyState]) {
        for body in &mut self.by_slot {
            body.present = false;
        }
        for state in states {
            if let Some(body) = self.by_slot.get_mut(usize::from(state.slot)) {
                body.present = true;
                body.position = state.position.map(|bits| decode(self.scalar, Quantity::Length, bits));
                body.velocity = state.velocity.map(|bits| decode(self.scalar, Quantity::Speed, bits) * STEP_HZ);
            }
        }
    }

    /// All bodies, by slot.
    pub fn as_slice(&self) -> &[Body] {
        &self.by_slot
    }
}
