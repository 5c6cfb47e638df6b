//! What a comparison of settings found, scene by scene.

use flat_scenes::Scene;

use crate::cli::ScalarArg;
use crate::measure::evaluate::Evaluation;
use crate::measure::pareto;
use crate::report::figures::grouped;
use crate::setting::{Setting, lowercase};

/// One scene, all settings.
#[derive(Debug)]
pub struct Comparison {
    /// The scene.
    pub scene: &'static Scene,
    /// Bodies asked for.
    pub bodies: u16,
    /// Steps run.
    pub steps: u32,
    /// By ascending cost.
    pub candidates: Vec<Candidate>,
}

/// One setting.
#[derive(Debug)]
pub struct Candidate {
    /// Cost and error.
    pub evaluation: Evaluation,
    /// Whether no other setting is cheaper and as right, or as cheap and more right.
    pub on_front: bool,
}

impl Comparison {
    /// Sorts and marks.
    pub fn new(scene: &'static Scene, bodies: u16, steps: u32, mut evaluations: Vec<Evaluation>) -> Self {
        evaluations.sort_by(|a, b| a.cost.mean.total_cmp(&b.cost.mean));
        let points: Vec<_> = evaluations.iter().map(|each| (each.cost.mean, each.accuracy.error())).collect();
        let candidates = evaluations
            .into_iter()
            .zip(pareto::front(&points))
            .map(|(evaluation, on_front)| Candidate { evaluation, on_front })
            .collect();
        Self { scene, bodies, steps, candidates }
    }

    /// The cheapest that keeps every promise.
    pub fn cheapest(&self) -> Option<&Candidate> {
        self.candidates.iter().find(|candidate| candidate.keeps_all())
    }

    /// What is lost below the cheapest that keeps every promise: the next cheaper one that is worth its cost.
    pub fn next_cheaper(&self) -> Option<&Candidate> {
        let limit = self.cheapest().map_or(f64::INFINITY, |cheapest| cheapest.evaluation.cost.mean);
        self.candidates.iter().rev().find(|candidate| candidate.on_front && candidate.evaluation.cost.mean < limit)
    }

    /// The answer in words: which setting, and what a cheaper one loses.
    pub fn answer(&self, unit: &str) -> String {
        let cost = |candidate: &Candidate| format!("{} {unit} a step", grouped(candidate.evaluation.cost.mean));
        match (self.cheapest(), self.next_cheaper()) {
            (Some(best), Some(cheaper)) => {
                let saved = 1.0 - cheaper.evaluation.cost.mean / best.evaluation.cost.mean;
                format!(
                    "{} keeps every promise for {}. {} saves {:.0} % of it and loses: {}.",
                    best.name(),
                    cost(best),
                    cheaper.name(),
                    100.0 * saved,
                    cheaper.loss()
                )
            }
            (Some(best), None) => format!("{} keeps every promise for {}; none is cheaper.", best.name(), cost(best)),
            (None, Some(closest)) => {
                let right = self.candidates.iter().min_by(|a, b| a.error().total_cmp(&b.error())).unwrap_or(closest);
                format!(
                    "No setting keeps every promise. The closest is {}, {}: {}.",
                    right.name(),
                    cost(right),
                    right.loss()
                )
            }
            (None, None) => "Nothing was measured.".into(),
        }
    }
}

impl Candidate {
    /// How it was computed, in a few words.
    pub fn name(&self) -> String {
        name(&self.evaluation.setting)
    }

    /// Whether no promise failed.
    pub fn keeps_all(&self) -> bool {
        self.evaluation.accuracy.failed() == 0
    }

    /// How much the worst promise used; 1 = just held.
    pub fn error(&self) -> f64 {
        self.evaluation.accuracy.error()
    }

    /// The worst promise and what came of it, short; empty if every promise was kept without using any of what it allows.
    pub fn worst_promise(&self) -> String {
        let used = self.evaluation.accuracy.worst().filter(|(_, used)| *used > 0.0);
        used.map_or_else(String::new, |(finding, _)| {
            format!("{}: {}", finding.check, finding.got.split(" between ").next().unwrap_or_default())
        })
    }

    /// The worst promise and how it fared.
    pub fn loss(&self) -> String {
        match self.evaluation.accuracy.worst() {
            Some((finding, used)) => {
                let got = finding.got.split(';').next().unwrap_or_default();
                format!("{}, {got} where {} is promised ({})", finding.check, finding.expected, bars(used))
            }
            None => "no promise has a measure".into(),
        }
    }
}

/// Level, passes, number format.
pub fn name(setting: &Setting) -> String {
    let passes = setting.iterations.map_or_else(String::new, |passes| format!(" x{passes}"));
    let format =
        if setting.scalar == ScalarArg::Fixed { String::new() } else { format!(" {}", lowercase(&setting.scalar)) };
    format!("{}{passes}{format}", lowercase(&setting.level))
}

/// A multiple of what is allowed, in words.
pub fn bars(used: f64) -> String {
    match used {
        1e6.. => "more than a million times the bar".into(),
        10.0..1e6 => format!("{used:.0} x the bar"),
        0.01..10.0 => format!("{used:.2} x the bar"),
        _ => format!("{used:.4} x the bar"),
    }
}
