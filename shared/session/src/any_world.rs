//! A world with a scene in it, whatever its number format.

use flat_physics::{
    BodyView, Collider, Config, Effects, Event, Fixed, Handle, Level, Quantity, Scalar, Stage, Statistics, World,
};
use flat_scenes::{Cue, Memory, Parameters, Scene};
use flat_wire::message::{
    BODIES_PER_FRAME, BodyPosition, BodyState, CONTACTS_PER_FRAME, Capacity, ContactEvent, ContactState,
    EVENTS_PER_FRAME, Measures, POSITIONS_PER_FRAME, Phase, Reason, ScalarKind,
};
use heapless::Vec;

use crate::cut::cut;
use crate::measures;

/// One world a number format.
#[derive(Debug)]
pub struct Worlds<'a> {
    /// Fixed point.
    pub fixed: World<'a, Fixed>,
    /// IEEE 754 binary32.
    pub f32: World<'a, f32>,
    /// IEEE 754 binary64.
    #[cfg(feature = "binary64")]
    pub f64: World<'a, f64>,
}

impl<'a> Worlds<'a> {
    /// The world of a number format; none if the device does without.
    #[cfg_attr(
        feature = "binary64",
        allow(clippy::unnecessary_wraps, reason = "without the feature there may be none")
    )]
    pub(crate) fn of(&self, kind: ScalarKind) -> Option<&(dyn AnyWorld + 'a)> {
        match kind {
            ScalarKind::Fixed => Some(&self.fixed),
            ScalarKind::F32 => Some(&self.f32),
            #[cfg(feature = "binary64")]
            ScalarKind::F64 => Some(&self.f64),
            #[cfg(not(feature = "binary64"))]
            ScalarKind::F64 => None,
        }
    }

    /// The same, to change it.
    #[cfg_attr(
        feature = "binary64",
        allow(clippy::unnecessary_wraps, reason = "without the feature there may be none")
    )]
    pub(crate) fn of_mut(&mut self, kind: ScalarKind) -> Option<&mut (dyn AnyWorld + 'a)> {
        match kind {
            ScalarKind::Fixed => Some(&mut self.fixed),
            ScalarKind::F32 => Some(&mut self.f32),
            #[cfg(feature = "binary64")]
            ScalarKind::F64 => Some(&mut self.f64),
            #[cfg(not(feature = "binary64"))]
            ScalarKind::F64 => None,
        }
    }

    /// Room in each world that has any.
    pub(crate) fn capacities(&self) -> Vec<Capacity, 3> {
        let capacity = |scalar| {
            let (bodies, contacts) = self.of(scalar)?.capacity();
            Some(Capacity { scalar, bodies, contacts })
        };
        [ScalarKind::Fixed, ScalarKind::F32, ScalarKind::F64]
            .into_iter()
            .filter_map(capacity)
            .filter(|capacity| capacity.bodies > 0)
            .collect()
    }
}

/// What the session does with a world; lists are filled from the given slot or place on.
pub(crate) trait AnyWorld {
    fn capacity(&self) -> (u16, u16);
    /// Builds a scene, or says why not.
    fn load(
        &mut self,
        scene: &Scene,
        parameters: &Parameters,
        level: Level,
        iterations: Option<u8>,
    ) -> Result<(), Reason>;
    /// Does what the scene does before a step; false if the world refused any of it.
    fn direct(&mut self, scene: &Scene, parameters: &Parameters, cue: Cue, memory: &mut Memory) -> bool;
    fn run(&mut self, stage: Stage, effects: Effects);
    fn digest(&self) -> u64;
    fn statistics(&self) -> Statistics;
    fn holds(&self, slot: u16) -> bool;
    /// Inverts a bit of a body's velocity; nothing happens where there is no body.
    fn flip(&mut self, slot: u16, bit: u8);
    fn bodies(&self, from: u16) -> Vec<BodyState, BODIES_PER_FRAME>;
    fn positions(&self, from: u16) -> Vec<BodyPosition, POSITIONS_PER_FRAME>;
    fn contacts(&self, from: u16) -> Vec<ContactState, CONTACTS_PER_FRAME>;
    /// The last step's events, without so many first ones.
    fn events(&self, from: u16) -> Vec<ContactEvent, EVENTS_PER_FRAME>;
    /// How many events the last step had.
    fn event_count(&self) -> u16;
    fn measures(&self) -> Measures;
}

impl<S: Scalar> AnyWorld for World<'_, S> {
    fn capacity(&self) -> (u16, u16) {
        (World::capacity(self), self.contact_capacity())
    }

    fn load(
        &mut self,
        scene: &Scene,
        parameters: &Parameters,
        level: Level,
        iterations: Option<u8>,
    ) -> Result<(), Reason> {
        let refused = |error: &dyn core::fmt::Display| reason(format_args!("{}: {error}", scene.name));
        scene.build(parameters, level, self).map_err(|error| refused(&error))?;
        if let Some(velocity_iterations) = iterations {
            let config = Config { velocity_iterations, ..*self.config() };
            self.configure(config).map_err(|error| refused(&error))?;
        }
        Ok(())
    }

    fn direct(&mut self, scene: &Scene, parameters: &Parameters, cue: Cue, memory: &mut Memory) -> bool {
        scene.direct(parameters, cue, memory, self).is_ok()
    }

    fn run(&mut self, stage: Stage, effects: Effects) {
        stage.run(self, effects);
    }

    fn digest(&self) -> u64 {
        flat_physics::digest(self)
    }

    fn statistics(&self) -> Statistics {
        World::statistics(self)
    }

    fn holds(&self, slot: u16) -> bool {
        self.bodies_from(slot).next().is_some_and(|body| body.handle.slot() == slot)
    }

    fn flip(&mut self, slot: u16, bit: u8) {
        // The session has checked the slot, and scenes don't lose bodies.
        let _ = self.flip_velocity_bit(slot, bit);
    }

    fn bodies(&self, from: u16) -> Vec<BodyState, BODIES_PER_FRAME> {
        listed(self, from, |body| BodyState {
            slot: body.handle.slot(),
            position: [body.position.x.bits(), body.position.y.bits()],
            velocity: [body.velocity.x.bits(), body.velocity.y.bits()],
            remainder: [body.remainder.x, body.remainder.y],
        })
    }

    fn positions(&self, from: u16) -> Vec<BodyPosition, POSITIONS_PER_FRAME> {
        let sixteenths = |length| S::floor(S::length_scaled(length, S::real(flat_physics::scalar::px(16))));
        listed(self, from, |body| BodyPosition {
            slot: body.handle.slot(),
            position: [sixteenths(body.position.x), sixteenths(body.position.y)],
        })
    }

    fn contacts(&self, from: u16) -> Vec<ContactState, CONTACTS_PER_FRAME> {
        self.contacts_from(from)
            .take(CONTACTS_PER_FRAME)
            .map(|contact| ContactState {
                bodies: contact.bodies.map(Handle::slot),
                normal: [contact.normal.x.bits(), contact.normal.y.bits()],
                penetration: contact.penetration.bits(),
                impulse: [contact.impulse.x.bits(), contact.impulse.y.bits()],
            })
            .collect()
    }

    fn events(&self, from: u16) -> Vec<ContactEvent, EVENTS_PER_FRAME> {
        World::events(self).skip(usize::from(from)).take(EVENTS_PER_FRAME).map(|told| event(&told)).collect()
    }

    fn event_count(&self) -> u16 {
        World::events(self).count() as u16
    }

    fn measures(&self) -> Measures {
        measures::of(self)
    }
}

fn event<S: Scalar>(event: &Event<S>) -> ContactEvent {
    let (other, tile) = match event.other {
        Collider::Body(handle) => (handle.slot(), None),
        Collider::Tile(tile) => (u16::MAX, Some([tile.column, tile.row])),
    };
    ContactEvent {
        phase: match event.phase {
            flat_physics::Phase::Begin => Phase::Begin,
            flat_physics::Phase::Stay => Phase::Stay,
            flat_physics::Phase::End => Phase::End,
        },
        bodies: [event.body.slot(), other],
        tile,
        sensor: event.sensor,
        normal: [event.normal.x.bits(), event.normal.y.bits()],
        impulse: event.impulse.x.bits(),
    }
}

/// The first `N` bodies from a slot on.
fn listed<S: Scalar, T, const N: usize>(
    world: &World<'_, S>,
    from: u16,
    entry: impl Fn(BodyView<S>) -> T,
) -> Vec<T, N> {
    world.bodies_from(from).take(N).map(entry).collect()
}

/// Why the host is refused.
pub(crate) fn reason(text: core::fmt::Arguments<'_>) -> Reason {
    cut(text)
}
