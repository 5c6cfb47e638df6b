//! Comparisons as comma-separated values: a line for each scene and setting.

use std::fmt::Write;

use super::Context;
use super::findings::Comparison;
use crate::setting::lowercase;

/// The file's text.
pub fn text(comparisons: &[Comparison], context: &Context) -> String {
    let mut text =
        "scene,bodies,steps,level,iterations,scalar,unit,mean,p99,worst,error,promises_held,promises_failed,pareto,\
                    worst_promise,measured,limit,measured_unit,deepest_overlap_px\n"
            .to_owned();
    for comparison in comparisons {
        for candidate in &comparison.candidates {
            let (setting, cost) = (&candidate.evaluation.setting, &candidate.evaluation.cost);
            let accuracy = &candidate.evaluation.accuracy;
            let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value}"));
            let worst = candidate.worst();
            let _ = writeln!(
                text,
                "{},{},{},{},{},{},{},{:.1},{},{},{},{},{},{},{},{},{},{},{}",
                comparison.scene.name,
                comparison.bodies,
                comparison.steps,
                lowercase(&setting.level),
                setting.iterations.map_or_else(String::new, |passes| passes.to_string()),
                lowercase(&setting.scalar),
                context.unit,
                cost.mean,
                cost.p99,
                cost.worst,
                candidate.error(),
                accuracy.held(),
                accuracy.failed(),
                candidate.on_front,
                worst.map_or_else(String::new, |finding| finding.check.replace(',', ";")),
                number(worst.and_then(|finding| finding.measured)),
                number(worst.and_then(|finding| finding.limit)),
                worst.map_or("", |finding| finding.unit),
                number(accuracy.deepest()),
            );
        }
    }
    text
}
