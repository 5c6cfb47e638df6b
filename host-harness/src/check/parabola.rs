//! Bodies that meet nothing are where the closed form says (Galilei): `p + v t + g t^2 / 2`.

use fixed::types::I16F16;
use flat_wire::message::ScalarKind;

use super::body::STEP_HZ;
use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Parabola {
    scalar: ScalarKind,
    at_most: f64,
    gravity: f64,
    furthest: Worst,
}

impl Parabola {
    /// How far off is still right, px, and gravity, px/s2.
    pub(super) fn new(scalar: ScalarKind, at_most: I16F16, gravity: f64) -> Self {
        let at_most = f64::from(at_most);
        Self { scalar, at_most, gravity, furthest: Worst::new(at_most, "px") }
    }
}

impl Check for Parabola {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let t = f64::from(step) / STEP_HZ;
        for (slot, body) in bodies.iter().enumerate().filter(|(_, body)| body.moves) {
            let [x, y] = [0, 1].map(|axis| {
                let gravity = if axis == 1 { self.gravity * body.gravity_scale } else { 0.0 };
                body.start[axis] + body.start_velocity[axis] * t + gravity * t * t / 2.0
            });
            let off = if body.present { (body.position[0] - x).hypot(body.position[1] - y) } else { f64::INFINITY };
            self.furthest.take(step, off, || format!("off by body {slot}"));
        }
    }

    fn finding(&self) -> Finding {
        let finding = self.furthest.finding(
            "free flight".into(),
            format!("at most {:.4} px from p + v t + g t^2 / 2, at every step", self.at_most),
            "no body that can move",
        );
        match self.scalar {
            ScalarKind::F32 => finding.excused("each step rounds a far position"),
            ScalarKind::Fixed | ScalarKind::F64 => finding,
        }
    }
}
