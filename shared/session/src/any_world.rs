//! A world with a scene in it, whatever its number format.

use core::fmt::Write;

use flat_physics::{BodyView, Config, Effects, Fixed, Handle, Level, Quantity, Scalar, Stage, Statistics, World};
use flat_scenes::{Parameters, Scene};
use flat_wire::message::{
    BODIES_PER_FRAME, BodyPosition, BodyState, CONTACTS_PER_FRAME, Capacity, ContactState, POSITIONS_PER_FRAME, Reason,
    ScalarKind,
};
use heapless::Vec;

/// One world a number format.
#[derive(Debug)]
pub struct Worlds<'a> {
    /// Fixed point.
    pub fixed: World<'a, Fixed>,
    /// IEEE 754 binary32.
    pub f32: World<'a, f32>,
    /// IEEE 754 binary64.
    pub f64: World<'a, f64>,
}

impl<'a> Worlds<'a> {
    pub(crate) fn of(&self, kind: ScalarKind) -> &(dyn AnyWorld + 'a) {
        match kind {
            ScalarKind::Fixed => &self.fixed,
            ScalarKind::F32 => &self.f32,
            ScalarKind::F64 => &self.f64,
        }
    }

    pub(crate) fn of_mut(&mut self, kind: ScalarKind) -> &mut (dyn AnyWorld + 'a) {
        match kind {
            ScalarKind::Fixed => &mut self.fixed,
            ScalarKind::F32 => &mut self.f32,
            ScalarKind::F64 => &mut self.f64,
        }
    }

    /// Room in each world that has any.
    pub(crate) fn capacities(&self) -> Vec<Capacity, 3> {
        let capacity = |scalar| {
            let (bodies, contacts) = self.of(scalar).capacity();
            Capacity { scalar, bodies, contacts }
        };
        [ScalarKind::Fixed, ScalarKind::F32, ScalarKind::F64]
            .into_iter()
            .map(capacity)
            .filter(|capacity| capacity.bodies > 0)
            .collect()
    }
}

/// What the session does with a world; lists are filled from the given slot or place on.
pub(crate) trait AnyWorld {
    fn capacity(&self) -> (u16, u16);
    /// Builds a scene, or says why not.
    fn load(&mut self, scene: &Scene, parameters: &Parameters, level: Level) -> Result<(), Reason>;
    fn run(&mut self, stage: Stage, effects: Effects);
    fn digest(&self) -> u64;
    fn statistics(&self) -> Statistics;
    fn holds(&self, slot: u16) -> bool;
    /// Inverts a bit of a body's velocity; nothing happens where there is no body.
    fn flip(&mut self, slot: u16, bit: u8);
    fn bodies(&self, from: u16) -> Vec<BodyState, BODIES_PER_FRAME>;
    fn positions(&self, from: u16) -> Vec<BodyPosition, POSITIONS_PER_FRAME>;
    fn contacts(&self, from: u16) -> Vec<ContactState, CONTACTS_PER_FRAME>;
}

impl<S: Scalar> AnyWorld for World<'_, S> {
    fn capacity(&self) -> (u16, u16) {
        (World::capacity(self), self.contact_capacity())
    }

    fn load(&mut self, scene: &Scene, parameters: &Parameters, level: Level) -> Result<(), Reason> {
        scene.build(parameters, self).map_err(|error| reason(format_args!("{}: {error}", scene.name))).and_then(|()| {
            let config = Config { level, ..*self.config() };
            self.configure(config).map_err(|error| reason(format_args!("{}: {error}", scene.name)))
        })
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
}

/// The first `N` bodies from a slot on.
fn listed<S: Scalar, T, const N: usize>(
    world: &World<'_, S>,
    from: u16,
    entry: impl Fn(BodyView<S>) -> T,
) -> Vec<T, N> {
    world.bodies_from(from).take(N).map(entry).collect()
}

/// A text for the host; what doesn't fit is cut off.
pub(crate) fn reason(text: core::fmt::Arguments<'_>) -> Reason {
    let mut reason = Reason::new();
    let _ = Cut(&mut reason).write_fmt(text);
    reason
}

struct Cut<'a>(&'a mut Reason);

impl Write for Cut<'_> {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        text.chars().try_for_each(|character| self.0.push(character).map_err(|_| core::fmt::Error))
    }
}
