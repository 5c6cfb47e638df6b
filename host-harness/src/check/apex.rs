//! A bounce is as high as it should be.

use fixed::types::I16F16;

use super::{Check, Finding, Outcome, State};

/// The check.
#[derive(Debug)]
pub(super) struct Apex {
    slot: Option<usize>,
    number: u16,
    bounce: u16,
    y: f64,
    tolerance: f64,
    bounces: u16,
    falling: bool,
    /// Highest point since the bounce, y down.
    highest: f64,
    /// Step and y, once the body falls again.
    peak: Option<(u32, f64)>,
}

impl Apex {
    /// The body by slot and by its number in the scene, the bounce counted from 1, the y of the centre at the highest
    /// point after it, and by how much that may differ, px.
    pub(super) fn new(slot: Option<usize>, number: u16, bounce: u16, y: I16F16, tolerance: I16F16) -> Self {
        Self {
            slot,
            number,
            bounce,
            y: y.into(),
            tolerance: tolerance.into(),
            bounces: 0,
            falling: false,
            highest: f64::INFINITY,
            peak: None,
        }
    }
}

impl Check for Apex {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let Some(body) = self.slot.and_then(|slot| bodies.get(slot)) else { return };
        let falls = body.velocity[1] > 0.0;
        let rises = body.velocity[1] < 0.0;
        if self.falling && rises {
            self.bounces += 1;
        }
        if self.bounces == self.bounce && self.peak.is_none() {
            self.highest = self.highest.min(body.position[1]);
            if !rises {
                self.peak = Some((step, self.highest));
            }
        }
        if falls || rises {
            self.falling = falls;
        }
    }

    fn finding(&self) -> Finding {
        let (outcome, step, got, measured) = match self.peak {
            Some((step, y)) => {
                let held = (y - self.y).abs() <= self.tolerance;
                let outcome = if held { Outcome::Held } else { Outcome::Failed };
                (outcome, Some(step), format!("y {y:.4} px"), Some(y))
            }
            None if self.slot.is_none() => (Outcome::Failed, None, "the scene has no such body".into(), None),
            None => (Outcome::Untested, None, format!("the run ended after bounce {}", self.bounces), None),
        };
        Finding {
            check: format!("height of bounce {} of body {}", self.bounce, self.number),
            outcome,
            step,
            expected: format!("centre up to y {:.4} px", self.y),
            got,
            tolerance: format!("{:.4} px", self.tolerance),
            measured,
            limit: Some(self.y),
            unit: "px",
            used: measured.map(|y| (y - self.y).abs() / self.tolerance),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::body::{Body, Extent};

    /// Height and velocity (both y down) at each step.
    fn outcome(path: &[(f64, f64)]) -> Outcome {
        let mut apex = Apex::new(Some(0), 0, 1, I16F16::from_num(-50), I16F16::from_num(1));
        for (step, &(y, velocity)) in (1..).zip(path) {
            let body = Body { velocity: [0.0, velocity], ..Body::at([0.0, y], Extent::Circle { radius: 1.0 }) };
            apex.observe(&State { step, bodies: &[body], contacts: &[] });
        }
        apex.finding().outcome
    }

    #[test]
    fn the_highest_point_between_bounces_counts() {
        let fall_and_rise = [(-100.0, 0.0), (-40.0, 60.0), (0.0, -30.0), (-30.0, -20.0)];
        assert_eq!(outcome(&fall_and_rise), Outcome::Untested);
        assert_eq!(outcome(&[&fall_and_rise[..], &[(-50.4, -0.1), (-50.4, 1.0)]].concat()), Outcome::Held);
        assert_eq!(
            outcome(&[&fall_and_rise[..], &[(-48.0, -0.1), (-48.0, 1.0), (0.0, -50.0)]].concat()),
            Outcome::Failed
        );
    }
}
