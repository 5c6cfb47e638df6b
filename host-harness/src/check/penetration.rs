//! Nobody sinks in: the depth of every overlap of any two, straight from the shapes.

use fixed::types::I16F16;

use super::body::Extent;
use super::worst::Worst;
use super::{Body, Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct Penetration {
    from_step: u32,
    at_most: f64,
    deepest: Worst,
}

impl Penetration {
    /// From which step on, and the limit in px.
    pub(super) fn new(from_step: u32, at_most: I16F16) -> Self {
        let at_most = f64::from(at_most);
        Self { from_step, at_most, deepest: Worst::new(at_most, "px") }
    }
}

impl Check for Penetration {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        if step < self.from_step {
            return;
        }
        let edges = |body: &Body| {
            let (x, half) = (body.position[0], body.half_extent()[0]);
            // Not a number is near everything, and too deep in it.
            if x.is_nan() { [f64::NEG_INFINITY, f64::INFINITY] } else { [x - half, x + half] }
        };
        let mut sorted: Vec<_> = (0..).zip(bodies).filter(|(_, body)| body.present && body.solid).collect();
        sorted.sort_by(|(_, a), (_, b)| edges(a)[0].total_cmp(&edges(b)[0]));
        let moving = sorted.iter().filter(|(_, body)| body.moves).count();
        if moving > 0 && sorted.len() > 1 {
            self.deepest.take(step, 0.0, || "anywhere".into());
        }
        for (place, (slot, a)) in sorted.iter().enumerate() {
            // Whoever begins to the right of where `a` ends is apart from it.
            let near = sorted[place + 1..].iter().take_while(|(_, b)| edges(b)[0] <= edges(a)[1]);
            for (other, b) in near.filter(|(_, b)| a.moves || b.moves) {
                let depth = overlap(a, b);
                let depth = if depth < 0.0 { 0.0 } else { depth };
                let [first, second]: [usize; 2] = if slot < other { [*slot, *other] } else { [*other, *slot] };
                self.deepest.take(step, depth, || format!("between bodies {first} and {second}"));
            }
        }
    }

    fn finding(&self) -> Finding {
        self.deepest.finding(
            "no deep overlap".into(),
            format!("at most {:.4} px from step {} on", self.at_most, self.from_step),
            &format!("the run ended before step {}, or there is no pair", self.from_step),
        )
    }
}

/// How far two shapes overlap: the shortest way to pull them apart, px; negative when they are apart.
pub(super) fn overlap(a: &Body, b: &Body) -> f64 {
    let offset = [0, 1].map(|axis| b.position[axis] - a.position[axis]);
    match (a.extent, b.extent) {
        (Extent::Circle { radius: a }, Extent::Circle { radius: b }) => a + b - offset[0].hypot(offset[1]),
        (Extent::Box { half: a }, Extent::Box { half: b }) => {
            let [x, y] = [0, 1].map(|axis| a[axis] + b[axis] - offset[axis].abs());
            x.min(y)
        }
        (Extent::Box { half }, Extent::Circle { radius }) | (Extent::Circle { radius }, Extent::Box { half }) => {
            // From the box's surface to the circle's centre, per axis; positive outside.
            let [x, y] = [0, 1].map(|axis| offset[axis].abs() - half[axis]);
            if x <= 0.0 && y <= 0.0 { radius - x.max(y) } else { radius - x.max(0.0).hypot(y.max(0.0)) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Outcome;

    #[test]
    fn any_pair_counts_that_can_move_wherever_it_lies() {
        let found = |bodies: &[Body]| {
            let mut check = Penetration::new(1, I16F16::ZERO);
            check.observe(&State { step: 1, bodies, contacts: &[] });
            let finding = check.finding();
            (finding.outcome, finding.measured, finding.got)
        };
        let wall = Body { moves: false, ..square(0.0, 0.0, 50.0) };
        let (apart, inside) = (circle(60.0, 0.0, 5.0), circle(53.0, 40.0, 5.0));
        let (outcome, measured, got) = found(&[apart, inside, wall]);
        assert_eq!((outcome, measured), (Outcome::Failed, Some(2.0)));
        assert!(got.contains("between bodies 1 and 2"), "{got}");
        assert_eq!(found(&[apart, wall]).0, Outcome::Held);
        assert_eq!(found(&[wall, wall]).0, Outcome::Untested);
        assert_eq!(found(&[apart]).0, Outcome::Untested);
        let nowhere = circle(f64::NAN, 0.0, 5.0);
        assert_eq!(found(&[apart, nowhere]).0, Outcome::Failed);
    }

    fn circle(x: f64, y: f64, radius: f64) -> Body {
        Body::at([x, y], Extent::Circle { radius })
    }

    fn square(x: f64, y: f64, half: f64) -> Body {
        Body::at([x, y], Extent::Box { half: [half, half] })
    }

    #[test]
    fn overlap_is_the_shortest_way_out() {
        let cases = [
            (circle(0.0, 0.0, 5.0), circle(3.0, 4.0, 1.0), 1.0),
            (circle(0.0, 0.0, 1.0), circle(0.0, 0.0, 2.0), 3.0),
            (square(0.0, 0.0, 2.0), square(3.0, 1.0, 2.0), 1.0),
            (square(0.0, 0.0, 2.0), square(5.0, 0.0, 2.0), -1.0),
            // At a face, at a corner, and with the centre inside, nearest to the right face.
            (square(0.0, 0.0, 2.0), circle(0.0, 4.0, 2.5), 0.5),
            (square(0.0, 0.0, 2.0), circle(5.0, 6.0, 5.5), 0.5),
            (square(0.0, 0.0, 2.0), circle(1.5, 0.0, 1.0), 1.5),
        ];
        for (a, b, expected) in cases {
            assert!((overlap(&a, &b) - expected).abs() < 1e-12, "{a:?} {b:?}: {}", overlap(&a, &b));
            assert!((overlap(&b, &a) - expected).abs() < 1e-12, "the other way round");
        }
    }
}
