//! Left and right are treated alike: what starts with opposite velocities moves by opposite amounts.

use flat_wire::message::ScalarKind;

use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Opposite {
    scalar: ScalarKind,
    numbers: [u16; 2],
    slots: [Option<usize>; 2],
    sum: Worst,
}

impl Opposite {
    /// The two bodies, by number in the scene and by slot.
    pub(super) fn new(scalar: ScalarKind, numbers: [u16; 2], slots: [Option<usize>; 2]) -> Self {
        Self { scalar, numbers, slots, sum: Worst::new(0.0, "px") }
    }
}

impl Check for Opposite {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let [Some(a), Some(b)] = self.slots.map(|slot| bodies.get(slot?)) else { return };
        let sum = [0, 1].map(|axis| a.position[axis] - a.start[axis] + b.position[axis] - b.start[axis]);
        self.sum.take(step, sum[0].abs().max(sum[1].abs()), String::new);
    }

    fn finding(&self) -> Finding {
        let [a, b] = self.numbers;
        let finding = self.sum.finding(
            format!("bodies {a} and {b} move by opposite amounts"),
            "the sum of their ways is 0 px, at every step".into(),
            "the scene has no such bodies",
        );
        match self.scalar {
            ScalarKind::Fixed => finding,
            ScalarKind::F32 | ScalarKind::F64 => finding.excused("floats round by where they are"),
        }
    }
}
