//! A scene's promises, checked on the state of every step in `f64`, by code that shares nothing with the engine.

mod apex;
mod body;
mod penetration;
mod rest;
mod within;
mod worst;

use std::fmt;

use flat_scenes::Promise;
use serde::Serialize;

pub use body::{Bodies, Body};

/// Watches one promise over a run.
pub trait Check {
    /// Looks at the state after a step.
    fn observe(&mut self, step: u32, bodies: &[Body]);
    /// What came of it.
    fn finding(&self) -> Finding;
}

/// How a check came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// What was expected.
    Held,
    /// Not what was expected.
    Failed,
    /// The run ended before the check could say anything.
    Untested,
}

/// A check's result.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// What was checked.
    pub check: String,
    /// How it came out.
    pub outcome: Outcome,
    /// The step that decided it: of the first failure, otherwise of the worst value.
    pub step: Option<u32>,
    /// What was expected.
    pub expected: String,
    /// What was found.
    pub got: String,
    /// By how much the two may differ.
    pub tolerance: String,
    /// The worst value of the run, in `unit`.
    pub measured: Option<f64>,
    /// The value that it is held against, in `unit`.
    pub limit: Option<f64>,
    /// Unit of both.
    pub unit: &'static str,
}

impl Finding {
    /// Whether as many things arrived as should; `why` says what became of the others.
    pub fn count(check: &str, expected: u32, got: u32, why: &str) -> Self {
        Self {
            check: check.into(),
            outcome: if expected == got { Outcome::Held } else { Outcome::Failed },
            step: None,
            expected: expected.to_string(),
            got: format!("{got}{why}"),
            tolerance: "0".into(),
            measured: Some(got.into()),
            limit: Some(expected.into()),
            unit: "",
        }
    }
}

/// One check for every promise.
pub fn checks(promises: &[Promise], bodies: &Bodies) -> Vec<Box<dyn Check>> {
    promises
        .iter()
        .map(|promise| -> Box<dyn Check> {
            match *promise {
                Promise::Within { min, max, tolerance } => Box::new(within::Within::new(min, max, tolerance)),
                Promise::Penetration { from, at_most } => Box::new(penetration::Penetration::new(from, at_most)),
                Promise::Rest { from, at_most } => Box::new(rest::Rest::new(from, at_most)),
                Promise::Apex { body, bounce, y, tolerance } => {
                    Box::new(apex::Apex::new(bodies.slot_of(body), body, bounce, y, tolerance))
                }
            }
        })
        .collect()
}

/// A promise in words.
pub struct Words<'a>(pub &'a Promise);

impl fmt::Display for Words<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Promise::Within { min, max, tolerance } => {
                let (x, y) = ((min.x, max.x), (min.y, max.y));
                write!(f, "all stay within x {}..{}, y {}..{}, +-{tolerance:.2} px", x.0, x.1, y.0, y.1)
            }
            Promise::Penetration { from, at_most } => write!(f, "no overlap above {at_most:.3} px from step {from}"),
            Promise::Rest { from, at_most } => write!(f, "no speed above {at_most:.3} px/s from step {from}"),
            Promise::Apex { body, bounce, y, tolerance } => {
                write!(f, "bounce {bounce} of body {body} peaks at y {y:.2} +-{tolerance:.2} px")
            }
        }
    }
}
