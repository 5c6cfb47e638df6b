//! Nobody leaves: the whole extent of every body that can move stays inside a rectangle, at every step.

use fixed::types::I16F16;
use flat_physics::Vec2;

use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Within {
    min: [f64; 2],
    max: [f64; 2],
    tolerance: f64,
    outside: Worst,
}

impl Within {
    /// The rectangle, and how far outside is still within, px.
    pub(super) fn new(min: Vec2<I16F16>, max: Vec2<I16F16>, tolerance: I16F16) -> Self {
        let corner = |corner: Vec2<I16F16>| [f64::from(corner.x), f64::from(corner.y)];
        let tolerance = f64::from(tolerance);
        Self { min: corner(min), max: corner(max), tolerance, outside: Worst::new(tolerance, "px") }
    }
}

impl Check for Within {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        for (slot, body) in bodies.iter().enumerate().filter(|(_, body)| body.moves) {
            if !body.present {
                self.outside.take(step, f64::INFINITY, || format!("outside: body {slot} is gone from the world"));
                continue;
            }
            let half = body.half_extent();
            let [x, y] = [0, 1].map(|axis| {
                let low = self.min[axis] - (body.position[axis] - half[axis]);
                let high = body.position[axis] + half[axis] - self.max[axis];
                low.max(high)
            });
            self.outside.take(step, x.max(y), || {
                format!("outside: body {slot} at ({:.3}, {:.3})", body.position[0], body.position[1])
            });
        }
    }

    fn finding(&self) -> Finding {
        let ([left, top], [right, bottom]) = (self.min, self.max);
        Finding {
            tolerance: format!("{:.4} px", self.tolerance),
            ..self.outside.finding(
                "nobody leaves".into(),
                format!("every body within x {left}..{right}, y {top}..{bottom} px, at every step"),
                "no body that can move",
            )
        }
    }
}
