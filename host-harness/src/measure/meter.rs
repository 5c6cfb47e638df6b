//! A target that counts what its stages take.

use flat_wire::message::{Capacity, Counter, Frame, STAGES, ScalarKind, StreamRequest};

use super::sample::Sample;
use crate::client::Client;
use crate::drive;
use crate::error::Error;
use crate::job::Job;
use crate::report::Identity;
use crate::target::{Means, Target};
use crate::trace::Trace;

/// A target with a counter.
pub struct Meter {
    client: Client,
    /// Who it is.
    pub identity: Identity,
    /// What it counts.
    pub unit: Counter,
    /// Whether it may be a chip, and no emulation of one.
    pub is_board: bool,
    capacities: Vec<Capacity>,
}

impl Meter {
    /// Opens a target.
    ///
    /// # Errors
    /// If it isn't there, speaks another protocol, or has no counter.
    pub fn open(target: &Target, means: &Means) -> Result<Self, Error> {
        let (client, hello) = Client::connect(target.open(means)?, target.label(), means.patience)?;
        if hello.counter == Counter::None {
            return Err(Error::usage(
                format!("{} has no counter: it cannot say what a stage costs", target.label()),
                "--target qemu, which counts instructions, or a board, which counts cycles",
            ));
        }
        let capacities = hello.capacities.iter().copied().collect();
        let (identity, unit, is_board) = (Identity::new(target, &hello), hello.counter, target.is_board());
        Ok(Self { client, identity, unit, is_board, capacities })
    }

    /// Most bodies and contacts in a number format; none if the target doesn't know the format.
    pub fn capacity(&self, scalar: ScalarKind) -> Option<Capacity> {
        self.capacities.iter().copied().find(|capacity| capacity.scalar == scalar)
    }

    /// Runs a job and counts.
    ///
    /// # Errors
    /// If the target refuses the scene, goes away, or a count gets lost on the way.
    pub fn measure(&mut self, job: &Job) -> Result<Sample, Error> {
        let mut counted: Vec<Option<[u32; STAGES]>> = vec![None; job.steps as usize];
        let stream = StreamRequest { stage_times: true, ..drive::digests(job.steps) };
        let trace = Trace::record(&mut self.client, job, stream, None, |frame| {
            if let Frame::StageTimes { step, counts } = frame
                && let Some(slot) = (*step as usize).checked_sub(1).and_then(|index| counted.get_mut(index))
            {
                *slot = Some(*counts);
            }
        })?;
        let lost = |what: String| {
            Error::target(format!("{}: {what} got lost on the link", self.client.name()), "run it again")
        };
        let mut steps = Vec::with_capacity(counted.len());
        for (step, counts) in (1..).zip(counted) {
            steps.push(counts.ok_or_else(|| lost(format!("the times of step {step}")))?);
        }
        let counters = trace.counters.ok_or_else(|| lost("the counters".into()))?;
        Ok(Sample { steps, digest: trace.end.digest, in_world: trace.loaded.bodies, counters })
    }
}

/// The unit's name, in the plural.
pub fn unit_name(unit: Counter) -> &'static str {
    match unit {
        Counter::None => "nothing",
        Counter::Instructions => "instructions",
        Counter::Cycles => "cycles",
        Counter::Nanoseconds => "ns",
    }
}
