//! A step and what can come of it.

use crate::error::Error;

/// Something to verify.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// For `--only`.
    pub(super) name: &'static str,
    /// What it verifies, for people.
    pub(super) title: &'static str,
    /// Steps without whose success this one says nothing.
    pub(super) needs: &'static [&'static str],
    /// Does it.
    pub(super) check: fn() -> Result,
}

/// What came of a step; an error counts as failure.
pub(super) type Result = core::result::Result<Verdict, Error>;

/// What came of a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// It holds; what was found, in a line.
    Passed(String),
    /// It doesn't; what was found, in full.
    Failed(String),
    /// It cannot be said here; why not.
    Skipped(String),
}

impl Step {
    pub(super) const fn new(
        name: &'static str,
        title: &'static str,
        needs: &'static [&'static str],
        check: fn() -> Result,
    ) -> Self {
        Self { name, title, needs, check }
    }
}
