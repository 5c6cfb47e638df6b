//! Two figures of every step, for those who plot a run.

use super::body::Body;
use super::penetration::overlap;

/// A run over time, in `f64` from the bodies alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Deepest overlap of any two bodies of which one can move, px; 0 if none overlap.
    pub overlap: Vec<f64>,
    /// Kinetic and potential energy of all bodies that can move, mass x px2/s2; potential energy is 0 at y = 0.
    pub energy: Vec<f64>,
}

impl Series {
    /// Adds a step; gravity in px/s2 downwards.
    pub(super) fn add(&mut self, bodies: &[Body], gravity: f64) {
        let present = || bodies.iter().filter(|body| body.present);
        let mut deepest: f64 = 0.0;
        for (index, a) in present().enumerate() {
            for b in present().skip(index + 1).filter(|b| a.moves || b.moves) {
                deepest = deepest.max(overlap(a, b));
            }
        }
        let energy = |body: &Body| {
            let [vx, vy] = body.velocity;
            body.mass * (f64::midpoint(vx * vx, vy * vy) - gravity * body.gravity_scale * body.position[1])
        };
        self.overlap.push(deepest);
        self.energy.push(present().filter(|body| body.moves).map(energy).sum());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::body::Extent;

    #[test]
    fn energy_and_overlap_are_those_of_the_textbook() {
        let ball = |x, y, velocity| Body { velocity, mass: 2.0, ..Body::at([x, y], Extent::Circle { radius: 5.0 }) };
        let wall = Body { moves: false, ..ball(0.0, 100.0, [0.0; 2]) };
        let mut series = Series::default();
        series.add(&[ball(0.0, -10.0, [3.0, 4.0]), ball(4.0, -7.0, [0.0; 2]), wall, wall], 200.0);
        // m v^2 / 2 + m g h: 2 * 12.5 + 2 * 200 * 10 + 2 * 200 * 7.
        assert_eq!(series.energy, [6825.0]);
        assert_eq!(series.overlap, [5.0], "the walls overlap each other, which nobody can help");
    }
}
