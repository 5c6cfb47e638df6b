//! What one run cost.

use std::ops::Range;

use flat_wire::message::STAGES;

use super::summary::Summary;
use crate::report::Counters;

/// Counts of a run, in the unit of the meter that took them.
#[derive(Clone, Debug)]
pub struct Sample {
    /// For each step, what each stage took.
    pub steps: Vec<[u32; STAGES]>,
    /// Digest of the final state.
    pub digest: u64,
    /// Bodies in the world, static ones included.
    pub in_world: u16,
    /// The engine's counters at the end.
    pub counters: Counters,
}

impl Sample {
    /// The window of a run of so many steps over which means are taken: its second half.
    pub fn window(steps: usize) -> Range<usize> {
        steps / 2..steps
    }

    /// One stage's counts.
    pub fn stage(&self, stage: usize) -> Vec<u64> {
        self.steps.iter().map(|counts| u64::from(counts[stage])).collect()
    }

    /// Whole steps.
    pub fn totals(&self) -> Vec<u64> {
        self.steps.iter().map(|counts| counts.iter().map(|&count| u64::from(count)).sum()).collect()
    }

    /// Each stage's summary.
    pub fn stages(&self) -> [Summary; STAGES] {
        std::array::from_fn(|stage| Summary::of(&self.stage(stage), Self::window(self.steps.len())))
    }

    /// The summary of whole steps: its worst is the worst step, not the sum of each stage's worst.
    pub fn total(&self) -> Summary {
        Summary::of(&self.totals(), Self::window(self.steps.len()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_step_is_no_sum_of_each_stages_worst() {
        let steps = vec![[10, 0, 1, 0, 0, 0], [2, 0, 8, 0, 0, 0]];
        let sample = Sample { steps, digest: 0, in_world: 2, counters: Counters::default() };
        assert_eq!((sample.total().worst, sample.total().worst_step), (11, 1));
        assert_eq!(sample.stages().map(|stage| stage.worst), [10, 0, 8, 0, 0, 0]);
    }
}
