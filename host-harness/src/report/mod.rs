//! What came of a run: one verdict for each scenario and target, told on the terminal and in a file.

pub mod figures;
pub mod file;
pub mod json;
pub mod list;
pub mod marks;
pub mod page;
pub mod plot;
pub mod progress;
pub mod reader;
pub mod scale;
pub mod terminal;
pub mod wait;

use std::time::Duration;

use flat_wire::message::{Hello, Level, Order, ScalarKind, Statistics};
use serde::{Serialize, Serializer};

use crate::check::{Finding, Outcome};
use crate::compare::Divergence;
use crate::job::Job;
use crate::target::Target;

/// What is known of a target.
#[derive(Clone, Debug, Serialize)]
pub struct Identity {
    /// As on the command line.
    pub target: String,
    /// The same, short.
    #[serde(skip)]
    pub label: String,
    /// Board name.
    pub board: String,
    /// The sources that it was built from.
    pub build: String,
    /// Protocol version.
    pub protocol: u16,
    /// CPU clock in Hz; 0 = unknown.
    pub clock_hz: u32,
}

impl Identity {
    /// From a target's hello.
    pub fn new(target: &Target, hello: &Hello) -> Self {
        Self {
            target: target.to_string(),
            label: target.label(),
            board: hello.board.as_str().into(),
            build: hello.build.as_str().into(),
            protocol: hello.protocol,
            clock_hz: hello.clock_hz,
        }
    }
}

/// A scene as it was asked for.
#[derive(Clone, Debug, Serialize)]
pub struct Parameters {
    /// Bodies.
    pub bodies: u16,
    /// Seed.
    pub seed: u32,
    /// Insertion order.
    #[serde(serialize_with = "lowercase")]
    pub order: Order,
    /// Accuracy level.
    #[serde(serialize_with = "lowercase")]
    pub level: Level,
    /// Number format.
    #[serde(serialize_with = "lowercase")]
    pub scalar: ScalarKind,
    /// The options that differ from the scene's defaults.
    pub options: String,
}

/// Frames that didn't make it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Frames {
    /// Intact ones.
    pub received: u32,
    /// Detail frames that the target dropped because the link was slow.
    pub dropped_detail: u32,
    /// Step and statistics frames that the target dropped because the link was slow.
    pub dropped_steps: u32,
    /// Damaged on the link.
    pub damaged: u32,
    /// Sent, but never received intact.
    pub missing: u32,
}

/// The engine's counters at the end of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Most contacts of any step.
    pub contacts_peak: u16,
    /// Contacts lost to a full pool.
    pub contacts_lost: u32,
    /// Bodies disabled because they left the coordinate range.
    pub escaped: u16,
    /// Values that were held at the end of their range.
    pub saturations: u32,
}

impl From<&Statistics> for Counters {
    fn from(statistics: &Statistics) -> Self {
        Self {
            contacts_peak: statistics.contacts_peak,
            contacts_lost: statistics.contacts_lost,
            escaped: statistics.escaped,
            saturations: statistics.saturations,
        }
    }
}

/// One scenario on one target.
#[derive(Clone, Debug, Serialize)]
pub struct Verdict {
    /// Scenario.
    pub scene: String,
    /// With which parameters.
    pub parameters: Parameters,
    /// Target, as on the command line.
    pub target: String,
    /// The same, short.
    #[serde(skip)]
    pub label: String,
    /// Whether every check held.
    pub passed: bool,
    /// Steps run.
    pub steps: u32,
    /// Digest of the final state; none if the target refused the scene.
    #[serde(serialize_with = "hexadecimal")]
    pub digest: Option<u64>,
    /// What was checked.
    pub checks: Vec<Finding>,
    /// Where the target parts from the mock, if it does.
    pub divergence: Option<Divergence>,
    /// Frames that didn't make it.
    pub frames: Frames,
    /// The engine's counters, if they arrived.
    pub counters: Option<Counters>,
    /// Wall time.
    #[serde(serialize_with = "seconds", rename = "duration_s")]
    pub duration: Duration,
    /// The command that runs just this again.
    pub rerun: String,
}

impl Verdict {
    /// The verdict that these checks give on a job of which no step was run.
    pub fn before_any_step(job: &Job, target: &Target, rerun: String, checks: Vec<Finding>) -> Self {
        Self {
            scene: job.scene.name.into(),
            parameters: job.reported(),
            target: target.to_string(),
            label: target.label(),
            passed: checks.iter().all(|finding| finding.outcome != Outcome::Failed),
            steps: 0,
            digest: None,
            checks,
            divergence: None,
            frames: Frames::default(),
            counters: None,
            duration: Duration::ZERO,
            rerun,
        }
    }
}

fn lowercase<T: std::fmt::Debug, S: Serializer>(name: &T, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(&format!("{name:?}").to_lowercase())
}

// serde passes the field by reference.
#[allow(clippy::ref_option)]
fn hexadecimal<S: Serializer>(digest: &Option<u64>, to: S) -> Result<S::Ok, S::Error> {
    digest.map(|digest| format!("{digest:016x}")).serialize(to)
}

fn seconds<S: Serializer>(duration: &Duration, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_f64(duration.as_secs_f64())
}
