//! `rig effects`: what each effect costs, in instructions of a step where it is on or off, and in bytes where it is linked.

mod findings;
mod page;
mod publish;
mod sizes;
mod table;
mod toggles;

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use flat_physics::Effects;

use crate::cli::seconds;
use crate::error::Error;
use crate::measure::Meter;
use crate::measure::provenance::Provenance;
use crate::report::file::Output;
use crate::report::progress::overall;
use crate::report::terminal;
use crate::run;
use crate::setting::single;
use crate::target::qemu::Speed;
use crate::target::reset::Reset;
use crate::target::{Means, Target};
use findings::Costs;

/// Scenes whose steps are measured: none of them calls for everything.
const SCENES: [(&str, u16); 3] = [("ball_pit", 100), ("crate_columns", 100), ("tile_level", 20)];

/// Arguments of `rig effects`.
#[derive(Debug, Args)]
pub struct EffectsArgs {
    /// Scenarios whose steps are measured [default: some that call for little]
    #[arg(value_name = "SCENARIO")]
    scenarios: Vec<String>,

    /// Leaves the sizes out: they take a build for each set of effects
    #[arg(long)]
    no_sizes: bool,

    /// Writes everything to this file
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,

    /// Writes the tables as one page that needs no other file
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,

    /// Writes the table into the README of this source tree, in place of the one there
    #[arg(long, conflicts_with = "no_sizes")]
    publish: bool,

    /// Longest wait for any sign of progress
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    timeout: Duration,
}

/// Measures; false if what isn't called for costs more than it may, changes a bit, or is linked, or a build is too large.
///
/// # Errors
/// On wrong arguments, if nothing builds, if QEMU isn't there, or on Ctrl-C.
pub fn run(arguments: &EffectsArgs) -> Result<bool, Error> {
    let scenes = if arguments.scenarios.is_empty() {
        SCENES.iter().map(|&(name, bodies)| Ok((run::find(name)?, bodies))).collect::<Result<Vec<_>, Error>>()?
    } else {
        let found = arguments.scenarios.iter().map(|name| run::find(name));
        found.map(|scene| scene.map(|scene| (scene, scene.defaults.bodies))).collect::<Result<_, _>>()?
    };
    let json_file = Output::create("--json", arguments.json.as_deref())?;
    let html_file = Output::create("--html", arguments.html.as_deref())?;
    let means = Means { elf: None, speed: Speed::Quiet, patience: arguments.timeout, reset: Reset::default() };
    let mut meter = Meter::open(&Target::Qemu, &means)?;
    terminal::print_target(&meter.identity);

    let effects: Vec<Effects> = single(Effects::ALL).collect();
    let builds = if arguments.no_sizes { 0 } else { sizes::builds(&effects) };
    let bar = overall(scenes.len() * (effects.len() + 1) + builds);
    let mut costs = Costs { scenes: Vec::new(), sizes: None, provenance: Provenance::now() };
    for (scene, bodies) in scenes {
        costs.scenes.push(toggles::measure(&mut meter, scene, bodies, &effects, &bar)?);
    }
    if !arguments.no_sizes {
        costs.sizes = Some(sizes::measure(&effects, &bar)?);
    }
    bar.finish_and_clear();

    table::print(&costs);
    if let Some(file) = json_file {
        file.write_json(&costs)?;
    }
    if let Some(file) = html_file {
        file.write(&page::text(&costs))?;
    }
    if arguments.publish {
        publish::publish(&costs)?;
    }
    Ok(costs.problems().is_empty())
}
