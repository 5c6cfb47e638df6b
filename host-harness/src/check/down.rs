//! Nothing is thrown up.

use fixed::types::I16F16;

use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Down {
    at_most: f64,
    fastest: Worst,
}

impl Down {
    /// The largest speed upwards that is allowed, px/s.
    pub(super) fn new(at_most: I16F16) -> Self {
        let at_most = f64::from(at_most);
        Self { at_most, fastest: Worst::new(at_most, "px/s") }
    }
}

impl Check for Down {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        for (slot, body) in bodies.iter().enumerate().filter(|(_, body)| body.moves && body.present) {
            self.fastest.take(step, (-body.velocity[1]).max(0.0), || format!("upwards by body {slot}"));
        }
    }

    fn finding(&self) -> Finding {
        let expected = format!("at most {:.4} px/s upwards, at every step", self.at_most);
        self.fastest.finding("nothing is thrown up".into(), expected, "no body that can move")
    }
}
