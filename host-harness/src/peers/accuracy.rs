//! How right flat and other engines are on the same scenes, by the same checks.

use std::fmt::Write;

use flat_rig::check::{Finding, Outcome};
use flat_scenes::{Player, Promise, Scene};

use super::oracle::{Engine, Oracle};
use crate::cli::ScalarArg;
use crate::error::Error;
use crate::job::{Choice, Job};
use crate::measure::evaluate::Judge;
use crate::report::figures::table;
use crate::report::progress::overall;
use crate::run;
use crate::setting::{Setting, lowercase};

/// Scenes with a known answer, then hard cases.
pub const SCENES: [(&str, u16); 20] = [
    ("projectile", 5),
    ("bounce", 5),
    ("cradle", 5),
    ("slide", 4),
    ("piggyback", 2),
    ("lift", 10),
    ("stack", 10),
    ("stack", 20),
    ("stack", 50),
    ("pyramid", 55),
    ("crate_columns", 100),
    ("heavy_top", 10),
    ("anvil", 2),
    ("feather", 2),
    ("anvil_drop", 6),
    ("vice", 15),
    ("clamp", 6),
    ("ball_pit", 100),
    ("ball_pit", 200),
    ("ball_pit", 400),
];

/// Columns after the scene, the promise and what is expected.
const COLUMNS: [&str; 4] = ["flat", "flat f32", Engine::BOX2D.name, Engine::RAPIER.name];

/// A promise of a scene, and what each engine makes of it.
#[derive(Debug)]
pub struct Line {
    scene: &'static Scene,
    bodies: u16,
    check: String,
    expected: String,
    /// The same, short.
    bar: String,
    cells: [Cell; COLUMNS.len()],
    /// Whether it is the first of its scene that says more than that nobody leaves.
    first: bool,
}

/// What an engine makes of a promise.
#[derive(Debug)]
struct Cell {
    measured: String,
    /// Whether it broke it.
    broken: bool,
}

/// Measures.
///
/// # Errors
/// If an engine fails, or on Ctrl-C.
pub fn measure(
    oracle: &Oracle,
    judge: &mut Judge,
    scenes: &[(&'static str, u16)],
    setting: &Setting,
) -> Result<Vec<Line>, Error> {
    let bar = overall(scenes.len());
    let mut lines = Vec::new();
    for &(name, bodies) in scenes {
        bar.set_message(format!("{name} {bodies}"));
        let scene = run::find(name)?;
        let choice = Choice { bodies: Some(bodies), ..Choice::default() };
        let job = |scalar| Job::of(scene, choice, &Setting { scalar, ..*setting });
        let mut flat = |scalar| -> Result<_, Error> {
            let findings = judge.accuracy(&job(scalar)?)?.findings;
            Ok(findings.into_iter().map(Some).collect::<Vec<_>>())
        };
        let ours = flat(ScalarArg::Fixed)?;
        let float = flat(ScalarArg::F32)?;
        let foreign = job(ScalarArg::F32)?;
        let box2d = oracle.findings(Engine::BOX2D, &foreign)?;
        let rapier = oracle.findings(Engine::RAPIER, &foreign)?;
        let promises = scene.promises(&foreign.parameters, Player::Demo);
        let mut first = true;
        for (index, (promise, finding)) in promises.iter().zip(ours.iter().flatten()).enumerate() {
            let cell = |findings: &[Option<Finding>]| Cell::of(findings.get(index).and_then(Option::as_ref));
            let cells = [cell(&ours), cell(&float), cell(&box2d), cell(&rapier)];
            if matches!(promise, Promise::Within { .. }) && !cells.iter().any(|cell| cell.broken) {
                continue;
            }
            let (check, expected, bar) = (finding.check.clone(), expected(finding), bar_of(finding));
            lines.push(Line { scene, bodies, check, expected, bar, cells, first });
            first = false;
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(lines)
}

/// What is right, and how far off is still right.
fn expected(finding: &Finding) -> String {
    match tolerance(finding) {
        Some(tolerance) => format!("{}, give or take {tolerance}", finding.expected),
        None => finding.expected.clone(),
    }
}

/// The same in as few words as a table has room for.
fn bar_of(finding: &Finding) -> String {
    match (tolerance(finding), finding.limit) {
        (Some(tolerance), Some(limit)) => format!("{limit:.4} +- {tolerance}"),
        _ => finding.expected.split(" from ").next().unwrap_or_default().replace(", at every step", ""),
    }
}

/// How far off is still right; none for a bound, which needs no tolerance.
fn tolerance(finding: &Finding) -> Option<&str> {
    let amount: f64 = finding.tolerance.split(' ').next()?.parse().ok()?;
    (amount > 0.0).then_some(&*finding.tolerance)
}

impl Cell {
    fn of(finding: Option<&Finding>) -> Self {
        let Some(finding) = finding else { return Self { measured: "-".into(), broken: false } };
        Self {
            measured: finding.measured.map_or_else(|| "-".into(), |measured| figure(measured, finding.unit)),
            // Also where the number format excuses it.
            broken: matches!(finding.outcome, Outcome::Failed | Outcome::Short)
                || finding.used.is_some_and(|used| used > 1.0),
        }
    }
}

/// Four decimals tell any bar; whole numbers need none.
fn figure(measured: f64, unit: &str) -> String {
    if measured.fract() == 0.0 { format!("{measured} {unit}") } else { format!("{measured:.4} {unit}") }
}

/// Prints all lines.
pub fn print(lines: &[Line], setting: &Setting) {
    let mut shown = table(&["scene", COLUMNS[0], COLUMNS[1], COLUMNS[2], COLUMNS[3], "what must hold"]);
    for line in lines {
        let [fixed, float, box2d, rapier] = line.cells.each_ref().map(|cell| {
            let mark = if cell.broken { "! " } else { "" };
            format!("{mark}{}", cell.measured)
        });
        let promise = format!("{}: {}", line.check, line.expected);
        shown.add_row([line.title(), fixed, float, box2d, rapier, promise]);
    }
    if let Some(last) = shown.column_mut(5) {
        last.set_cell_alignment(comfy_table::CellAlignment::Left);
    }
    let level = lowercase(&setting.level);
    println!(
        "measured by the same checks on the same scenes; `!` is not what must hold; flat at level {level}\n{shown}"
    );
}

/// All lines as Markdown.
pub fn markdown(lines: &[Line]) -> String {
    let mut text = format!("| scene | what must hold | {} |\n|---|---|--:|--:|--:|--:|\n", COLUMNS.join(" | "));
    for line in lines {
        let promise = format!("{}: {}", line.check, line.expected);
        let _ = writeln!(text, "| {} | {promise} | {} |", line.title(), line.emphasized());
    }
    text
}

/// The first promise of each scene as Markdown, briefly.
pub fn digest(lines: &[Line]) -> String {
    let mut text = format!("| scene | measured | bar | {} |\n|---|---|--:|--:|--:|--:|--:|\n", COLUMNS.join(" | "));
    for line in lines.iter().filter(|line| line.first) {
        let _ = writeln!(text, "| {} | {} | {} | {} |", line.title(), line.check, line.bar, line.emphasized());
    }
    text
}

impl Line {
    fn title(&self) -> String {
        format!("{} {}", self.scene.name, self.bodies)
    }

    /// Its cells, with what is broken in bold.
    fn emphasized(&self) -> String {
        let cells = self.cells.each_ref().map(|cell| {
            let mark = if cell.broken { "**" } else { "" };
            format!("{mark}{}{mark}", cell.measured)
        });
        cells.join(" | ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_there_at_that_size_and_any_engine_can_run_it() {
        for (name, bodies) in SCENES {
            let scene = run::find(name).expect(name);
            assert!(scene.bodies.contains(&bodies) && scene.is_plain(), "{name}");
        }
    }
}
