//! `rig peers`: flat beside other engines on the same scenes: what a step takes, and how right it is.

mod accuracy;
mod cost;
mod figures;
mod native;
pub mod oracle;

use std::time::Duration;

use clap::Args;
use console::style;

use crate::cli::seconds;
use crate::error::Error;
use crate::measure::evaluate::Judge;
use crate::measure::provenance::Provenance;
use crate::report::marks;
use crate::run;
use crate::setting::{Setting, lowercase};
use crate::target::Means;
use crate::target::qemu::Speed;
use crate::target::reset::Reset;
use oracle::Oracle;

/// Arguments of `rig peers`.
#[derive(Debug, Args)]
pub struct PeersArgs {
    /// How to compute.
    #[command(flatten)]
    setting: Setting,

    /// Also builds two other engines and runs them here: how right all are on the same scenes and, where there is valgrind, how
    /// many instructions a step takes
    #[arg(long)]
    live: bool,

    /// Scenarios to run live [default: some with a known answer and some hard ones]
    #[arg(value_name = "SCENARIO", requires = "live", conflicts_with = "publish")]
    scenarios: Vec<String>,

    /// Also writes the tables between the README's peers marks and, with --live, its live marks
    #[arg(long)]
    publish: bool,

    /// Longest wait for any sign of progress
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    timeout: Duration,
}

/// Measures and prints; always true: the tables judge nobody.
///
/// # Errors
/// If QEMU isn't there, a peer can't be built, or a file has no marks.
pub fn run(arguments: &PeersArgs) -> Result<bool, Error> {
    let means = Means { elf: None, speed: Speed::Quiet, patience: arguments.timeout, reset: Reset::default() };
    let setting = &arguments.setting;
    let scenes = scenes(arguments)?;
    if arguments.scenarios.is_empty() {
        let lines = cost::measure(setting, &means)?;
        cost::print(&lines, setting);
        if arguments.publish {
            let made = format!("Measured {}; made by `cargo rig peers --publish`.", Provenance::now());
            marks::publish("README.md", "peers", &format!("{}{made}", cost::markdown(&lines, setting)?))?;
        }
    }
    if arguments.live {
        live(arguments, &scenes, &means)?;
    }
    Ok(true)
}

/// Builds the peers and measures on this machine.
fn live(arguments: &PeersArgs, scenes: &[(&'static str, u16)], means: &Means) -> Result<(), Error> {
    let oracle = Oracle::build()?;
    let right = accuracy::measure(&oracle, &mut Judge::open(means)?, scenes, &arguments.setting)?;
    accuracy::print(&right, &arguments.setting);
    if !arguments.scenarios.is_empty() {
        return Ok(());
    }
    let taken = if oracle::can_count() {
        let lines = native::measure(&oracle)?;
        native::print(&lines);
        native::markdown(&lines)
    } else {
        println!("{} instructions on this machine: there is no valgrind to count them", style("SKIPPED").yellow());
        "Instructions on this machine were not counted: there was no valgrind.\n".into()
    };
    if arguments.publish {
        let made = format!("Measured {}; made by `cargo rig peers --live --publish`.", Provenance::now());
        let short = accuracy::digest(&right);
        marks::publish("README.md", "live", &format!("{taken}\n{short}\n**Bold** is not what must hold. {made}"))?;
        let level = lowercase(&arguments.setting.level);
        let long = accuracy::markdown(&right);
        marks::publish("docs/peers.md", "live", &format!("{long}\nflat at level {level}. {made}"))?;
    }
    Ok(())
}

fn scenes(arguments: &PeersArgs) -> Result<Vec<(&'static str, u16)>, Error> {
    if arguments.scenarios.is_empty() {
        return Ok(accuracy::SCENES.to_vec());
    }
    let scene = |name: &String| {
        let scene = run::find(name)?;
        if !scene.is_plain() {
            let what = format!("{name}: tiles, sensors, one-way bodies and scripts are flat's alone");
            return Err(Error::usage(what, "cargo rig run --list"));
        }
        Ok((scene.name, scene.defaults.bodies))
    };
    arguments.scenarios.iter().map(scene).collect()
}
