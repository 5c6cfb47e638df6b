//! A body keeps to its beat: its centre stays inside a rectangle, at every step.

use fixed::types::I16F16;
use flat_physics::Vec2;

use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Stays {
    slot: Option<usize>,
    number: u16,
    min: [f64; 2],
    max: [f64; 2],
    outside: Worst,
}

impl Stays {
    /// The body by slot and by its number in the scene, the rectangle, and how far outside is still inside, px.
    pub(super) fn new(slot: Option<usize>, number: u16, [min, max]: [Vec2<I16F16>; 2], tolerance: I16F16) -> Self {
        let corner = |corner: Vec2<I16F16>| [f64::from(corner.x), f64::from(corner.y)];
        let outside = Worst::new(f64::from(tolerance), "px");
        Self { slot, number, min: corner(min), max: corner(max), outside }
    }
}

impl Check for Stays {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let Some(body) = self.slot.and_then(|slot| bodies.get(slot)) else {
            return;
        };
        let [x, y] = [0, 1].map(|axis| {
            let place = body.position[axis];
            (self.min[axis] - place).max(place - self.max[axis]).max(0.0)
        });
        let out = if body.present { x.max(y) } else { f64::INFINITY };
        self.outside.take(step, out, || format!("outside, at ({:.3}, {:.3})", body.position[0], body.position[1]));
    }

    fn finding(&self) -> Finding {
        let ([left, top], [right, bottom]) = (self.min, self.max);
        self.outside.finding(
            format!("body {} keeps to its beat", self.number),
            format!("its centre within x {left}..{right}, y {top}..{bottom} px, at every step"),
            "the scene has no such body",
        )
    }
}

#[cfg(test)]
mod tests {
    use flat_physics::scalar::px;
    use flat_physics::vec2;

    use super::*;
    use crate::check::Outcome;
    use crate::check::body::{Body, Extent};

    fn outcome(position: [f64; 2], present: bool) -> Outcome {
        let mut check = Stays::new(Some(0), 0, [vec2(px(0), px(10)), vec2(px(20), px(10))], px(1));
        let body = Body { present, ..Body::at(position, Extent::Circle { radius: 9.0 }) };
        check.observe(&State { step: 1, bodies: &[body], contacts: &[] });
        check.finding().outcome
    }

    #[test]
    fn its_centre_counts_along_both_axes() {
        assert_eq!(outcome([-1.0, 11.0], true), Outcome::Held);
        assert_eq!(outcome([21.5, 10.0], true), Outcome::Failed);
        assert_eq!(outcome([5.0, 8.5], true), Outcome::Failed);
        assert_eq!(outcome([5.0, 10.0], false), Outcome::Failed, "gone");
    }
}
