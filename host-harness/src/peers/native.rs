//! Instructions of a step on this machine: flat beside other engines, one compiler, one counter.

use std::fmt::Write;

use super::oracle::{Engine, Oracle};
use crate::error::Error;
use crate::job::{Choice, Job};
use crate::report::figures::{grouped, table};
use crate::report::progress::overall;
use crate::run;
use crate::setting::Setting;

/// Scenes and sizes.
pub const SCENES: [(&str, u16); 5] =
    [("ball_pit", 50), ("ball_pit", 100), ("ball_pit", 200), ("crate_columns", 50), ("crate_columns", 100)];

/// In the order of the columns.
const ENGINES: [Engine; 4] = [Engine::FLAT_FIXED, Engine::FLAT_F32, Engine::BOX2D, Engine::RAPIER];

/// A scene, and instructions of a step for each engine.
#[derive(Debug)]
pub struct Line {
    scene: &'static str,
    bodies: u16,
    counts: [f64; ENGINES.len()],
}

/// Counts.
///
/// # Errors
/// If valgrind or an engine fails, or on Ctrl-C.
pub fn measure(oracle: &Oracle) -> Result<Vec<Line>, Error> {
    let bar = overall(SCENES.len() * ENGINES.len());
    let mut lines = Vec::new();
    for (scene, bodies) in SCENES {
        let choice = Choice { bodies: Some(bodies), ..Choice::default() };
        let job = Job::of(run::find(scene)?, choice, &Setting::default())?;
        let mut counts = [0.0; ENGINES.len()];
        for (engine, count) in ENGINES.into_iter().zip(&mut counts) {
            bar.set_message(format!("{scene} {bodies}, {}", engine.name));
            *count = oracle.instructions(engine, &job)?;
            bar.inc(1);
        }
        lines.push(Line { scene, bodies, counts });
    }
    bar.finish_and_clear();
    Ok(lines)
}

impl Line {
    fn row(&self) -> [String; 6] {
        let [fixed, float, box2d, rapier] = self.counts;
        let part = format!("{:.0} %", 100.0 * float / box2d);
        let title = format!("{} {}", self.scene, self.bodies);
        [title, grouped(fixed), grouped(float), grouped(box2d), grouped(rapier), part]
    }
}

/// What the last column says.
const PART: &str = "flat f32 : Box2D";

/// Prints all lines.
pub fn print(lines: &[Line]) {
    let [fixed, float, box2d, rapier] = ENGINES.map(|engine| engine.name);
    let mut shown = table(&["scene", fixed, float, box2d, rapier, PART]);
    for line in lines {
        shown.add_row(line.row());
    }
    println!("instructions a step on {}, mean of the run's second half, by callgrind\n{shown}", std::env::consts::ARCH);
}

/// The same for the README.
pub fn markdown(lines: &[Line]) -> String {
    let names = ENGINES.map(|engine| engine.name).join(" | ");
    let mut text = format!("| scene | {names} | {PART} |\n|---|--:|--:|--:|--:|--:|\n");
    for line in lines {
        let _ = writeln!(text, "| {} |", line.row().join(" | "));
    }
    text
}
