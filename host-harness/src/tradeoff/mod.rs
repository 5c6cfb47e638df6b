//! `rig tradeoff`: what accuracy costs in time. Levels x passes x number formats, on scenes with a known answer and hard cases.

mod arguments;
mod csv;
mod findings;
mod page;
mod publish;
mod table;

pub use arguments::TradeoffArgs;
pub use findings::{Candidate, Comparison, bars, figure, name};

use flat_scenes::Scene;
use indicatif::ProgressBar;

use crate::error::{Error, Kind};
use crate::job::{Choice, Job};
use crate::measure::evaluate::Evaluator;
use crate::measure::meter::unit_name;
use crate::measure::provenance::Provenance;
use crate::report::file::Output;
use crate::report::progress::overall;
use crate::report::terminal;
use crate::run;
use crate::setting::Setting;
use crate::target::Means;
use crate::target::qemu::Speed;

/// Scenes with a known answer, then hard cases; small, since soft floats are slow. With bodies, and steps where the scene's own are
/// more than it takes to tell.
const SCENES: [(&str, u16, Option<u32>); 8] = [
    ("projectile", 5, None),
    ("bounce", 5, None),
    ("cradle", 5, None),
    ("slide", 4, None),
    ("stack", 10, Some(900)),
    ("heavy_top", 10, Some(900)),
    ("crate_columns", 20, None),
    ("ball_pit", 50, None),
];

/// Everything that a report needs besides the comparisons.
struct Context {
    unit: &'static str,
    target: String,
    provenance: Provenance,
}

/// Compares; always true: a trade-off judges nothing.
///
/// # Errors
/// On wrong arguments, a target that cannot count or goes away, targets that disagree, or Ctrl-C.
pub fn run(arguments: &TradeoffArgs) -> Result<bool, Error> {
    let scenes = scenes(arguments)?;
    let csv_file = Output::create("--csv", arguments.csv.as_deref())?;
    let html_file = Output::create("--html", arguments.html.as_deref())?;
    let reset = arguments.reset.choice();
    let means = Means { elf: arguments.elf.clone(), speed: Speed::Quiet, patience: arguments.timeout, reset };
    let mut evaluator = Evaluator::open(&arguments.target, &means)?;
    terminal::print_target(&evaluator.meter.identity);
    let context = Context {
        unit: unit_name(evaluator.meter.unit),
        target: evaluator.meter.identity.label.clone(),
        provenance: Provenance::now(),
    };
    let settings = settings(arguments);
    let bar = overall(scenes.len() * settings.len());
    let mut comparisons = Vec::new();
    for (scene, choice) in scenes {
        let comparison = compare(&mut evaluator, scene, choice, &settings, &bar)?;
        bar.suspend(|| table::print(&comparison, &context));
        comparisons.push(comparison);
    }
    bar.finish_and_clear();
    if let Some(file) = csv_file {
        file.write(&csv::text(&comparisons, &context))?;
    }
    if let Some(file) = html_file {
        file.write(&page::text(&comparisons, &context))?;
    }
    if arguments.publish {
        publish::publish(&comparisons, &context)?;
    }
    Ok(true)
}

/// Evaluates one scene in many ways; what the target has no room for is left out, and said.
///
/// # Errors
/// As [`Evaluator::evaluate`].
pub fn compare(
    evaluator: &mut Evaluator,
    scene: &'static Scene,
    choice: Choice,
    settings: &[Setting],
    bar: &ProgressBar,
) -> Result<Comparison, Error> {
    let mut evaluations = Vec::new();
    let mut ran = (scene.defaults.bodies, scene.steps);
    for setting in settings {
        let job = Job::of(scene, choice, setting)?;
        ran = (job.parameters.bodies, job.steps);
        bar.set_message(format!("{} {}", scene.name, name(setting)));
        match evaluator.evaluate(&job, setting)? {
            Some(evaluation) => evaluations.push(evaluation),
            None => bar.suspend(|| println!("{}, {}: the target has no room for it", scene.name, name(setting))),
        }
        bar.inc(1);
    }
    Ok(Comparison::new(scene, ran.0, ran.1, evaluations))
}

fn settings(arguments: &TradeoffArgs) -> Vec<Setting> {
    let mut settings = Vec::new();
    for &level in &arguments.levels {
        for &scalar in &arguments.scalars {
            let of_passes = |&iterations| Setting { level, scalar, iterations: Some(iterations), effects: None };
            settings.extend(arguments.iterations.iter().map(of_passes));
        }
    }
    settings
}

/// The scenes asked for, or the usual ones. What a scene doesn't take is refused before anything is built or opened.
fn scenes(arguments: &TradeoffArgs) -> Result<Vec<(&'static Scene, Choice)>, Error> {
    let choose = |name: &str, bodies, steps| {
        let scene = run::find(name)?;
        let choice = Choice { bodies, steps, ..Choice::default() };
        Job::of(scene, choice, &Setting::default())?;
        Ok((scene, choice))
    };
    let TradeoffArgs { scenarios, bodies, steps, .. } = arguments;
    if !scenarios.is_empty() {
        return scenarios.iter().map(|name| choose(name, *bodies, *steps)).collect();
    }
    if bodies.is_some() {
        return Err(Error::new(Kind::Usage, "--bodies needs the scenarios that it is for", "name one or more"));
    }
    SCENES.iter().map(|&(name, bodies, enough)| choose(name, Some(bodies), steps.or(enough))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_scenes_exist_at_that_size() {
        for (name, bodies, _) in SCENES {
            assert!(run::find(name).is_ok_and(|scene| scene.bodies.contains(&bodies)), "{name}");
        }
    }
}
