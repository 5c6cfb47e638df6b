//! What flat takes for a step on rv32imc, beside what other engines took.

use std::fmt::Write;

use super::figures::{PEERS, Peers};
use crate::error::Error;
use crate::firmware::toolchain::Toolchain;
use crate::job::{Choice, Job};
use crate::measure::{Meter, Summary};
use crate::report::figures::{grouped, table};
use crate::report::progress::overall;
use crate::run;
use crate::setting::Setting;
use crate::target::{Means, Target};

/// A scene's peers, and flat.
pub type Line = (Peers, Summary);

/// What flat takes on rv32imc for the scenes that peers were measured on.
///
/// # Errors
/// If QEMU isn't there, or on Ctrl-C.
pub fn measure(setting: &Setting, means: &Means) -> Result<Vec<Line>, Error> {
    let mut meter = Meter::open(&Target::Qemu, means)?;
    let bar = overall(PEERS.len());
    let mut lines = Vec::new();
    for peers in PEERS {
        bar.set_message(format!("{} {}", peers.scene, peers.bodies));
        let choice = Choice { bodies: Some(peers.bodies), ..Choice::default() };
        let sample = meter.measure(&Job::of(run::find(peers.scene)?, choice, setting)?)?;
        lines.push((peers, sample.total()));
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(lines)
}

/// Prints all lines.
pub fn print(lines: &[Line], setting: &Setting) {
    let mut shown = table(&HEADER);
    for (peers, ours) in lines {
        shown.add_row(row(peers, ours));
    }
    println!("instructions a step on rv32imc, mean of steps 301 to 600; flat at {setting}\n{shown}");
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

/// The same for the README.
///
/// # Errors
/// If there is no compiler for rv32imc.
pub fn markdown(lines: &[Line], setting: &Setting) -> Result<String, Error> {
    let mut text = format!("| {} |\n|---|--:|--:|--:|--:|--:|\n", HEADER.join(" | "));
    for (peers, ours) in lines {
        let _ = writeln!(text, "| {} |", row(peers, ours).join(" | "));
    }
    let _ = write!(
        text,
        "\nInstructions a step on rv32imc, retired in QEMU; mean of steps 301 to 600, the worst of all 600. flat at {setting}, rustc \
         {} at opt-level 3. The original: release 1.5.0, 16.16 fixed point without contact friction, gcc 12.2 -O2. Box2D: 4 substeps, \
         rotation locked, sleeping off, soft floats.\n",
        Toolchain::find()?.release(),
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
