//! The scene comes to rest: from some step on, nobody is faster than a limit.

use fixed::types::I16F16;

use super::worst::Worst;
use super::{Body, Check, Finding};

/// The check.
pub struct Rest {
    from_step: u32,
    speed: f64,
    fastest: Worst,
}

impl Rest {
    /// From which step on, and the limit in px/s.
    pub fn new(from_step: u32, speed: I16F16) -> Self {
        let speed = f64::from(speed);
        Self { from_step, speed, fastest: Worst::new(speed, "px/s") }
    }
}

impl Check for Rest {
    fn observe(&mut self, step: u32, bodies: &[Body]) {
        if step < self.from_step {
            return;
        }
        for (slot, body) in bodies.iter().enumerate().filter(|(_, body)| body.moves && body.present) {
            let [x, y] = body.velocity;
            self.fastest.take(step, x.hypot(y), || format!("by body {slot}"));
        }
    }

    fn finding(&self) -> Finding {
        self.fastest.finding(
            "comes to rest".into(),
            format!("at most {:.4} px/s from step {} on", self.speed, self.from_step),
            &format!("the run ended before step {}", self.from_step),
        )
    }
}
