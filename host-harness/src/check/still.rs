//! Nothing moves, not by a bit: position, velocity and what rounding carries over.

use flat_wire::message::BodyState;

use super::{Check, Finding, Outcome, State};

/// The check.
#[derive(Debug)]
pub(super) struct Still {
    from_step: u32,
    before: Vec<Option<BodyState>>,
    /// Step and slot of the first change from `from_step` on, and of the last of all.
    first: Option<(u32, usize)>,
    last: Option<(u32, usize)>,
    reached: u32,
}

impl Still {
    /// The first step that must be like the one before.
    pub(super) fn new(from_step: u32) -> Self {
        Self { from_step, before: Vec::new(), first: None, last: None, reached: 0 }
    }
}

impl Check for Still {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let now: Vec<_> = bodies.iter().map(|body| body.state.filter(|_| body.moves && body.present)).collect();
        if let Some(slot) = now.iter().zip(&self.before).position(|(now, before)| now != before) {
            self.last = Some((step, slot));
            if step >= self.from_step {
                self.first = self.first.or(self.last);
            }
        }
        self.before = now;
        self.reached = step;
    }

    fn finding(&self) -> Finding {
        let from = self.from_step;
        let (outcome, step, got) = match (self.first, self.last) {
            _ if self.reached < from => (Outcome::Untested, None, format!("the run ended before step {from}")),
            (Some((step, slot)), Some((last, _))) => {
                (Outcome::Failed, Some(step), format!("body {slot} changed; the last change is at step {last}"))
            }
            (_, last) => (Outcome::Held, last.map(|(step, _)| step), "the last change of any body".into()),
        };
        Finding {
            check: "bitwise still".into(),
            outcome,
            step,
            expected: format!("no bit of any body changes from step {from} on"),
            got,
            tolerance: "0 bits".into(),
            measured: Some(self.last.map_or(0.0, |(step, _)| step.into())),
            limit: Some((from - 1).into()),
            unit: "steps",
            used: (self.reached >= from)
                .then(|| self.last.map_or(0.0, |(step, _)| f64::from(step) / f64::from((from - 1).max(1)))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::body::{Body, Extent};

    /// Lowest bit of a body's position, step by step.
    fn outcome(from: u32, bits: &[i64]) -> (Outcome, Option<f64>) {
        let mut still = Still::new(from);
        for (step, &bit) in (1..).zip(bits) {
            let state = BodyState { slot: 0, position: [bit, 0], velocity: [0; 2], remainder: [0; 2] };
            let body = Body { state: Some(state), ..Body::at([0.0; 2], Extent::Circle { radius: 1.0 }) };
            still.observe(&State { step, bodies: &[body], contacts: &[] });
        }
        let finding = still.finding();
        (finding.outcome, finding.measured)
    }

    #[test]
    fn one_bit_is_a_change_and_only_from_the_step_on() {
        assert_eq!(outcome(4, &[1, 2, 3, 3, 3]), (Outcome::Held, Some(3.0)));
        assert_eq!(outcome(3, &[1, 2, 3, 3, 3]), (Outcome::Failed, Some(3.0)));
        assert_eq!(outcome(2, &[5, 5, 5, 5, 4]), (Outcome::Failed, Some(5.0)));
        assert_eq!(outcome(6, &[1, 1, 1]).0, Outcome::Untested);
    }
}
