//! A fall through air, against the recurrence that damping defines.

use fixed::types::I16F16;

use super::body::STEP_HZ;
use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Terminal {
    damping: f64,
    tolerance: f64,
    gravity: f64,
    furthest: Worst,
}

impl Terminal {
    /// The factor on every step's speed, how far off is still right as a part of the speed, and gravity, px/s2.
    pub(super) fn new(damping: I16F16, tolerance: I16F16, gravity: f64) -> Self {
        let tolerance = 100.0 * f64::from(tolerance);
        Self { damping: damping.into(), tolerance, gravity, furthest: Worst::new(tolerance, "%") }
    }
}

impl Check for Terminal {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        // v_n = g / 60 d (1 - d^n) / (1 - d), the sum of the recurrence from rest.
        let d = self.damping;
        let speed = self.gravity / STEP_HZ * d * (1.0 - d.powf(step.into())) / (1.0 - d);
        for (slot, body) in bodies.iter().enumerate().filter(|(_, body)| body.moves) {
            let off = 100.0 * (body.velocity[1] - speed).abs() / speed;
            self.furthest.take(step, off, || format!("off {speed:.4} px/s by body {slot}"));
        }
    }

    fn finding(&self) -> Finding {
        self.furthest.finding(
            "damped fall".into(),
            format!("v <- (v + g / 60) {:.4} to {:.4} %, at every step", self.damping, self.tolerance),
            "no body that can move",
        )
    }
}
