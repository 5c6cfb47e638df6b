//! Promises in words.

use std::fmt;

use fixed::types::I16F16;
use flat_scenes::Promise;

/// A promise in words.
#[derive(Debug)]
pub struct Words<'a>(pub &'a Promise);

impl fmt::Display for Words<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |part: I16F16| 100.0 * f64::from(part);
        let whose = |body: Option<u16>| body.map_or_else(String::new, |body| format!(" of body {body}"));
        match *self.0 {
            Promise::Within { min, max, tolerance } => {
                let (x, y) = ((min.x, max.x), (min.y, max.y));
                write!(f, "all stay within x {}..{}, y {}..{}, +-{tolerance:.2} px", x.0, x.1, y.0, y.1)
            }
            Promise::Penetration { from, at_most } => write!(f, "no overlap above {at_most:.3} px from step {from}"),
            Promise::Rest { from, body, at_most } => {
                write!(f, "no speed{} above {at_most:.3} px/s from step {from}", whose(body))
            }
            Promise::Still { from } => write!(f, "no bit of any body changes from step {from}"),
            Promise::Down { at_most } => write!(f, "nothing moves up faster than {at_most:.3} px/s"),
            Promise::Apex { body, bounce, y, tolerance } => {
                write!(f, "bounce {bounce} of body {body} peaks at y {y:.2} +-{tolerance:.2} px")
            }
            Promise::Energy { from, body, at_least, at_most } => {
                let (low, high) = (percent(at_least), percent(at_most));
                write!(f, "energy{} within {low:.2}..{high:.2} % from step {from}", whose(body))
            }
            Promise::Momentum => write!(f, "momentum changes by at most 1 LSB a contact"),
            Promise::CentreOfMass { at_most } => {
                write!(f, "the centre of mass keeps its horizontal speed to {at_most:.3} px/s")
            }
            Promise::Parabola { at_most } => write!(f, "p + v t + g t^2 / 2 to {at_most:.4} px"),
            Promise::Travel { tolerance } => write!(f, "v t to {:.3} %", percent(tolerance)),
            Promise::Opposite { bodies: [a, b] } => write!(f, "bodies {a} and {b} move by opposite amounts"),
            Promise::Terminal { damping, tolerance } => {
                write!(f, "v <- (v + g / 60) {damping:.3} to {:.2} %", percent(tolerance))
            }
            Promise::StopDistance { body, distance, tolerance } => {
                write!(f, "body {body} stops after {distance:.3} px +-{:.1} %", percent(tolerance))
            }
            Promise::Slip { bodies: [a, b], at_most } => {
                write!(f, "body {b} moves along body {a} by at most {at_most:.3} px")
            }
            Promise::Steady => write!(f, "no velocity changes, and nothing moves across it"),
            Promise::Sides => write!(f, "no shot gets past its target"),
            Promise::Load { body, from, mass, tolerance } => {
                let tolerance = percent(tolerance);
                write!(f, "body {body} carries a mass of {mass:.2} +-{tolerance:.2} % from step {from}")
            }
            Promise::Place { body, step, at, tolerance } => {
                write!(f, "body {body} is at ({:.1}, {:.1}) +-{tolerance:.2} px after step {step}", at.x, at.y)
            }
            Promise::Stays { body, min, max, tolerance } => {
                let (x, y) = ((min.x, max.x), (min.y, max.y));
                write!(f, "body {body} stays within x {}..{}, y {}..{}, +-{tolerance:.2} px", x.0, x.1, y.0, y.1)
            }
            Promise::OutOfTiles { body, at_most } => {
                write!(f, "body {body} never reaches deeper than {at_most:.3} px into a solid tile")
            }
        }
    }
}
