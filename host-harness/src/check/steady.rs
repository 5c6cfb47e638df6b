//! Sliding bodies feel nothing: velocity stays as it is, and so does the place across it.

use super::worst::Worst;
use super::{Body, Check, Finding, State};

/// What rounding a velocity may make of it, px/s: half of the coarsest resolution, binary32's at 500 px/s.
const ROUNDING: f64 = 3e-5;

/// The check.
#[derive(Debug)]
pub(super) struct Steady {
    /// Velocities after the first step, by slot.
    first: Vec<[f64; 2]>,
    change: Worst,
}

impl Steady {
    /// Nothing seen yet.
    pub(super) fn new() -> Self {
        Self { first: Vec::new(), change: Worst::new(0.0, "px or px/s") }
    }

    /// How far the start velocity was missed, beyond rounding.
    fn missed(body: &Body) -> f64 {
        let off = [0, 1].map(|axis| (body.velocity[axis] - body.start_velocity[axis]).abs());
        (off[0].max(off[1]) - ROUNDING).max(0.0)
    }
}

impl Check for Steady {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        if self.first.is_empty() {
            self.first = bodies.iter().map(|body| body.velocity).collect();
        }
        for (slot, (body, first)) in bodies.iter().zip(&self.first).enumerate().filter(|(_, (body, _))| body.moves) {
            let changed = [0, 1].map(|axis| (body.velocity[axis] - first[axis]).abs());
            let across = [0, 1].map(|axis| {
                let moves = body.start_velocity[axis] != 0.0;
                if moves { 0.0 } else { (body.position[axis] - body.start[axis]).abs() }
            });
            let worst = changed.into_iter().chain(across).fold(Self::missed(body), f64::max);
            self.change.take(step, worst, || format!("by body {slot}"));
        }
    }

    fn finding(&self) -> Finding {
        self.change.finding(
            "slides undisturbed".into(),
            "no bit of a velocity changes, nor of the place across it, at every step".into(),
            "no body that can move",
        )
    }
}
