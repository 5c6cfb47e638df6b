//! One scene computed in one way: what it costs on a target, and how far from right it is.
//!
//! The mock runs it with the full state of every step, the target with its counter. Equal digests make the two one run, so
//! that the target's cost and the mock's errors belong together.

use flat_rig::check::{Finding, Outcome, Series};

use super::meter::Meter;
use super::sample::Sample;
use super::summary::Summary;
use crate::client::Client;
use crate::error::{Error, Kind};
use crate::job::Job;
use crate::observe::Observer;
use crate::setting::Setting;
use crate::target::{Means, Target};
use crate::trace::Trace;

/// How far from right a run was.
#[derive(Clone, Debug)]
pub struct Accuracy {
    /// What became of each of the scene's promises.
    pub findings: Vec<Finding>,
    /// Overlap and energy after each step.
    pub series: Series,
    /// Digest of the final state.
    pub digest: u64,
}

/// Cost and error of one setting.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// How it was computed.
    pub setting: Setting,
    /// Counts of a step.
    pub cost: Summary,
    /// How far from right it was.
    pub accuracy: Accuracy,
}

/// Says how far from right a scene is computed, on the mock.
pub struct Judge {
    mock: Client,
}

/// The two that an evaluation takes.
pub struct Evaluator {
    judge: Judge,
    /// Who counts.
    pub meter: Meter,
}

impl Judge {
    /// Opens the mock.
    ///
    /// # Errors
    /// If it doesn't start.
    pub fn open(means: &Means) -> Result<Self, Error> {
        let (mock, _) = Client::connect(Target::Mock.open(means)?, Target::Mock.label(), means.patience)?;
        Ok(Self { mock })
    }

    /// How far from right a job is.
    ///
    /// # Errors
    /// If the mock refuses the scene.
    pub fn accuracy(&mut self, job: &Job) -> Result<Accuracy, Error> {
        let mut observer = Observer::recording(job);
        let trace = Trace::record(&mut self.mock, job, observer.stream(), None, |frame| observer.take(frame))?;
        // The first finding is about the link, not about the scene.
        let findings = observer.findings().split_off(1);
        Ok(Accuracy { findings, series: observer.series(), digest: trace.end.digest })
    }
}

impl Evaluator {
    /// Opens the mock and a target.
    ///
    /// # Errors
    /// As [`Meter::open`].
    pub fn open(target: &Target, means: &Means) -> Result<Self, Error> {
        Ok(Self { judge: Judge::open(means)?, meter: Meter::open(target, means)? })
    }

    /// Cost and error of a job; none if the target has no room for it.
    ///
    /// # Errors
    /// If a target goes away, or if the two don't end with the same bits.
    pub fn evaluate(&mut self, job: &Job, setting: &Setting) -> Result<Option<Evaluation>, Error> {
        let sample = match self.meter.measure(job) {
            Ok(sample) => sample,
            Err(error) if error.kind() == Kind::Refused => return Ok(None),
            Err(error) => return Err(error),
        };
        let accuracy = self.judge.accuracy(job)?;
        if accuracy.digest != sample.digest {
            let (name, scene) = (&self.meter.identity.label, job.scene.name);
            return Err(Error::new(
                Kind::Refused,
                format!(
                    "{scene}, {setting}: {name} and the mock end with different bits, so that cost and error don't belong together"
                ),
                format!("cargo rig run {scene} --target mock,{name}"),
            ));
        }
        Ok(Some(Evaluation { setting: *setting, cost: sample.total(), accuracy }))
    }
}

impl Accuracy {
    /// Promises that failed.
    pub fn failed(&self) -> usize {
        self.findings.iter().filter(|finding| finding.outcome == Outcome::Failed).count()
    }

    /// Promises that held.
    pub fn held(&self) -> usize {
        self.findings.iter().filter(|finding| finding.outcome == Outcome::Held).count()
    }

    /// Deepest overlap of the run's second half, px; none if no step was seen.
    pub fn deepest(&self) -> Option<f64> {
        let overlap = &self.series.overlap;
        overlap[Sample::window(overlap.len())].iter().copied().reduce(f64::max)
    }
}
