//! `rig run`: every scenario on the mock as reference and on every target, and what came of it.

use std::time::Instant;

use flat_scenes::{SCENES, Scene};

use crate::bench::Bench;
use crate::cli::RunArgs;
use crate::error::Error;
use crate::job::Job;
use crate::report::{json, list, terminal};

/// Runs what the arguments ask for; true if every check held.
///
/// # Errors
/// On wrong arguments, a target that isn't there or goes away, another protocol, or Ctrl-C.
pub fn run(arguments: &RunArgs) -> Result<bool, Error> {
    let scenes = chosen(&arguments.scenarios)?;
    if arguments.list {
        list::print(&scenes);
        return Ok(true);
    }
    let jobs = scenes.into_iter().map(|scene| Job::new(scene, arguments)).collect::<Result<Vec<_>, _>>()?;
    let output = arguments.json.as_deref().map(json::Output::create).transpose()?;
    let started = Instant::now();
    let mut bench = Bench::default();
    let ended = bench.run(&jobs, arguments);
    let passed = ended.is_ok() && bench.verdicts.iter().all(|verdict| verdict.passed);
    if let Some(output) = output {
        output.write(&json::Report {
            passed,
            error: ended.as_ref().err().map(ToString::to_string),
            targets: &bench.identities,
            verdicts: &bench.verdicts,
            duration: started.elapsed(),
        })?;
    }
    ended?;
    terminal::print_end(&bench.verdicts);
    Ok(passed)
}

fn chosen(names: &[String]) -> Result<Vec<&'static Scene>, Error> {
    if names.is_empty() {
        return Ok(SCENES.iter().collect());
    }
    let known = || SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>().join(", ");
    names
        .iter()
        .map(|name| {
            flat_scenes::find(name)
                .ok_or_else(|| Error::usage(format!("there is no scenario `{name}`"), format!("one of {}", known())))
        })
        .collect()
}
