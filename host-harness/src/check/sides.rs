//! No shot gets through its target: of every pair, the first stays to the left of the second.

use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Sides {
    /// How far a shot's centre is past its target's.
    past: Worst,
}

impl Sides {
    /// Pairs are the numbers 0 and 1, 2 and 3, and so on.
    pub(super) fn new() -> Self {
        Self { past: Worst::new(0.0, "px") }
    }
}

impl Check for Sides {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let mut by_number: Vec<_> = bodies.iter().collect();
        by_number.sort_unstable_by_key(|body| body.number);
        for pair in by_number.chunks_exact(2) {
            let past = (pair[0].position[0] - pair[1].position[0]).max(0.0);
            self.past.take(step, past, || format!("body {} past body {}", pair[0].number, pair[1].number));
        }
    }

    fn finding(&self) -> Finding {
        self.past.finding(
            "nothing gets through".into(),
            "every shot stays on its side of its target, at every step".into(),
            "the scene has no pair",
        )
    }
}
