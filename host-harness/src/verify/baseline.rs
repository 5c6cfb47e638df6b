//! The step that holds instruction counts and sizes against the committed ones.

use std::time::Duration;

use super::step::{Result, Verdict};
use crate::baseline::{self, Held};

/// Longest wait for QEMU to get on.
const PATIENCE: Duration = Duration::from_mins(2);

pub(super) fn compare() -> Result {
    Ok(match baseline::compare(PATIENCE)? {
        Held::Yes(text) => Verdict::Passed(text),
        Held::No(changes) => Verdict::Failed(changes),
        Held::Incomparable(why) => Verdict::Skipped(why),
    })
}
