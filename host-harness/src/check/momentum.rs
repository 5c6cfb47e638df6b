//! Momentum is kept: it changes by no more than rounding can.

use flat_wire::message::ScalarKind;

use super::body::{Body, STEP_HZ};
use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Momentum {
    /// What rounding one velocity can add to the momentum of the heaviest body, mass x px/s.
    unit: f64,
    /// Of the first state.
    start: Option<[f64; 2]>,
    contacts: u64,
    drift: Worst,
}

impl Momentum {
    /// With a number format's resolution, at the speeds and masses of these bodies.
    pub(super) fn new(scalar: ScalarKind, bodies: &[Body]) -> Self {
        let largest = |of: fn(&Body) -> f64| bodies.iter().filter(|body| body.moves).map(of).fold(0.0, f64::max);
        let fastest = largest(|body| body.start_velocity[0].abs().max(body.start_velocity[1].abs()));
        let resolution = match scalar {
            ScalarKind::Fixed => STEP_HZ / f64::from(1 << 24),
            ScalarKind::F32 => fastest * f64::from(f32::EPSILON),
            ScalarKind::F64 => fastest * f64::EPSILON,
        };
        Self {
            unit: resolution * largest(|body| body.mass),
            start: None,
            contacts: 0,
            drift: Worst::new(1.0, "LSB a contact"),
        }
    }
}

impl Check for Momentum {
    fn observe(&mut self, state: &State<'_>) {
        let sum = [0, 1].map(|axis| {
            let moving = state.bodies.iter().filter(|body| body.moves);
            moving.map(|body| body.mass * body.velocity[axis]).sum::<f64>()
        });
        let start = *self.start.get_or_insert(sum);
        self.contacts += state.contacts.len() as u64;
        let change = (sum[0] - start[0]).abs().max((sum[1] - start[1]).abs()) / self.unit;
        // Without a contact nothing may change at all.
        let share = if change == 0.0 { 0.0 } else { change / self.contacts as f64 };
        let contacts = self.contacts;
        self.drift.take(state.step, share, || format!("after {contacts} contacts"));
    }

    fn finding(&self) -> Finding {
        self.drift.finding(
            "momentum".into(),
            "changes by at most 1 LSB of velocity for each contact taken".into(),
            "the run ended before the first step",
        )
    }
}
