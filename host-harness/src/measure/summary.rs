//! A series of counts, one a step, in three numbers.

use std::ops::Range;

use serde::Serialize;

/// What a series comes down to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Mean over the window: the part of the run that stands for the scene at rest or in its steady state.
    pub mean: f64,
    /// 99 of 100 steps of the whole run cost at most this (nearest rank).
    pub p99: u64,
    /// The dearest step of the whole run.
    pub worst: u64,
    /// Which that was, counted from 1.
    pub worst_step: u32,
}

impl Summary {
    /// Of a count for each step, the mean over a window of their indices; all zero if there are none.
    pub fn of(counts: &[u64], window: Range<usize>) -> Self {
        let Some((worst_index, &worst)) = counts.iter().enumerate().rev().max_by_key(|(_, count)| **count) else {
            return Self::default();
        };
        let within = counts.get(window).filter(|part| !part.is_empty()).unwrap_or(counts);
        let mean = within.iter().sum::<u64>() as f64 / within.len() as f64;
        let mut sorted = counts.to_vec();
        sorted.sort_unstable();
        let rank = (sorted.len() * 99).div_ceil(100);
        Self { mean, p99: sorted[rank - 1], worst, worst_step: worst_index as u32 + 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_is_of_the_window_and_the_rest_of_the_whole_run() {
        let mut counts = vec![10; 200];
        counts[3] = 90;
        counts[4] = 90;
        counts[5] = 50;
        counts[150] = 20;
        let summary = Summary::of(&counts, 100..200);
        assert_eq!(summary, Summary { mean: 10.1, p99: 50, worst: 90, worst_step: 4 });
    }

    #[test]
    fn a_single_step_is_its_own_summary_and_none_is_zero() {
        assert_eq!(Summary::of(&[7], 0..1), Summary { mean: 7.0, p99: 7, worst: 7, worst_step: 1 });
        assert_eq!(Summary::of(&[], 0..0), Summary::default());
    }
}
