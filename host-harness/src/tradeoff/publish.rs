//! The committed copy: docs/tradeoff.svg, and a table between two marks in the README.

use std::fmt::Write;
use std::fs;

use super::Context;
use super::findings::{Comparison, figure};
use super::page::error_against_cost;
use crate::error::Error;
use crate::firmware::workspace;
use crate::report::figures::grouped;
use crate::report::marks;
use crate::report::plot::Plot;

/// The plot, relative to the root.
const PLOT: &str = "docs/tradeoff.svg";
/// The marks' name.
const MARK: &str = "tradeoff";

/// Writes both.
///
/// # Errors
/// If a file cannot be written, or the README has no such marks.
pub fn publish(comparisons: &[Comparison], context: &Context) -> Result<(), Error> {
    let plots: Vec<Plot> = comparisons.iter().map(|comparison| error_against_cost(comparison, context)).collect();
    let caption = format!("Measured {}, cost on {}.", context.provenance, context.target);
    let path = workspace::root()?.join(PLOT);
    let made = path.parent().map_or(Ok(()), fs::create_dir_all);
    made.and_then(|()| fs::write(&path, Plot::sheet(&plots, 2, &caption)))
        .map_err(|error| marks::unwritable(&path, &error))?;
    println!("{PLOT} is written");
    marks::publish("README.md", MARK, &table(comparisons, context))
}

/// One line a scene and setting worth its cost, and what it takes to keep every promise.
fn table(comparisons: &[Comparison], context: &Context) -> String {
    let mut text = format!(
        "| scene | setting | {} a step | worst promise, x its bar | promises held |\n|---|---|--:|--:|--:|\n",
        context.unit
    );
    for comparison in comparisons {
        for candidate in comparison.candidates.iter().filter(|candidate| candidate.on_front) {
            let accuracy = &candidate.evaluation.accuracy;
            let _ = writeln!(
                text,
                "| {} {} | {} | {} | {} | {} of {} |",
                comparison.scene.name,
                comparison.bodies,
                candidate.name(),
                grouped(candidate.evaluation.cost.mean),
                figure(candidate.error()),
                accuracy.held(),
                accuracy.findings.len(),
            );
        }
    }
    let _ = write!(
        text,
        "\nMeasured {}, cost on {}; made by `cargo rig tradeoff --publish`.",
        context.provenance, context.target
    );
    text
}
