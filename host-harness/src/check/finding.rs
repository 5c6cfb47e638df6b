//! What came of a check.

use flat_scenes::Shortfall;
use serde::Serialize;

/// How a check came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// What was expected.
    Held,
    /// Not what was expected.
    Failed,
    /// Not what was expected, but no worse than is known.
    Short,
    /// The check has nothing to say: `got` says why.
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
    /// Part of what is allowed that was used: up to 1 it held. None where there is no more or less, or nothing to say.
    pub used: Option<f64>,
}

impl Finding {
    /// The same, short instead of failed if that shortfall is known and has not got worse.
    pub(super) fn known(self, shortfalls: &[Shortfall]) -> Self {
        let known = |shortfall: &&Shortfall| {
            self.check.starts_with(shortfall.check)
                && self.measured.is_some_and(|measured| measured <= f64::from(shortfall.figure))
        };
        match shortfalls.iter().find(known) {
            Some(_) if self.outcome == Outcome::Failed => Self { outcome: Outcome::Short, ..self },
            _ => self,
        }
    }

    /// The same with nothing to say: the promise isn't made for this number format.
    pub(super) fn excused(self, why: &str) -> Self {
        Self { outcome: Outcome::Untested, got: format!("not promised for this number format: {why}"), ..self }
    }

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
            used: None,
        }
    }
}
