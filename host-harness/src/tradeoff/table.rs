//! A comparison on the terminal.

use console::style;

use super::Context;
use super::findings::{Candidate, Comparison, figure};
use crate::report::figures::{grouped, table};

/// Prints it.
pub fn print(comparison: &Comparison, context: &Context) {
    println!(
        "{} {} bodies, {} steps; {} a step on {}; error: how much of what is allowed the worst promise used",
        style(comparison.scene.name).bold(),
        comparison.bodies,
        comparison.steps,
        context.unit,
        context.target,
    );
    let mut table = table(&["setting", "mean", "worst", "error", "promises", "", "worst promise"]);
    for candidate in &comparison.candidates {
        table.add_row(row(candidate));
    }
    println!("{table}\n{}\n", comparison.answer(context.unit));
}

fn row(candidate: &Candidate) -> [String; 7] {
    let accuracy = &candidate.evaluation.accuracy;
    [
        candidate.name(),
        grouped(candidate.evaluation.cost.mean),
        grouped(candidate.evaluation.cost.worst as f64),
        figure(candidate.error()),
        format!("{} of {}", accuracy.held(), accuracy.findings.len()),
        if candidate.on_front { "Pareto".into() } else { String::new() },
        candidate.worst_promise(),
    ]
}
