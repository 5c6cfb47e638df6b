//! What a profile found.

use flat_physics::Stage;
use serde::Serialize;

use crate::measure::provenance::Provenance;
use crate::measure::{Clock, Cycles, Sample, Summary};
use crate::report::Identity;

/// Everything that was found.
#[derive(Debug, Serialize)]
pub struct Profile {
    /// Scene.
    pub scene: &'static str,
    /// How it was computed, in words.
    pub setting: String,
    /// Seed of the scene's random numbers.
    pub seed: u32,
    /// Steps run; means are over the second half.
    pub steps: u32,
    /// Where.
    pub target: Identity,
    /// Unit of all counts.
    pub unit: &'static str,
    /// What a count is in cycles.
    pub cycles: Cycles,
    /// By ascending body count.
    pub points: Vec<Point>,
    /// Largest body counts, one for each clock; empty if no range was asked for.
    pub capacities: Vec<Capacity>,
    /// Why the range ends before what was asked for.
    pub limit: Option<String>,
    /// Memory.
    pub memory: Memory,
    /// When, from which sources.
    pub provenance: Provenance,
}

/// One body count.
#[derive(Debug, Serialize)]
pub struct Point {
    /// Rigid bodies asked for.
    pub bodies: u16,
    /// Bodies in the world, static ones included.
    pub in_world: u16,
    /// Most contacts of any step.
    pub contacts_peak: u16,
    /// Contacts lost to a full pool.
    pub contacts_lost: u32,
    /// Bodies that left the coordinate range.
    pub escaped: u16,
    /// Final state.
    pub digest: String,
    /// Whole steps.
    pub total: Summary,
    /// Each stage.
    pub stages: Vec<StageCost>,
    /// Counts of each stage, step by step.
    #[serde(skip)]
    pub series: Vec<(Stage, Vec<u64>)>,
}

/// A stage's share.
#[derive(Debug, Serialize)]
pub struct StageCost {
    /// The stage.
    pub stage: String,
    /// Its cost.
    #[serde(flatten)]
    pub cost: Summary,
}

/// The edge of a clock's budget.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Capacity {
    /// The clock.
    pub clock: Clock,
    /// Cycles between two steps.
    pub budget: f64,
    /// Most bodies whose every step fits, measured.
    pub fits: Option<u16>,
    /// One more, whose worst step doesn't fit, measured.
    pub fails: Option<u16>,
}

/// Bytes of a world, without what it is told to hold.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Memory {
    /// Of each body that there is room for.
    pub body: usize,
    /// Of each contact that there is room for.
    pub contact: usize,
    /// Of everything else.
    pub fixed: usize,
}

impl Point {
    /// What a run of so many bodies says.
    pub fn new(bodies: u16, sample: &Sample) -> Self {
        let cost = sample.stages();
        Self {
            bodies,
            in_world: sample.in_world,
            contacts_peak: sample.counters.contacts_peak,
            contacts_lost: sample.counters.contacts_lost,
            escaped: sample.counters.escaped,
            digest: format!("{:016x}", sample.digest),
            total: sample.total(),
            stages: Stage::ALL
                .iter()
                .map(|stage| StageCost { stage: stage.to_string(), cost: cost[stage.index()] })
                .collect(),
            series: Stage::ALL.iter().map(|stage| (*stage, sample.stage(stage.index()))).collect(),
        }
    }
}
