//! The report as people read it: a line for each scenario and target, the details of what failed, a line at the end.

use std::fmt::Write;

use console::style;

use super::{Identity, Verdict};
use crate::check::{Finding, Outcome};
use crate::target::Target;

/// Prints who a target is.
pub fn print_target(identity: &Identity) {
    let clock = match identity.clock_hz {
        0 => String::new(),
        hz => format!(", {} MHz", f64::from(hz) / 1e6),
    };
    println!("target {}: board {}{clock}, build {}", identity.target, identity.board, shown_build(&identity.build));
}

/// Warns that a target was built from other sources than this rig.
pub fn warn_other_build(identity: &Identity, ours: &str) {
    eprintln!(
        "{} {} was built from other sources ({}) than this rig ({}): digests may differ for that reason alone; \
         build and flash it again",
        style("warning:").yellow().for_stderr(),
        identity.label,
        shown_build(&identity.build),
        shown_build(ours),
    );
}

fn shown_build(build: &str) -> &str {
    if build.is_empty() { "unknown" } else { build }
}

/// Widths that keep the verdicts in columns.
#[derive(Clone, Copy, Debug)]
pub struct Columns {
    scene: usize,
    target: usize,
}

impl Columns {
    /// As wide as the longest name of each.
    pub fn new<'a>(scenes: impl Iterator<Item = &'a str>, targets: impl Iterator<Item = &'a Target>) -> Self {
        Self {
            scene: scenes.map(str::len).max().unwrap_or(0),
            target: targets.map(|target| target.label().len()).max().unwrap_or(0),
        }
    }

    /// Prints a verdict, with the details of what failed.
    pub fn print(&self, verdict: &Verdict) {
        let Self { scene, target } = *self;
        let mark = if verdict.passed { style("ok  ").green() } else { style("FAIL").red().bold() };
        let digest = verdict.digest.map_or_else(|| format!("{:16}", "none"), |digest| format!("{digest:016x}"));
        println!(
            "{mark}  {:scene$}  {:target$}  {:4} {}  {:4} steps  digest {digest}  {:5.2} s  {}",
            verdict.scene,
            verdict.label,
            verdict.parameters.bodies,
            if verdict.parameters.bodies == 1 { "body  " } else { "bodies" },
            verdict.steps,
            verdict.duration.as_secs_f32(),
            summary(verdict),
        );
        if !verdict.parameters.options.is_empty() {
            println!("      {}", style(&verdict.parameters.options).dim());
        }
        for finding in &verdict.checks {
            match finding.outcome {
                Outcome::Held => {}
                Outcome::Failed => print_failure(finding),
                Outcome::Short => println!("      {} falls short, as is known: {}", finding.check, finding.got),
                Outcome::Untested => println!("      {} untested: {}", finding.check, finding.got),
            }
        }
        if let Some(divergence) = &verdict.divergence {
            print_field("parts at", &divergence.place());
            print_field("differs", &divergence.difference.to_string());
            if let Some((reference, target)) = divergence.values() {
                print_field("on mock", &reference);
                print_field("here", &target);
            }
        }
        if !verdict.passed {
            print_field("rerun", &verdict.rerun);
        }
    }
}

/// Prints what was measured beside what is allowed, for every check that measures something.
pub fn print_figures(verdict: &Verdict) {
    for Finding { check, outcome, measured, limit, unit, .. } in &verdict.checks {
        if let (Some(measured), Some(limit)) = (measured, limit) {
            let mark = match outcome {
                Outcome::Held => "  ",
                Outcome::Failed => "!!",
                Outcome::Short => " !",
                Outcome::Untested => "??",
            };
            println!("      {mark} {measured:>12.4} | {limit:>12.4} {unit:5} {check}");
        }
    }
}

fn summary(verdict: &Verdict) -> String {
    let count = |outcome| verdict.checks.iter().filter(|finding| finding.outcome == outcome).count();
    let (held, untested) = (count(Outcome::Held), count(Outcome::Untested));
    let mut text = format!("{held} of {} checks hold", verdict.checks.len());
    if untested > 0 {
        let _ = write!(text, ", {untested} untested");
    }
    let mut note = |count: u64, what: &str| {
        if count > 0 {
            let _ = write!(text, ", {count} {what}");
        }
    };
    note(verdict.frames.dropped_detail.into(), "detail frames dropped");
    note(verdict.frames.dropped_steps.into(), "step frames dropped");
    note(verdict.frames.damaged.into(), "frames damaged");
    note(verdict.frames.missing.into(), "frames missing");
    if let Some(counters) = &verdict.counters {
        note(counters.contacts_lost.into(), "contacts lost to a full pool");
        note(counters.escaped.into(), "bodies escaped");
        note(counters.saturations.into(), "values saturated");
    }
    text
}

fn print_failure(finding: &Finding) {
    println!("      {}", style(&finding.check).bold());
    if let Some(step) = finding.step {
        print_field("step", &step.to_string());
    }
    print_field("expected", &finding.expected);
    print_field("got", &finding.got);
    print_field("tolerance", &finding.tolerance);
}

fn print_field(name: &str, value: &str) {
    if !value.is_empty() {
        println!("        {name:9}  {value}");
    }
}

/// Prints the line at the end.
pub fn print_end(verdicts: &[Verdict]) {
    let failed = verdicts.iter().filter(|verdict| !verdict.passed).count();
    if failed == 0 {
        println!("{} all {} verdicts", style("ok:").green(), verdicts.len());
    } else {
        println!("{} {failed} of {} verdicts", style("failed:").red().bold(), verdicts.len());
    }
}
