//! The worst value of a run against a limit.

use super::{Finding, Outcome};

/// Where and when a value was measured.
#[derive(Clone, Debug)]
struct Sample {
    step: u32,
    value: f64,
    who: String,
}

/// Keeps the worst value and the first one above the limit.
#[derive(Debug)]
pub(super) struct Worst {
    limit: f64,
    unit: &'static str,
    highest: Option<Sample>,
    first_failure: Option<Sample>,
}

impl Worst {
    /// Nothing measured yet.
    pub(super) fn new(limit: f64, unit: &'static str) -> Self {
        Self { limit, unit, highest: None, first_failure: None }
    }

    /// Takes a measurement; `who` says whose it is. Not-a-number is above every limit.
    pub(super) fn take(&mut self, step: u32, value: f64, who: impl FnOnce() -> String) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        if self.highest.as_ref().is_some_and(|highest| value <= highest.value) {
            return;
        }
        let sample = Sample { step, value, who: who() };
        if value > self.limit && self.first_failure.is_none() {
            self.first_failure = Some(sample.clone());
        }
        self.highest = Some(sample);
    }

    /// The finding; `untested` says why there may be no measurement.
    pub(super) fn finding(&self, check: String, expected: String, untested: &str) -> Finding {
        let limit = Some(self.limit);
        let Some(highest) = &self.highest else {
            return Finding {
                check,
                outcome: Outcome::Untested,
                step: None,
                expected,
                got: untested.to_owned(),
                tolerance: String::new(),
                measured: None,
                limit,
                unit: self.unit,
                used: None,
            };
        };
        let (outcome, decisive) = match &self.first_failure {
            Some(first) => (Outcome::Failed, first),
            None => (Outcome::Held, highest),
        };
        let first = format!("{} {}", self.amount(decisive.value), decisive.who);
        let got = if decisive.step == highest.step {
            first
        } else {
            format!("{first}; worst {} {} at step {}", self.amount(highest.value), highest.who, highest.step)
        };
        Finding {
            check,
            outcome,
            step: Some(decisive.step),
            expected,
            got,
            tolerance: format!("0 {}, the bound is exact", self.unit),
            measured: Some(highest.value),
            limit,
            unit: self.unit,
            used: Some(if highest.value > 0.0 { highest.value / self.limit } else { 0.0 }),
        }
    }

    fn amount(&self, value: f64) -> String {
        format!("{value:.4} {}", self.unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finding(samples: &[f64]) -> Finding {
        let mut worst = Worst::new(1.0, "px");
        for (step, &value) in (1..).zip(samples) {
            worst.take(step, value, || format!("of body {step}"));
        }
        worst.finding("overlap".into(), "at most 1 px".into(), "no step")
    }

    #[test]
    fn the_limit_itself_holds_and_anything_above_fails_at_its_first_step() {
        assert_eq!(finding(&[0.5, 1.0, 0.2]).outcome, Outcome::Held);
        let failed = finding(&[0.5, 1.5, 0.2, 2.5]);
        assert_eq!((failed.outcome, failed.step, failed.measured), (Outcome::Failed, Some(2), Some(2.5)));
        assert_eq!(failed.got, "1.5000 px of body 2; worst 2.5000 px of body 4 at step 4");
    }

    #[test]
    fn not_a_number_fails_and_no_measurement_is_no_pass() {
        assert_eq!(finding(&[0.5, f64::NAN]).outcome, Outcome::Failed);
        assert_eq!(finding(&[]).outcome, Outcome::Untested);
    }
}
