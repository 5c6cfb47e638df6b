//! `rig peers`: what flat takes for a step beside what other engines take for the same scenes.

mod figures;

use std::fmt::Write;
use std::fs;
use std::time::Duration;

use clap::Args;

use crate::cli::seconds;
use crate::error::Error;
use crate::firmware::toolchain::Toolchain;
use crate::firmware::workspace;
use crate::job::{Choice, Job};
use crate::measure::provenance::Provenance;
use crate::measure::{Meter, Summary};
use crate::report::figures::{grouped, table};
use crate::report::marks;
use crate::report::progress::overall;
use crate::run;
use crate::setting::Setting;
use crate::target::qemu::Speed;
use crate::target::reset::Reset;
use crate::target::{Means, Target};
use figures::{PEERS, Peers};

/// The README's marks.
const MARK: &str = "peers";

/// Arguments of `rig peers`.
#[derive(Debug, Args)]
pub struct PeersArgs {
    /// How to compute.
    #[command(flatten)]
    setting: Setting,

    /// Also writes the table between the README's peers marks
    #[arg(long)]
    publish: bool,

    /// Longest wait for any sign of progress
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    timeout: Duration,
}

/// Measures and prints; always true: the table judges nobody.
///
/// # Errors
/// If QEMU isn't there, or the README has no marks.
pub fn run(arguments: &PeersArgs) -> Result<bool, Error> {
    let means = Means { elf: None, speed: Speed::Quiet, patience: arguments.timeout, reset: Reset::default() };
    let mut meter = Meter::open(&Target::Qemu, &means)?;
    let bar = overall(PEERS.len());
    let mut lines = Vec::new();
    for peers in PEERS {
        bar.set_message(format!("{} {}", peers.scene, peers.bodies));
        let choice = Choice { bodies: Some(peers.bodies), ..Choice::default() };
        let sample = meter.measure(&Job::of(run::find(peers.scene)?, choice, &arguments.setting)?)?;
        lines.push((peers, sample.total()));
        bar.inc(1);
    }
    bar.finish_and_clear();
    let mut shown = table(&HEADER);
    for (peers, ours) in &lines {
        shown.add_row(row(peers, ours));
    }
    println!("instructions a step on rv32imc, mean of steps 301 to 600; flat at {}\n{shown}", arguments.setting);
    if arguments.publish {
        let path = workspace::root()?.join("README.md");
        let failed = |error: &std::io::Error| Error::usage(format!("{}: {error}", path.display()), "");
        let text = fs::read_to_string(&path).map_err(|error| failed(&error))?;
        let text = marks::replace(&text, MARK, &markdown(&lines, &arguments.setting)?)?;
        fs::write(&path, text).map_err(|error| failed(&error))?;
        println!("the README's table is written");
    }
    Ok(true)
}

const HEADER: [&str; 6] = ["scene", "original C++", "Box2D 3.2", "flat", "flat, worst step", "original : flat"];

fn row(peers: &Peers, ours: &Summary) -> [String; 6] {
    let figure = |figure: Option<u32>| figure.map_or_else(|| "-".into(), |figure| grouped(figure.into()));
    let ratio = peers.original.map(|original| f64::from(original) / ours.mean.max(1.0));
    [
        format!("{} {}", peers.scene, peers.bodies),
        figure(peers.original),
        figure(peers.box2d),
        grouped(ours.mean),
        grouped(ours.worst as f64),
        ratio.map_or_else(String::new, |ratio| format!("{ratio:.1}")),
    ]
}

fn markdown(lines: &[(Peers, Summary)], setting: &Setting) -> Result<String, Error> {
    let mut text = format!("| {} |\n|---|--:|--:|--:|--:|--:|\n", HEADER.join(" | "));
    for (peers, ours) in lines {
        let _ = writeln!(text, "| {} |", row(peers, ours).join(" | "));
    }
    let _ = write!(
        text,
        "\nInstructions a step on rv32imc, retired in QEMU; mean of steps 301 to 600, the worst of all 600. flat at {setting}, rustc \
         {} at opt-level 3, {}; made by `cargo rig peers --publish`. The original: release 1.5.0, 16.16 fixed point without contact \
         friction, gcc 12.2 -O2. Box2D: 4 substeps, rotation locked, sleeping off, soft floats.",
        Toolchain::find()?.release(),
        Provenance::now(),
    );
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_that_peers_were_measured_on_is_there_at_that_size() {
        for peers in PEERS {
            assert!(run::find(peers.scene).is_ok_and(|scene| scene.bodies.contains(&peers.bodies)), "{}", peers.scene);
        }
    }
}
