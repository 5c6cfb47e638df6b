//! What a comparison of settings found, scene by scene.

use std::fmt::Write;

use flat_rig::check::{Finding, Outcome};
use flat_scenes::Scene;

use crate::cli::ScalarArg;
use crate::measure::evaluate::Evaluation;
use crate::measure::pareto;
use crate::report::figures::grouped;
use crate::setting::{Setting, lowercase};

/// Less of what is allowed than this is as good as nothing.
pub const LEAST: f64 = 0.01;

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
    /// Promises that are known to fall short, and do so in every setting: they tell no two settings apart.
    pub out_of_reach: Vec<String>,
}

/// One setting.
#[derive(Debug)]
pub struct Candidate {
    /// Cost and error.
    pub evaluation: Evaluation,
    /// Whether no other setting is cheaper and as right, or as cheap and more right.
    pub on_front: bool,
    /// The worst promise within reach, by its place, and how much of what it allows was used.
    worst: Option<(usize, f64)>,
}

impl Comparison {
    /// Sorts and marks.
    pub fn new(scene: &'static Scene, bodies: u16, steps: u32, mut evaluations: Vec<Evaluation>) -> Self {
        evaluations.sort_by(|a, b| a.cost.mean.total_cmp(&b.cost.mean));
        let count = evaluations.first().map_or(0, |first| first.accuracy.findings.len());
        let outcomes = |place: usize| evaluations.iter().map(move |each| each.accuracy.findings[place].outcome);
        let falls_short = |place: &usize| {
            outcomes(*place).any(|outcome| outcome == Outcome::Short)
                && !outcomes(*place).any(|outcome| outcome == Outcome::Held)
        };
        let (beyond, within): (Vec<_>, Vec<_>) = (0..count).partition(falls_short);
        let title = |place: usize| evaluations[0].accuracy.findings[place].check.clone();
        let out_of_reach = beyond.into_iter().map(title).collect();
        let mut candidates: Vec<_> =
            evaluations.into_iter().map(|evaluation| Candidate::new(evaluation, &within)).collect();
        let points: Vec<_> =
            candidates.iter().map(|each| (each.evaluation.cost.mean, significant(each.error()))).collect();
        for (candidate, on_front) in candidates.iter_mut().zip(pareto::front(&points)) {
            candidate.on_front = on_front;
        }
        Self { scene, bodies, steps, candidates, out_of_reach }
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
        let mut answer = match (self.cheapest(), self.next_cheaper()) {
            (Some(best), Some(cheaper)) => {
                let saved = 1.0 - cheaper.evaluation.cost.mean / best.evaluation.cost.mean;
                format!(
                    "{} keeps every promise for {}. {} is {:.0} % cheaper, and breaks one: {}.",
                    best.name(),
                    cost(best),
                    cheaper.name(),
                    100.0 * saved,
                    cheaper.loss()
                )
            }
            (Some(best), None) => {
                format!("{} keeps every promise for {}, and nothing is cheaper.", best.name(), cost(best))
            }
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
        };
        if !self.out_of_reach.is_empty() {
            let _ =
                write!(answer, " Left out, since it falls short in every setting: {}.", self.out_of_reach.join(", "));
        }
        answer
    }
}

impl Candidate {
    fn new(evaluation: Evaluation, within: &[usize]) -> Self {
        let used = within.iter().map(|&place| (place, used(&evaluation.accuracy.findings[place])));
        let worst = used.max_by(|a, b| a.1.total_cmp(&b.1));
        Self { evaluation, on_front: false, worst }
    }

    /// How it was computed, in a few words.
    pub fn name(&self) -> String {
        name(&self.evaluation.setting)
    }

    /// Whether every promise within reach was put to the test, and held.
    pub fn keeps_all(&self) -> bool {
        self.error() <= 1.0
    }

    /// How much the worst promise used; 1 = just held.
    pub fn error(&self) -> f64 {
        self.worst.map_or(0.0, |(_, used)| used)
    }

    /// The promise that used most of what it allows; none if the scene makes none.
    pub fn worst(&self) -> Option<&Finding> {
        self.worst.map(|(place, _)| &self.evaluation.accuracy.findings[place])
    }

    /// The worst promise and what came of it, short; empty if next to nothing of what it allows was used.
    pub fn worst_promise(&self) -> String {
        let worst = self.worst().filter(|_| self.error() >= LEAST);
        worst.map_or_else(String::new, |finding| format!("{}: {}", finding.check, came_of(finding)))
    }

    /// The worst promise, and how it fared.
    pub fn loss(&self) -> String {
        match self.worst() {
            Some(finding) => {
                let (came, bars) = (came_of(finding), bars(self.error()));
                format!("{}, {came} where {} is promised ({bars})", finding.check, finding.expected)
            }
            None => "no promise has a measure".into(),
        }
    }
}

/// Part of what a promise allows that was used; infinite if it came to nothing that could be measured.
fn used(finding: &Finding) -> f64 {
    let unmeasured = if finding.outcome == Outcome::Held { 0.0 } else { f64::INFINITY };
    finding.used.unwrap_or(unmeasured)
}

/// The figure of the whole run, or why there is none.
fn came_of(finding: &Finding) -> String {
    match finding.measured {
        Some(measured) => format!("{measured:.4} {}", finding.unit),
        None => finding.got.clone(),
    }
}

/// Two digits of an error: chaos alone changes the third.
fn significant(error: f64) -> f64 {
    if !error.is_finite() {
        return error;
    }
    let unit = 10f64.powf(error.max(LEAST).log10().floor() - 1.0);
    (error.max(LEAST) / unit).round() * unit
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
        f64::INFINITY => "it never came to that".into(),
        1e6.. => "more than a million x the bar".into(),
        10.0..1e6 => format!("{used:.0} x the bar"),
        LEAST..10.0 => format!("{used:.2} x the bar"),
        _ => format!("less than {LEAST} x the bar"),
    }
}

/// The same for a column that says so in its header.
pub fn figure(used: f64) -> String {
    match used {
        f64::INFINITY => "untested".into(),
        _ => bars(used).replace(" x the bar", "").replace("less than", "<"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Summary;
    use crate::measure::evaluate::Accuracy;

    fn finding(check: &str, outcome: Outcome, used: Option<f64>) -> Finding {
        Finding {
            check: check.into(),
            outcome,
            step: None,
            expected: "at most 1 px".into(),
            got: "the run ended".into(),
            tolerance: String::new(),
            measured: used,
            limit: Some(1.0),
            unit: "px",
            used,
        }
    }

    fn evaluation(passes: u8, mean: f64, findings: Vec<Finding>) -> Evaluation {
        let accuracy = Accuracy { findings, series: flat_rig::check::Series::default(), digest: 0 };
        let cost = Summary { mean, ..Summary::default() };
        Evaluation { setting: Setting { iterations: Some(passes), ..Setting::default() }, cost, accuracy }
    }

    fn compared(evaluations: Vec<Evaluation>) -> Comparison {
        Comparison::new(flat_scenes::find("stack").unwrap(), 10, 60, evaluations)
    }

    #[test]
    fn a_promise_that_was_never_put_to_the_test_is_not_kept() {
        let comparison = compared(vec![
            evaluation(1, 10.0, vec![finding("apex", Outcome::Untested, None)]),
            evaluation(2, 20.0, vec![finding("apex", Outcome::Held, Some(0.5))]),
        ]);
        assert_eq!(comparison.cheapest().map(Candidate::name).as_deref(), Some("grounded x2"));
        assert!(comparison.answer("instructions").ends_with("where at most 1 px is promised (it never came to that)."));
    }

    #[test]
    fn what_falls_short_everywhere_judges_nobody_and_is_said() {
        let short = |used| finding("load", Outcome::Short, Some(used));
        let comparison = compared(vec![
            evaluation(1, 10.0, vec![short(9.0), finding("overlap", Outcome::Failed, Some(3.0))]),
            evaluation(2, 20.0, vec![short(8.0), finding("overlap", Outcome::Held, Some(0.5))]),
        ]);
        assert_eq!(comparison.cheapest().map(Candidate::error), Some(0.5));
        assert!(comparison.answer("instructions").ends_with("falls short in every setting: load."));

        let kept_once = compared(vec![
            evaluation(1, 10.0, vec![finding("load", Outcome::Short, Some(9.0))]),
            evaluation(2, 20.0, vec![finding("load", Outcome::Held, Some(0.5))]),
        ]);
        assert!(kept_once.out_of_reach.is_empty());
        assert_eq!(kept_once.cheapest().map(Candidate::name).as_deref(), Some("grounded x2"));
    }

    #[test]
    fn errors_that_differ_by_less_than_chaos_makes_are_equal() {
        let held = |used| vec![finding("overlap", Outcome::Held, Some(used))];
        let comparison = compared(vec![
            evaluation(1, 10.0, held(0.801)),
            evaluation(2, 20.0, held(0.799)),
            evaluation(3, 30.0, held(0.004)),
            evaluation(4, 40.0, held(0.0)),
        ]);
        let front: Vec<_> = comparison.candidates.iter().map(|candidate| candidate.on_front).collect();
        assert_eq!(front, [true, false, true, false]);
    }
}
