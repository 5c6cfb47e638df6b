//! One body rides on another and doesn't slip.

use fixed::types::I16F16;

use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Slip {
    numbers: [u16; 2],
    slots: [Option<usize>; 2],
    at_most: f64,
    furthest: Worst,
}

impl Slip {
    /// The two bodies, by number in the scene and by slot, and how far one may move along the other, px.
    pub(super) fn new(numbers: [u16; 2], slots: [Option<usize>; 2], at_most: I16F16) -> Self {
        let at_most = f64::from(at_most);
        Self { numbers, slots, at_most, furthest: Worst::new(at_most, "px") }
    }
}

impl Check for Slip {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let [Some(a), Some(b)] = self.slots.map(|slot| bodies.get(slot?)) else { return };
        let slip = (b.position[0] - b.start[0]) - (a.position[0] - a.start[0]);
        self.furthest.take(step, slip.abs(), String::new);
    }

    fn finding(&self) -> Finding {
        let [a, b] = self.numbers;
        self.furthest.finding(
            format!("body {b} doesn't slip on body {a}"),
            format!("at most {:.4} px, at every step", self.at_most),
            "the scene has no such bodies",
        )
    }
}
