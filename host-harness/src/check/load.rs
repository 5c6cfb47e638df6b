//! A body carries what stands on it: the impulses on it in a step add up to the weight above.

use fixed::types::I16F16;

use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Load {
    slot: Option<usize>,
    number: u16,
    from_step: u32,
    /// Of a step, mass x px/s.
    expected: f64,
    tolerance: f64,
    furthest: Worst,
}

impl Load {
    /// The body by slot and by its number in the scene, from which step on, the sum of impulses in a step, mass x px/s,
    /// and how far off is still right, as a part of that.
    pub(super) fn new(slot: Option<usize>, number: u16, from_step: u32, expected: f64, tolerance: I16F16) -> Self {
        let tolerance = 100.0 * f64::from(tolerance);
        Self { slot, number, from_step, expected, tolerance, furthest: Worst::new(tolerance, "%") }
    }
}

impl Check for Load {
    fn observe(&mut self, state: &State<'_>) {
        let Some(carrier) = self.slot.filter(|_| state.step >= self.from_step) else { return };
        let carried: f64 = state
            .contacts
            .iter()
            .filter(|contact| contact.bodies.contains(&carrier))
            .map(|contact| {
                let [a, b] = contact.bodies.map(|slot| &state.bodies[slot]);
                // Impulses are changes of relative velocity: times the pair's reduced mass they are momentum.
                let inverse = [a, b].map(|body| if body.moves { 1.0 / body.mass } else { 0.0 });
                contact.impulse.abs() / (inverse[0] + inverse[1])
            })
            .sum();
        let off = 100.0 * (carried / self.expected - 1.0).abs();
        self.furthest.take(state.step, off, || format!("off: {carried:.4} mass px/s"));
    }

    fn finding(&self) -> Finding {
        self.furthest.finding(
            format!("load on body {}", self.number),
            format!(
                "{:.4} mass px/s a step to {:.4} %, from step {} on",
                self.expected, self.tolerance, self.from_step
            ),
            &format!("the run ended before step {}, or the scene has no such body", self.from_step),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Contact;
    use crate::check::body::{Body, Extent};
    use crate::check::finding::Outcome;

    #[test]
    fn a_floor_carries_mass_times_change_of_speed() {
        let floor = Body { moves: false, ..Body::at([0.0, 8.0], Extent::Box { half: [50.0, 8.0] }) };
        let heavy = Body { mass: 3.0, ..Body::at([0.0, -6.0], Extent::Circle { radius: 6.0 }) };
        let outcome = |impulse| {
            let mut load = Load::new(Some(0), 0, 1, 30.0, I16F16::from_num(0.001));
            let contacts = [Contact { bodies: [1, 0], impulse }];
            load.observe(&State { step: 1, bodies: &[floor, heavy], contacts: &contacts });
            load.finding().outcome
        };
        assert_eq!(outcome(10.0), Outcome::Held);
        assert_eq!(outcome(10.1), Outcome::Failed);
    }
}
