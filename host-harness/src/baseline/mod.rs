//! `rig baseline`: instruction counts and sizes, held against those that are committed.

mod record;

use std::fs;
use std::path::PathBuf;

use clap::Args;
use console::style;
use flat_physics::{Effects, Stage};

use crate::cli::{LevelArg, seconds};
use crate::error::Error;
use crate::firmware::elf::Image;
use crate::firmware::image::{self, Board};
use crate::firmware::toolchain::Toolchain;
use crate::firmware::workspace;
use crate::job::{Choice, Job};
use crate::measure::Meter;
use crate::measure::probe::{self, Program};
use crate::run;
use crate::setting::{Setting, lowercase};
use crate::target::qemu::Speed;
use crate::target::reset::Reset;
use crate::target::{Means, Target};
use record::{Change, Record};

/// Where the figures are committed, relative to the root.
const FILE: &str = "host-harness/baseline.csv";

/// What is measured, at each level: scenes of which a change of any stage shows in one, and one at full size.
const SUBJECTS: [(&str, u16); 7] = [
    ("ball_pit", 100),
    ("ball_pit", 400),
    ("ball_pit", 1000),
    ("ball_pit_mixed", 100),
    ("crate_columns", 100),
    ("tile_level", 50),
    ("bounce", 5),
];

/// Arguments of `rig baseline`.
#[derive(Debug, Args)]
pub struct BaselineArgs {
    /// Writes what was measured to host-harness/baseline.csv, to be committed with the change that explains it
    #[arg(long)]
    update: bool,

    /// Longest wait for any sign of progress
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    timeout: std::time::Duration,
}

/// What came of a comparison.
#[derive(Debug)]
pub enum Held {
    /// Nothing grew; how many figures, in a line.
    Yes(String),
    /// Something did; the changes, a line each.
    No(String),
    /// The images come from another compiler than the record's.
    Incomparable(String),
}

/// Measures, and compares or writes; true unless something grew.
///
/// # Errors
/// If the firmware doesn't build, QEMU isn't there, or the file cannot be read or written.
pub fn run(arguments: &BaselineArgs) -> Result<bool, Error> {
    if arguments.update {
        let before = read().unwrap_or_default();
        let now = measure(arguments.timeout)?;
        let path = path()?;
        fs::write(&path, now.text()).map_err(|error| unusable(&path, &error))?;
        for change in before.changes(&now) {
            println!("{change}");
        }
        println!("{} figures in {FILE}: commit it with the change that explains them", now.figures.len());
        return Ok(true);
    }
    match compare(arguments.timeout)? {
        Held::Yes(text) => println!("{} {text}", style("ok:").green()),
        Held::Incomparable(why) => println!("{} {why}", style("skipped:").yellow()),
        Held::No(changes) => {
            println!("{}\n{changes}", style("failed:").red().bold());
            return Ok(false);
        }
    }
    Ok(true)
}

/// Measures and compares with the committed figures.
///
/// # Errors
/// As [`run()`].
pub fn compare(timeout: std::time::Duration) -> Result<Held, Error> {
    let (before, compiler) = (read()?, Toolchain::find()?.release().to_owned());
    if before.compiler != compiler {
        let theirs = &before.compiler;
        return Ok(Held::Incomparable(format!("the baseline is of rustc {theirs}, the images here are of {compiler}")));
    }
    let now = measure(timeout)?;
    let changes = before.changes(&now);
    let failed: Vec<&Change> = changes.iter().filter(|change| change.fails()).collect();
    if failed.is_empty() {
        let (down, total) = (changes.iter().filter(|change| change.now < change.before).count(), now.figures.len());
        return Ok(Held::Yes(format!("{total} figures, none more than 1 % above the baseline, {down} below it")));
    }
    // What grew, and how each stage of the same subject changed.
    let shown = changes.iter().filter(|change| failed.iter().any(|failed| failed.subject() == change.subject()));
    let lines: Vec<String> =
        shown.map(|change| format!("{} {change}", if change.fails() { "!" } else { " " })).collect();
    Ok(Held::No(format!(
        "{} figures grew by more than 1 %, or are on one side only:\n{}\n\
         where that is the price of something: `cargo rig baseline --update`, and commit the file with the change",
        failed.len(),
        lines.join("\n")
    )))
}

fn measure(timeout: std::time::Duration) -> Result<Record, Error> {
    let mut record = Record { compiler: Toolchain::find()?.release().to_owned(), ..Record::default() };
    let elf = image::build(Board::QemuVirt)?;
    for (board, path) in [(Board::QemuVirt, elf.clone()), (Board::Esp32c3, image::build(Board::Esp32c3)?)] {
        record.figures.insert(format!("text/{board}"), Image::read(&path)?.sizes.text);
    }
    let games = [
        ("boxes", Program::Boxes, Effects::GRAVITY),
        ("gravity", Program::Game, Effects::GRAVITY),
        ("everything", Program::Game, Effects::ALL),
    ];
    for (game, program, effects) in games {
        let sizes = Image::read(&probe::build(program, Some(effects))?)?.sizes;
        record.figures.insert(format!("text/game/{game}"), sizes.text + sizes.rodata);
    }
    let means = Means { elf: Some(elf), speed: Speed::Quiet, patience: timeout, reset: Reset::default() };
    let mut meter = Meter::open(&Target::Qemu, &means)?;
    for (scene, bodies) in SUBJECTS {
        for level in [LevelArg::Flat, LevelArg::Grounded, LevelArg::Exact] {
            let setting = Setting { level, ..Setting::default() };
            let choice = Choice { bodies: Some(bodies), ..Choice::default() };
            let sample = meter.measure(&Job::of(run::find(scene)?, choice, &setting)?)?;
            let total = sample.total();
            let subject = format!("{scene}/{bodies}/{}", lowercase(&level));
            let stages = Stage::ALL.iter().zip(sample.stages());
            let stages = stages.map(|(stage, cost)| (stage.to_string(), cost.mean.round() as u64));
            for (item, figure) in
                stages.chain([("mean".into(), total.mean.round() as u64), ("worst".into(), total.worst)])
            {
                record.figures.insert(format!("{subject}/{item}"), figure);
            }
        }
    }
    Ok(record)
}

fn path() -> Result<PathBuf, Error> {
    Ok(workspace::root()?.join(FILE))
}

fn read() -> Result<Record, Error> {
    let path = path()?;
    Record::parse(&fs::read_to_string(&path).map_err(|error| unusable(&path, &error))?)
}

fn unusable(path: &std::path::Path, error: &std::io::Error) -> Error {
    Error::usage(format!("{}: {error}", path.display()), "cargo rig baseline --update")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_subject_is_a_scene_of_that_size() {
        for (scene, bodies) in SUBJECTS {
            let scene = run::find(scene).unwrap();
            assert!(scene.bodies.contains(&bodies), "{}", scene.name);
        }
    }
}
