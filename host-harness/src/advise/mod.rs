//! `rig advise`: the cheapest setting that meets stated tolerances on a scene, with the evidence.

use std::time::Duration;

use clap::Args;
use console::style;

use crate::cli::{LevelArg, MOST_STEPS, ScalarArg, seconds};
use crate::error::Error;
use crate::job::{Choice, Job};
use crate::measure::evaluate::Evaluator;
use crate::measure::meter::unit_name;
use crate::measure::{Clock, Cycles};
use crate::profile::one_target;
use crate::report::figures::{grouped, table};
use crate::report::progress::overall;
use crate::report::terminal;
use crate::run;
use crate::setting::Setting;
use crate::target::qemu::Speed;
use crate::target::reset::ResetArgs;
use crate::target::{Means, Target};
use crate::tradeoff::{Candidate, Comparison, bars, compare, figure};

/// Arguments of `rig advise`.
#[derive(Debug, Args)]
pub struct AdviseArgs {
    /// Scenario
    #[arg(value_name = "SCENARIO")]
    scene: String,

    /// Bodies in the scene [default: the scene's]
    #[arg(long, value_name = "N")]
    bodies: Option<u16>,

    /// How much of what its promises allow the scene may use: 1 is all, 2 twice as much
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = positive, allow_negative_numbers = true)]
    tolerance: f64,

    /// Deepest overlap in the run's second half, px [default: what the promises say]
    #[arg(long, value_name = "PX", value_parser = positive, allow_negative_numbers = true)]
    overlap: Option<f64>,

    /// Largest part of the time between two steps that the worst step may take at 160 MHz, %
    #[arg(long, value_name = "PERCENT", value_parser = positive, allow_negative_numbers = true)]
    load: Option<f64>,

    /// Number formats to choose from, with commas between them
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = [ScalarArg::Fixed])]
    scalars: Vec<ScalarArg>,

    /// Steps to run [default: the scene's]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=MOST_STEPS))]
    steps: Option<u32>,

    /// Where cost is measured: `qemu` counts instructions, a board cycles
    #[arg(long, value_name = "TARGET", default_value = "qemu", value_parser = one_target)]
    target: Target,

    /// Longest wait for any sign of progress
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    timeout: Duration,

    /// Whether to reset a board.
    #[command(flatten)]
    reset: ResetArgs,
}

fn positive(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|number: &f64| number.is_finite() && *number > 0.0)
        .ok_or("must be a number above 0".into())
}

/// Passes that are tried at each level.
const PASSES: [u8; 5] = [1, 2, 3, 4, 8];

/// Looks for the cheapest; false if none meets the tolerances.
///
/// # Errors
/// On wrong arguments, a target that cannot count or goes away, or Ctrl-C.
pub fn run(arguments: &AdviseArgs) -> Result<bool, Error> {
    let scene = run::find(&arguments.scene)?;
    // What the scene doesn't take is refused before anything is built or opened.
    let choice = Choice { bodies: arguments.bodies, steps: arguments.steps, ..Choice::default() };
    Job::of(scene, choice, &Setting::default())?;
    let reset = arguments.reset.choice();
    let means = Means { elf: None, speed: Speed::Quiet, patience: arguments.timeout, reset };
    let mut evaluator = Evaluator::open(&arguments.target, &means)?;
    terminal::print_target(&evaluator.meter.identity);
    let settings = settings(&arguments.scalars);
    let bar = overall(settings.len());
    let comparison = compare(&mut evaluator, scene, choice, &settings, &bar)?;
    bar.finish_and_clear();
    let cycles = Cycles::of(evaluator.meter.unit, evaluator.meter.is_board);
    let wanted = Wanted { arguments, cycles: &cycles };
    print(&comparison, &wanted, unit_name(evaluator.meter.unit));
    Ok(comparison.candidates.iter().any(|candidate| wanted.missed(candidate).is_none()))
}

fn settings(scalars: &[ScalarArg]) -> Vec<Setting> {
    let mut settings = Vec::new();
    for level in [LevelArg::Flat, LevelArg::Grounded, LevelArg::Exact] {
        for &scalar in scalars {
            settings.extend(PASSES.map(|passes| Setting { level, scalar, iterations: Some(passes), effects: None }));
        }
    }
    settings
}

/// What must hold.
struct Wanted<'a> {
    arguments: &'a AdviseArgs,
    cycles: &'a Cycles,
}

impl Wanted<'_> {
    /// The first tolerance that a candidate misses, in words; none if it meets all.
    fn missed(&self, candidate: &Candidate) -> Option<String> {
        let AdviseArgs { tolerance, overlap, load, .. } = *self.arguments;
        if let Some(finding) = candidate.worst().filter(|_| candidate.error() > tolerance) {
            return Some(format!("{}: {}", finding.check, bars(candidate.error())));
        }
        if let Some(limit) = overlap {
            match candidate.evaluation.accuracy.deepest() {
                Some(deepest) if deepest <= limit => {}
                Some(deepest) => return Some(format!("overlap {deepest:.3} px")),
                None => return Some("overlap unknown".into()),
            }
        }
        let part = 100.0 * self.cycles.load(candidate.evaluation.cost.worst as f64, Clock::USUAL[0]);
        load.filter(|limit| part > *limit).map(|_| format!("{part:.1} % of 160 MHz"))
    }
}

fn print(comparison: &Comparison, wanted: &Wanted<'_>, unit: &str) {
    let mut evidence =
        table(&["setting", unit, "worst step", "error, x the bar", "overlap, px", "of 160 MHz", "misses"]);
    for candidate in &comparison.candidates {
        let (cost, accuracy) = (&candidate.evaluation.cost, &candidate.evaluation.accuracy);
        let load = 100.0 * wanted.cycles.load(cost.worst as f64, Clock::USUAL[0]);
        evidence.add_row([
            candidate.name(),
            grouped(cost.mean),
            grouped(cost.worst as f64),
            figure(candidate.error()),
            accuracy.deepest().map_or_else(String::new, |deepest| format!("{deepest:.4}")),
            format!("{load:.1} %"),
            wanted.missed(candidate).unwrap_or_default(),
        ]);
    }
    println!(
        "{} {} bodies, {} steps\n{evidence}",
        style(comparison.scene.name).bold(),
        comparison.bodies,
        comparison.steps
    );
    match comparison.candidates.iter().find(|candidate| wanted.missed(candidate).is_none()) {
        Some(best) => {
            let dearest = comparison.candidates.iter().rev().find(|candidate| wanted.missed(candidate).is_none());
            let times = dearest.map_or(1.0, |dearest| dearest.evaluation.cost.mean / best.evaluation.cost.mean);
            let saved = if times < 1.05 {
                String::new()
            } else {
                format!("; the dearest that does takes {times:.1} times as many")
            };
            println!(
                "{} {}: {} {unit} a step, the cheapest that meets every tolerance{saved}",
                style("use").green().bold(),
                style(best.name()).bold(),
                grouped(best.evaluation.cost.mean),
            );
        }
        None => println!("{} meets every tolerance; the table says what each misses", style("no setting").red().bold()),
    }
    if !comparison.out_of_reach.is_empty() {
        println!("left out, since it falls short in every setting: {}", comparison.out_of_reach.join(", "));
    }
    if wanted.cycles.estimated {
        println!("cycles: {}", wanted.cycles.basis);
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use flat_rig::check::{Finding, Series};

    use super::*;
    use crate::cli::{Cli, Command};
    use crate::measure::Summary;
    use crate::measure::evaluate::{Accuracy, Evaluation};

    /// What a setting misses that uses 1.5 of what is allowed, overlaps by 0.2 px and takes 400 000 instructions at worst.
    fn missed(options: &[&str]) -> Option<String> {
        let words = ["rig", "advise", "stack"].iter().chain(options);
        let Command::Advise(arguments) = Cli::parse_from(words).command else { panic!("another command") };
        let finding = Finding { used: Some(1.5), ..Finding::count("no deep overlap", 1, 0, "") };
        let series = Series { overlap: vec![0.2; 4], energy: Vec::new() };
        let accuracy = Accuracy { findings: vec![finding], series, digest: 0 };
        let cost = Summary { mean: 1e5, worst: 400_000, ..Summary::default() };
        let evaluation = Evaluation { setting: Setting::default(), cost, accuracy };
        let comparison = Comparison::new(run::find("stack").expect("a scene"), 10, 4, vec![evaluation]);
        let cycles = Cycles::of(flat_wire::message::Counter::Instructions, false);
        Wanted { arguments: &arguments, cycles: &cycles }.missed(&comparison.candidates[0])
    }

    #[test]
    fn each_tolerance_is_held_against_its_own_figure() {
        assert_eq!(missed(&[]).as_deref(), Some("no deep overlap: 1.50 x the bar"));
        assert_eq!(missed(&["--tolerance", "1.5"]), None);
        assert_eq!(missed(&["--tolerance", "2", "--overlap", "0.1"]).as_deref(), Some("overlap 0.200 px"));
        assert_eq!(missed(&["--tolerance", "2", "--overlap", "0.2"]), None);
        // 1.4 cycles each, of 2.67 million between two steps.
        assert_eq!(missed(&["--tolerance", "2", "--load", "20"]).as_deref(), Some("21.0 % of 160 MHz"));
        assert_eq!(missed(&["--tolerance", "2", "--load", "22"]), None);
    }
}
