//! Comparisons as a page: for each scene the answer, error against cost, the table, and how energy and overlap went.

use super::Context;
use super::findings::{Candidate, Comparison, bars};
use crate::cli::{LevelArg, ScalarArg};
use crate::report::figures::grouped;
use crate::report::page::Page;
use crate::report::plot::{Limit, Mark, Plot, Series};
use crate::report::scale::Axis;
use crate::setting::lowercase;

/// The file's text.
pub fn text(comparisons: &[Comparison], context: &Context) -> String {
    let mut page = Page::new(
        "What accuracy costs in time",
        &format!(
            "For your scene: which level, and what do you lose if you go cheaper? Each setting is a level (flat, grounded, exact), \
             a number of solver passes (x1, x2, ...) and a number format (fixed point unless it says f32 or f64). Cost is {} of \
             the engine's step on {}. Error is how much of what is allowed the scene's worst promise used: up to 1, every promise \
             with a measure held.",
            context.unit, context.target,
        ),
    );
    for comparison in comparisons {
        scene(&mut page, comparison, context);
    }
    page.finish(&context.provenance, &crate::profile::command())
}

fn scene(page: &mut Page, comparison: &Comparison, context: &Context) {
    let scene = comparison.scene;
    page.section(
        &format!("{}, {} bodies", scene.name, comparison.bodies),
        &format!("{}. {} steps of 1/60 s.", capitalized(scene.purpose), comparison.steps),
    );
    page.answer(&comparison.answer(context.unit));
    page.plot(&error_against_cost(comparison, context));
    let header = ["setting", "mean", "worst step", "error, x the bar", "promises held", "Pareto", "worst promise"];
    let rows: Vec<Vec<String>> = comparison.candidates.iter().map(row).collect();
    page.table(&header.map(str::to_owned), &rows, |index| comparison.candidates[index].on_front);
    if let Some(plot) = over_time(comparison, "Deepest overlap over time", "deepest overlap, px", |candidate| {
        candidate.evaluation.accuracy.series.overlap.clone()
    }) {
        page.plot(&plot);
    }
    if let Some(plot) = energy(comparison) {
        page.plot(&plot);
    }
}

fn row(candidate: &Candidate) -> Vec<String> {
    let accuracy = &candidate.evaluation.accuracy;
    vec![
        candidate.name(),
        grouped(candidate.evaluation.cost.mean),
        grouped(candidate.evaluation.cost.worst as f64),
        bars(candidate.error()).replace(" x the bar", ""),
        format!("{} of {}", accuracy.held(), accuracy.findings.len()),
        if candidate.on_front { "yes".into() } else { String::new() },
        candidate.worst_promise(),
    ]
}

/// Cost to the right, error upwards, a line for each level and number format, a ring around each point worth its cost.
pub fn error_against_cost(comparison: &Comparison, context: &Context) -> Plot {
    let mut series: Vec<(LevelArg, ScalarArg, Series)> = Vec::new();
    for candidate in &comparison.candidates {
        let setting = &candidate.evaluation.setting;
        let key = (setting.level, setting.scalar);
        let mark = Mark {
            x: candidate.evaluation.cost.mean,
            y: candidate.error().max(LEAST),
            note: format!("{}: {}", candidate.name(), candidate.loss()),
            ringed: candidate.on_front,
        };
        if let Some((.., found)) = series.iter_mut().find(|(level, scalar, _)| (*level, *scalar) == key) {
            found.points.push(mark);
        } else {
            let name = format!("{} {}", lowercase(&key.0), lowercase(&key.1));
            series.push((key.0, key.1, Series { name, joined: true, marked: true, points: vec![mark] }));
        }
    }
    // The same order, and so the same colour, in every plot.
    series.sort_by_key(|(level, scalar, _)| (*scalar as u8, *level as u8));
    Plot {
        title: format!(
            "{}, {} bodies: error against cost (ringed: worth it)",
            comparison.scene.name, comparison.bodies
        ),
        x: Axis::logarithmic(format!("{} a step, mean", context.unit)),
        y: Axis::logarithmic("worst promise, x its bar"),
        series: series.into_iter().map(|(.., series)| series).collect(),
        limits: vec![Limit { name: "just held".into(), value: 1.0 }],
    }
}

/// Errors below are drawn here: a logarithm has no zero.
const LEAST: f64 = 1e-4;

/// A value over the run for each level in fixed point, at the passes nearest to two.
fn over_time(
    comparison: &Comparison,
    title: &str,
    label: &str,
    value: impl Fn(&Candidate) -> Vec<f64>,
) -> Option<Plot> {
    let shown = |level: LevelArg| {
        let same = comparison.candidates.iter().filter(move |candidate| {
            let setting = &candidate.evaluation.setting;
            setting.level == level && setting.scalar == ScalarArg::Fixed
        });
        same.min_by_key(|candidate| candidate.evaluation.setting.iterations.unwrap_or(2).abs_diff(2))
    };
    let series: Vec<Series> = [LevelArg::Flat, LevelArg::Grounded, LevelArg::Exact]
        .into_iter()
        .filter_map(shown)
        .map(|candidate| Series::over_steps(candidate.name(), &value(candidate)))
        .filter(|series| !series.points.is_empty())
        .collect();
    (!series.is_empty()).then(|| Plot {
        title: title.into(),
        x: Axis::linear("step, 60 a second"),
        y: Axis::linear(label),
        series,
        limits: Vec::new(),
    })
}

/// Energy above the lowest that any setting reached: its zero says nothing.
fn energy(comparison: &Comparison) -> Option<Plot> {
    let all = comparison.candidates.iter().flat_map(|candidate| &candidate.evaluation.accuracy.series.energy);
    let lowest = all.copied().reduce(f64::min)?;
    over_time(comparison, "Mechanical energy over time", "mass x px2/s2", |candidate| {
        candidate.evaluation.accuracy.series.energy.iter().map(|energy| energy - lowest).collect()
    })
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
