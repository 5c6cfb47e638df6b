//! The centre of mass keeps its horizontal speed.

use fixed::types::I16F16;

use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct CentreOfMass {
    at_most: f64,
    change: Worst,
}

impl CentreOfMass {
    /// By how much it may change, px/s.
    pub(super) fn new(at_most: I16F16) -> Self {
        let at_most = f64::from(at_most);
        Self { at_most, change: Worst::new(at_most, "px/s") }
    }
}

impl Check for CentreOfMass {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let (mut momentum, mut mass) = (0.0, 0.0);
        for body in bodies.iter().filter(|body| body.moves) {
            momentum += body.mass * (body.velocity[0] - body.start_velocity[0]);
            mass += body.mass;
        }
        self.change.take(step, (momentum / mass).abs(), String::new);
    }

    fn finding(&self) -> Finding {
        self.change.finding(
            "horizontal speed of the centre of mass".into(),
            format!("changes by at most {:.4} px/s, at every step", self.at_most),
            "no body that can move",
        )
    }
}
