//! Nobody sinks in: the depth of every overlap, all pairs against all, straight from the shapes.

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
        for (slot, a) in bodies.iter().enumerate() {
            for (other, b) in bodies.iter().enumerate().skip(slot + 1) {
                if (a.moves || b.moves) && a.present && b.present && a.solid && b.solid {
                    let depth = overlap(a, b).max(0.0);
                    self.deepest.take(step, depth, || format!("between bodies {slot} and {other}"));
                }
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
