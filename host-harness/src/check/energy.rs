//! Energy is kept, or at least doesn't grow: kinetic and potential, the latter 0 at the scene's origin.

use fixed::types::I16F16;

use super::{Body, Check, Finding, Outcome, State};

/// The check.
#[derive(Debug)]
pub(super) struct Energy {
    from_step: u32,
    body: Option<u16>,
    share: [f64; 2],
    gravity: f64,
    /// Step and share that lie furthest outside the bounds, or nearest to one.
    worst: Option<(u32, f64)>,
}

impl Energy {
    /// From which step on, whose (none = the sum over all), the bounds as shares of the energy at the start, and gravity,
    /// px/s2.
    pub(super) fn new(from_step: u32, body: Option<u16>, share: [I16F16; 2], gravity: f64) -> Self {
        Self { from_step, body, share: share.map(f64::from), gravity, worst: None }
    }

    fn sum(&self, bodies: &[Body], state: impl Fn(&Body) -> ([f64; 2], [f64; 2])) -> f64 {
        let wanted = |body: &&Body| body.moves && self.body.is_none_or(|number| number == body.number);
        bodies
            .iter()
            .filter(wanted)
            .map(|body| {
                let ([_, y], [vx, vy]) = state(body);
                body.mass * (f64::midpoint(vx * vx, vy * vy) - self.gravity * body.gravity_scale * y)
            })
            .sum()
    }

    /// How far a share lies outside the bounds; negative inside.
    fn outside(&self, share: f64) -> f64 {
        (self.share[0] - share).max(share - self.share[1])
    }
}

impl Check for Energy {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        if step < self.from_step {
            return;
        }
        let start = self.sum(bodies, |body| (body.start, body.start_velocity));
        let share = self.sum(bodies, |body| (body.position, body.velocity)) / start;
        if self.worst.is_none_or(|(_, worst)| share.is_nan() || self.outside(share) > self.outside(worst)) {
            self.worst = Some((step, share));
        }
    }

    fn finding(&self) -> Finding {
        let [low, high] = self.share.map(|share| 100.0 * share);
        let (outcome, got) = match self.worst {
            None => (Outcome::Untested, format!("the run ended before step {}", self.from_step)),
            Some((_, share)) => {
                let held = self.outside(share) <= 0.0;
                (if held { Outcome::Held } else { Outcome::Failed }, format!("{:.4} %", 100.0 * share))
            }
        };
        let whose = self.body.map_or_else(String::new, |body| format!(" of body {body}"));
        Finding {
            check: format!("energy{whose}"),
            outcome,
            step: self.worst.map(|(step, _)| step),
            expected: format!("{low:.4}..{high:.4} % of the start's from step {} on", self.from_step),
            got,
            tolerance: "the bounds are exact".into(),
            measured: self.worst.map(|(_, share)| 100.0 * share),
            limit: self.worst.map(|(_, share)| if share < 1.0 && low > 0.0 { low } else { high }),
            unit: "%",
            // From the start's energy to the nearer bound.
            used: self.worst.map(|(_, share)| {
                let (gone, allowed) =
                    if share < 1.0 { (1.0 - share, 1.0 - self.share[0]) } else { (share - 1.0, self.share[1] - 1.0) };
                if gone == 0.0 { 0.0 } else { gone / allowed.max(0.0) }
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::body::Extent;

    #[test]
    fn a_fall_keeps_its_energy_and_a_push_adds_to_it() {
        let one = I16F16::ONE;
        let mut energy = Energy::new(1, None, [one - I16F16::DELTA, one + I16F16::DELTA], 200.0);
        let start = Body::at([0.0, -100.0], Extent::Circle { radius: 1.0 });
        let fallen = Body { position: [0.0, -50.0], velocity: [0.0, 20_000f64.sqrt()], ..start };
        energy.observe(&State { step: 1, bodies: &[fallen], contacts: &[] });
        assert_eq!(energy.finding().outcome, Outcome::Held, "{:?}", energy.finding());
        let pushed = Body { velocity: [1.0, fallen.velocity[1]], ..fallen };
        energy.observe(&State { step: 2, bodies: &[pushed], contacts: &[] });
        assert_eq!((energy.finding().outcome, energy.finding().step), (Outcome::Failed, Some(2)));
    }
}
