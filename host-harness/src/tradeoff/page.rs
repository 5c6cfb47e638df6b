//! Comparisons as a page: for each scene the answer, error against cost, the table, and how energy and overlap went.

use flat_scenes::{Order, Player, Promise};

use super::Context;
use super::findings::{Candidate, Comparison, LEAST, figure};
use crate::cli::{LevelArg, ScalarArg};
use crate::report::figures::grouped;
use crate::report::page::Page;
use crate::report::plot::{Limit, Look, Mark, Plot, Series};
use crate::report::scale::Axis;
use crate::setting::lowercase;

/// The file's text.
pub fn text(comparisons: &[Comparison], context: &Context) -> String {
    let mut page = Page::new(
        "What accuracy costs in time",
        "For your scene: which setting, and what do you lose if you go cheaper?",
    );
    page.paragraph(
        "A setting is a level (flat, grounded, exact), a number of passes of the solver (x1, x2, ...) and a number format \
         (fixed point, unless it says f32 or f64). Each scene promises something, such as: no two bodies overlap by more than \
         0.02 px.",
    );
    page.paragraph(&format!(
        "Cost: {} of the engine's step on {}, mean of the run's second half. Error: how much of what a scene allows its worst \
         promise used; 0.5 is half of it, up to 1 all promises are kept, 10 is ten times too much (\
         10 000 stands for more, and for what the run never came to). A setting is worth its cost, and \
         ringed, if none is both cheaper and more right (the Pareto front). Lines join \
         one level's numbers of passes.",
        context.unit, context.target,
    ));
    let header = ["scene", "cheapest that keeps all", "its cost", "what a cheaper one breaks"].map(str::to_owned);
    page.table(&header, &comparisons.iter().map(in_short).collect::<Vec<_>>(), |_| false);
    for comparison in comparisons {
        scene(&mut page, comparison, context);
    }
    page.finish(&context.provenance, &crate::profile::command())
}

fn in_short(comparison: &Comparison) -> Vec<String> {
    let best = comparison.cheapest();
    let cheaper = comparison.next_cheaper();
    vec![
        format!("{}, {} bodies", comparison.scene.name, comparison.bodies),
        best.map_or_else(|| "none".into(), Candidate::name),
        best.map_or_else(String::new, |best| grouped(best.evaluation.cost.mean)),
        cheaper.map_or_else(
            || "nothing is cheaper".into(),
            |cheaper| format!("{}: {}", cheaper.name(), cheaper.worst_promise()),
        ),
    ]
}

fn scene(page: &mut Page, comparison: &Comparison, context: &Context) {
    let scene = comparison.scene;
    page.section(
        &format!("{}, {} bodies", scene.name, comparison.bodies),
        &format!("{}. {} steps of 1/60 s.", capitalized(scene.purpose), comparison.steps),
    );
    page.answer(&comparison.answer(context.unit));
    page.plot(&error_against_cost(comparison, context));
    let cost = format!("{} a step", context.unit);
    let header = ["setting", &*cost, "worst step", "error, x the bar", "promises held", "worst promise"];
    let header = header.map(str::to_owned);
    let rows = |candidates: &[&Candidate]| candidates.iter().map(|candidate| row(candidate)).collect::<Vec<_>>();
    let all: Vec<_> = comparison.candidates.iter().collect();
    let fixed = |candidate: &&Candidate| candidate.evaluation.setting.scalar == ScalarArg::Fixed;
    let listed: Vec<_> = all.iter().copied().filter(|candidate| candidate.on_front || fixed(candidate)).collect();
    page.table(&header, &rows(&listed), |index| listed[index].on_front);
    let summary = format!("All {} settings, floats included", all.len());
    page.folded_table(&summary, &header, &rows(&all), |index| all[index].on_front);
    let about_overlap = |promise: &Promise| matches!(promise, Promise::Penetration { .. });
    let overlaps = scene
        .parameters(Some(comparison.bodies), None, Order::Forward)
        .is_ok_and(|parameters| scene.promises(&parameters, Player::Demo).iter().any(about_overlap));
    if overlaps
        && let Some(plot) = over_time(comparison, "Deepest overlap over time", "deepest overlap, px", |candidate| {
            candidate.evaluation.accuracy.series.overlap.clone()
        })
    {
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
        figure(candidate.error()),
        format!("{} of {}", accuracy.held(), accuracy.findings.len()),
        candidate.worst_promise(),
    ]
}

/// Cost to the right, error upwards; colours are levels, shapes are number formats, lines join numbers of passes; a ring marks
/// what is worth its cost.
pub fn error_against_cost(comparison: &Comparison, context: &Context) -> Plot {
    let mut series: Vec<(LevelArg, ScalarArg, Series)> = Vec::new();
    for candidate in &comparison.candidates {
        let setting = &candidate.evaluation.setting;
        let key = (setting.level, setting.scalar);
        let mark = Mark {
            x: candidate.evaluation.cost.mean,
            y: candidate.error().clamp(LEAST, NEVER),
            note: format!("{}: {}", candidate.name(), candidate.loss()),
            ringed: candidate.on_front,
        };
        if let Some((.., found)) = series.iter_mut().find(|(level, scalar, _)| (*level, *scalar) == key) {
            found.points.push(mark);
        } else {
            let name = format!("{}, {}", lowercase(&key.0), lowercase(&key.1));
            let look = Some(Look { colour: key.0 as usize, shape: key.1 as usize });
            series.push((
                key.0,
                key.1,
                Series { name, joined: true, marked: true, broken: false, look, points: vec![mark] },
            ));
        }
    }
    // The same order, and so the same colour, in every plot.
    series.sort_by_key(|(level, scalar, _)| (*scalar as u8, *level as u8));
    Plot {
        title: format!("{}, {} bodies", comparison.scene.name, comparison.bodies),
        x: Axis::logarithmic(format!("{} a step, mean", context.unit)),
        y: Axis::logarithmic("error, x the bar"),
        series: series.into_iter().map(|(.., series)| series).collect(),
        limits: vec![Limit { name: "just kept".into(), value: 1.0 }],
    }
}

/// Where a promise is drawn that the run never came to.
const NEVER: f64 = 10_000.0;

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
        .map(|candidate| Series { broken: true, ..Series::over_steps(candidate.name(), &value(candidate)) })
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
    over_time(comparison, "Kinetic and potential energy over time", "mass x px2/s2, above the lowest", |candidate| {
        candidate.evaluation.accuracy.series.energy.iter().map(|energy| energy - lowest).collect()
    })
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
