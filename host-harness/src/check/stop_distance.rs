//! A body comes to rest where friction says.

use fixed::types::I16F16;

use super::{Body, Check, Finding, Outcome, State};

/// Slower is at rest, px/s.
const AT_REST: f64 = 0.01;

/// The check.
#[derive(Debug)]
pub(super) struct StopDistance {
    slot: Option<usize>,
    number: u16,
    distance: f64,
    tolerance: f64,
    latest: Option<(u32, Body)>,
}

impl StopDistance {
    /// The body by slot and by its number in the scene, how far it should get, px, and how far off is still right, as a
    /// part of that.
    pub(super) fn new(slot: Option<usize>, number: u16, distance: I16F16, tolerance: I16F16) -> Self {
        let distance = f64::from(distance);
        Self { slot, number, distance, tolerance: distance * f64::from(tolerance), latest: None }
    }
}

impl Check for StopDistance {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        self.latest = self.slot.and_then(|slot| bodies.get(slot)).map(|body| (step, *body));
    }

    fn finding(&self) -> Finding {
        let gone = |body: &Body| [0, 1].map(|axis| body.position[axis] - body.start[axis]);
        let (outcome, got, measured) = match &self.latest {
            None => (Outcome::Failed, "the scene has no such body".into(), None),
            Some((_, body)) => {
                let (way, speed) = (gone(body)[0].hypot(gone(body)[1]), body.velocity[0].hypot(body.velocity[1]));
                if speed > AT_REST {
                    (Outcome::Untested, format!("after {way:.4} px still at {speed:.4} px/s"), Some(way))
                } else {
                    let held = (way - self.distance).abs() <= self.tolerance;
                    (if held { Outcome::Held } else { Outcome::Failed }, format!("{way:.4} px"), Some(way))
                }
            }
        };
        Finding {
            check: format!("body {} stops", self.number),
            outcome,
            step: self.latest.as_ref().map(|(step, _)| *step),
            expected: format!("{:.4} px from where it started", self.distance),
            got,
            tolerance: format!("{:.4} px", self.tolerance),
            measured,
            limit: Some(self.distance),
            unit: "px",
            used: measured.map(|way| (way - self.distance).abs() / self.tolerance),
        }
    }
}
