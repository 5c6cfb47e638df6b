//! Bodies as the checks see them: px, px/s, `f64`, in the scene's own coordinates.

use std::collections::HashMap;

use fixed::types::I16F16;
use flat_physics::{Fixed, Kind, Shape, Vec2, vec2};
use flat_scenes::{Parameters, Scene, Variant};
use flat_wire::message::{BodyState, ScalarKind};

use crate::number::{Quantity, decode};

/// Steps per second: velocities are streamed per step.
pub(super) const STEP_HZ: f64 = flat_physics::scalar::STEP_HZ as f64;

/// A shape's size, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Extent {
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
pub(super) struct Body {
    /// Its number in the scene.
    pub(super) number: u16,
    /// Its size.
    pub(super) extent: Extent,
    /// Whether it blocks whoever touches it: no sensor, and not only from one side.
    pub(super) solid: bool,
    /// Whether anything can move it.
    pub(super) moves: bool,
    /// Its mass.
    pub(super) mass: f64,
    /// Multiple of the scene's gravity that pulls it.
    pub(super) gravity_scale: f64,
    /// Whether the latest state has it.
    pub(super) present: bool,
    /// Centre, px.
    pub(super) position: [f64; 2],
    /// Velocity, px/s.
    pub(super) velocity: [f64; 2],
    /// Centre at the start, px.
    pub(super) start: [f64; 2],
    /// Velocity at the start, px/s.
    pub(super) start_velocity: [f64; 2],
    /// The latest state, bit by bit; none before the first.
    pub(super) state: Option<BodyState>,
}

impl Body {
    /// A body of mass 1 at rest that can move.
    pub(super) fn at(position: [f64; 2], extent: Extent) -> Self {
        Self {
            number: 0,
            extent,
            solid: true,
            moves: true,
            mass: 1.0,
            gravity_scale: 1.0,
            present: true,
            position,
            velocity: [0.0; 2],
            start: position,
            start_velocity: [0.0; 2],
            state: None,
        }
    }

    /// Half width and half height of its bounding box.
    pub(super) fn half_extent(&self) -> [f64; 2] {
        match self.extent {
            Extent::Circle { radius } => [radius; 2],
            Extent::Box { half } => half,
        }
    }
}

/// A scene's bodies by slot.
#[derive(Clone, Debug)]
pub(super) struct Bodies {
    scalar: ScalarKind,
    variant: Variant,
    by_slot: Vec<Body>,
    /// Slot by number in the scene.
    slots: HashMap<u16, usize>,
}

impl Bodies {
    /// The bodies as the scene defines them: slots are given out in the order of insertion.
    pub(super) fn of(scene: &Scene, parameters: &Parameters, scalar: ScalarKind) -> Self {
        let variant = parameters.variant;
        let by_slot = scene
            .spawn_order(parameters)
            .map(|number| {
                let def = scene.body(parameters, number);
                let px = |v: Vec2<I16F16>| v.map(f64::from);
                let extent = match def.shape {
                    Shape::<Fixed>::Circle { radius } => Extent::Circle { radius: radius.into() },
                    Shape::Box { half } => Extent::Box { half: pair(variant.turn_back(px(half)).map(f64::abs)) },
                };
                let start = pair(variant.turn_back(px(def.position) - px(variant.origin())));
                let start_velocity = pair(variant.turn_back(px(def.velocity)));
                Body {
                    number,
                    extent,
                    solid: !def.sensor && !def.one_way,
                    moves: def.kind == Kind::Rigid,
                    mass: def.mass.into(),
                    gravity_scale: def.gravity_scale.into(),
                    present: true,
                    position: start,
                    velocity: start_velocity,
                    start,
                    start_velocity,
                    state: None,
                }
            })
            .collect();
        let slots = scene.spawn_order(parameters).zip(0..).collect();
        Self { scalar, variant, by_slot, slots }
    }

    /// The slot of a body by its number in the scene; none if the scene has no such body.
    pub(super) fn slot_of(&self, number: u16) -> Option<usize> {
        self.slots.get(&number).copied()
    }

    /// Takes over a whole state; a body that it lacks is no longer present.
    pub(super) fn update(&mut self, states: &[BodyState]) {
        for body in &mut self.by_slot {
            body.present = false;
        }
        let (scalar, variant) = (self.scalar, self.variant);
        let number = |quantity, [x, y]: [i64; 2]| vec2(decode(scalar, quantity, x), decode(scalar, quantity, y));
        for state in states {
            if let Some(body) = self.by_slot.get_mut(usize::from(state.slot)) {
                let position = number(Quantity::Length, state.position) - variant.origin().map(f64::from);
                let velocity = number(Quantity::Speed, state.velocity).map(|speed| speed * STEP_HZ);
                body.present = true;
                body.position = pair(variant.turn_back(position));
                body.velocity = pair(variant.turn_back(velocity));
                body.state = Some(*state);
            }
        }
    }

    /// All bodies, by slot.
    pub(super) fn as_slice(&self) -> &[Body] {
        &self.by_slot
    }
}

fn pair(Vec2 { x, y }: Vec2<f64>) -> [f64; 2] {
    [x, y]
}
