//! The scene, or one body, comes to rest: from some step on it is no faster than a limit.

use fixed::types::I16F16;

use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Rest {
    from_step: u32,
    body: Option<u16>,
    speed: f64,
    fastest: Worst,
}

impl Rest {
    /// From which step on, whose (none = every body's), and the limit in px/s.
    pub(super) fn new(from_step: u32, body: Option<u16>, speed: I16F16) -> Self {
        let speed = f64::from(speed);
        Self { from_step, body, speed, fastest: Worst::new(speed, "px/s") }
    }
}

impl Check for Rest {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        if step < self.from_step {
            return;
        }
        let wanted = |number| self.body.is_none_or(|body| body == number);
        for (slot, body) in bodies.iter().enumerate() {
            if body.moves && body.present && wanted(body.number) {
                let [x, y] = body.velocity;
                self.fastest.take(step, x.hypot(y), || format!("by body {slot}"));
            }
        }
    }

    fn finding(&self) -> Finding {
        self.fastest.finding(
            self.body.map_or_else(|| "speeds stay low".into(), |body| format!("body {body} comes to rest")),
            format!("at most {:.4} px/s from step {} on", self.speed, self.from_step),
            &format!("the run ended before step {}", self.from_step),
        )
    }
}
