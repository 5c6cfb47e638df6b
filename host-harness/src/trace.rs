//! What one run of one scenario on one target left: its digests, and what happened to its frames.

use std::time::{Duration, Instant};

use flat_wire::message::{Flip, Frame, Loaded, StreamRequest};

use crate::client::Client;
use crate::drive::{self, End};
use crate::error::Error;
use crate::job::Job;
use crate::report::progress::Progress;
use crate::report::{Counters, Frames};

/// The record of a run.
#[derive(Debug)]
pub struct Trace {
    /// The scene as built.
    pub loaded: Loaded,
    /// Digest after each step, from step 1; none = it never arrived.
    pub digests: Vec<Option<u64>>,
    /// How it ended.
    pub end: End,
    /// The engine's counters at the end, if they arrived.
    pub counters: Option<Counters>,
    /// Frames that made it, and those that didn't.
    pub frames: Frames,
    /// Wall time.
    pub duration: Duration,
}

/// Where a trace parts from the reference's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parting {
    /// The step; 0 = the scene as built.
    pub step: u32,
    /// Digest of the reference.
    pub expected: u64,
    /// Digest of the target.
    pub got: u64,
}

impl Trace {
    /// Runs a job and records it; `on_frame` sees every frame.
    ///
    /// # Errors
    /// If the target refuses, falls silent or goes away.
    pub fn record(
        client: &mut Client,
        job: &Job,
        stream: StreamRequest,
        flip: Option<Flip>,
        mut on_frame: impl FnMut(&Frame),
    ) -> Result<Self, Error> {
        let started = Instant::now();
        let before = client.counters();
        let progress = Progress::new(job.scene.name, client.name(), job.steps);
        let mut digests = vec![None; job.steps as usize];
        let mut counters = None;
        let loaded = drive::load(client, &job.request, stream, flip)?;
        let end = drive::run(client, job.inputs.as_ref(), 0, job.steps, |frame| {
            match frame {
                Frame::Step { step, digest } => {
                    progress.reached(*step);
                    if let Some(slot) = (*step as usize).checked_sub(1).and_then(|index| digests.get_mut(index)) {
                        *slot = Some(*digest);
                    }
                }
                Frame::Statistics(statistics) => counters = Some(Counters::from(statistics)),
                _ => {}
            }
            on_frame(frame);
        })?;
        let after = client.counters();
        let frames = Frames {
            received: after.received - before.received,
            dropped_detail: end.dropped_detail,
            dropped_steps: end.dropped_steps,
            damaged: after.damaged - before.damaged,
            missing: after.missing - before.missing,
        };
        Ok(Self { loaded, digests, end, counters, frames, duration: started.elapsed() })
    }

    /// The first step whose digest differs from the reference's.
    pub fn parts_from(&self, reference: &Self) -> Option<Parting> {
        if self.loaded.digest != reference.loaded.digest {
            return Some(Parting { step: 0, expected: reference.loaded.digest, got: self.loaded.digest });
        }
        (1..).zip(reference.digests.iter().zip(&self.digests)).find_map(|(step, digests)| match digests {
            (Some(expected), Some(got)) if expected != got => Some(Parting { step, expected: *expected, got: *got }),
            _ => None,
        })
    }

    /// Steps whose digest never arrived.
    pub fn missing(&self) -> impl Iterator<Item = u32> {
        (1..).zip(&self.digests).filter(|(_, digest)| digest.is_none()).map(|(step, _)| step)
    }
}
