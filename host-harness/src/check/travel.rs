//! Constant speed for a long time: at the end every body is where its first velocity says.

use fixed::types::I16F16;
use flat_wire::message::ScalarKind;

use super::body::STEP_HZ;
use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Travel {
    scalar: ScalarKind,
    tolerance: f64,
    /// Of the latest step.
    furthest: Worst,
}

impl Travel {
    /// How far off is still right, as a part of the way.
    pub(super) fn new(scalar: ScalarKind, tolerance: I16F16) -> Self {
        let tolerance = 100.0 * f64::from(tolerance);
        Self { scalar, tolerance, furthest: Worst::new(tolerance, "%") }
    }
}

impl Check for Travel {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let t = f64::from(step) / STEP_HZ;
        self.furthest = Worst::new(self.tolerance, "%");
        for (slot, body) in bodies.iter().enumerate().filter(|(_, body)| body.moves) {
            let [vx, vy] = body.start_velocity;
            let off = [0, 1].map(|axis| body.position[axis] - body.start[axis] - body.start_velocity[axis] * t);
            let share = off[0].hypot(off[1]) / (vx.hypot(vy) * t);
            self.furthest.take(step, 100.0 * share, || format!("of its way off: body {slot}"));
        }
    }

    fn finding(&self) -> Finding {
        let finding = self.furthest.finding(
            "constant speed".into(),
            format!("v t to {:.4} % at the end", self.tolerance),
            "no body that can move",
        );
        match self.scalar {
            ScalarKind::F32 => finding.excused("far out its positions are too coarse for a step's way"),
            ScalarKind::Fixed | ScalarKind::F64 => finding,
        }
    }
}
