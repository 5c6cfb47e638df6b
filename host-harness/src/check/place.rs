//! A body is where it should be after a step.

use fixed::types::I16F16;
use flat_physics::Vec2;

use super::{Check, Finding, Outcome, State};

/// The check.
#[derive(Debug)]
pub(super) struct Place {
    slot: Option<usize>,
    number: u16,
    step: u32,
    at: [f64; 2],
    tolerance: f64,
    found: Option<[f64; 2]>,
}

impl Place {
    /// The body by slot and by its number in the scene, the step, where it should be then, and how far off is still right along
    /// each axis, px.
    pub(super) fn new(slot: Option<usize>, number: u16, step: u32, at: Vec2<I16F16>, tolerance: I16F16) -> Self {
        let at = [f64::from(at.x), f64::from(at.y)];
        Self { slot, number, step, at, tolerance: f64::from(tolerance), found: None }
    }
}

impl Check for Place {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        if step == self.step {
            let body = self.slot.and_then(|slot| bodies.get(slot)).filter(|body| body.present);
            // Far from anywhere: a body that is gone is nowhere near.
            self.found = Some(body.map_or([f64::INFINITY; 2], |body| body.position));
        }
    }

    fn finding(&self) -> Finding {
        let off = self.found.map(|[x, y]| (x - self.at[0]).abs().max((y - self.at[1]).abs()));
        let (outcome, got) = match (self.found, off) {
            (Some([x, y]), Some(off)) => {
                let held = off <= self.tolerance;
                (if held { Outcome::Held } else { Outcome::Failed }, format!("at ({x:.4}, {y:.4})"))
            }
            _ => (Outcome::Untested, format!("the run ended before step {}", self.step)),
        };
        Finding {
            check: format!("body {} gets there by step {}", self.number, self.step),
            outcome,
            step: off.map(|_| self.step),
            expected: format!("at ({:.4}, {:.4}) after step {}", self.at[0], self.at[1], self.step),
            got,
            tolerance: format!("{:.4} px along each axis", self.tolerance),
            measured: off,
            limit: Some(self.tolerance),
            unit: "px",
            used: off.filter(|_| self.tolerance > 0.0).map(|off| off / self.tolerance),
        }
    }
}

#[cfg(test)]
mod tests {
    use flat_physics::scalar::{px, ratio};
    use flat_physics::vec2;

    use super::*;
    use crate::check::body::{Body, Extent};

    fn outcome(at_step: u32, position: [f64; 2], present: bool) -> Outcome {
        let mut place = Place::new(Some(0), 7, 2, vec2(px(10), px(20)), ratio(1, 2));
        let body = Body { present, ..Body::at(position, Extent::Circle { radius: 1.0 }) };
        place.observe(&State { step: at_step, bodies: &[body], contacts: &[] });
        place.finding().outcome
    }

    #[test]
    fn the_place_counts_at_its_step_and_along_both_axes() {
        assert_eq!(outcome(2, [10.5, 19.5], true), Outcome::Held);
        assert_eq!(outcome(2, [10.0, 20.6], true), Outcome::Failed);
        assert_eq!(outcome(2, [9.4, 20.0], true), Outcome::Failed);
        assert_eq!(outcome(1, [10.0, 20.0], true), Outcome::Untested);
        assert_eq!(outcome(2, [10.0, 20.0], false), Outcome::Failed, "gone");
    }
}
