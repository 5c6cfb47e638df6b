//! `rig run`: every scenario on the mock as reference and on every target, and what came of it.

use std::time::Instant;

use flat_scenes::{SCENES, Scene};

use crate::bench::Bench;
use crate::cli::RunArgs;
use crate::error::Error;
use crate::job::Job;
use crate::report::file::Output;
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
    let jobs = scenes.into_iter().map(|scene| Job::all(scene, arguments)).collect::<Result<Vec<_>, _>>()?;
    let jobs: Vec<_> = jobs.into_iter().flatten().collect();
    let output = Output::create("--json", arguments.json.as_deref())?;
    let started = Instant::now();
    let mut bench = Bench::default();
    let ended = bench.run(&jobs, arguments);
    let passed = ended.is_ok() && bench.verdicts.iter().all(|verdict| verdict.passed);
    if let Some(output) = output {
        output.write_json(&json::Report {
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

/// The scene of that name.
///
/// # Errors
/// If there is none; the error names those that there are.
pub fn find(name: &str) -> Result<&'static Scene, Error> {
    flat_scenes::find(name).ok_or_else(|| {
        let known = SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>().join(", ");
        Error::usage(format!("there is no scenario `{name}`"), format!("one of {known}"))
    })
}

fn chosen(names: &[String]) -> Result<Vec<&'static Scene>, Error> {
    if names.is_empty() {
        return Ok(SCENES.iter().collect());
    }
    names.iter().map(|name| find(name)).collect()
}
