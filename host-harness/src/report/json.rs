//! The report of `rig run` as a file, for scripts and for comparing runs.

use std::time::Duration;

use serde::Serialize;

use super::{Identity, Verdict, seconds};

/// Everything that was found.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    /// Whether every check held and nothing went wrong.
    pub passed: bool,
    /// What went wrong besides checks.
    pub error: Option<String>,
    /// The targets that said hello.
    pub targets: &'a [Identity],
    /// One for each scenario and target.
    pub verdicts: &'a [Verdict],
    /// Wall time of the whole run.
    #[serde(serialize_with = "seconds", rename = "duration_s")]
    pub duration: Duration,
}
