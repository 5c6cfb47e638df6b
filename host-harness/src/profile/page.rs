//! A profile as a page: the answer first, then the curve, then where the time goes.

use super::findings::{Point, Profile};
use super::table::{memory, verdict};
use crate::measure::clock::Share;
use crate::measure::{Clock, Summary};
use crate::report::figures::grouped;
use crate::report::page::Page;
use crate::report::plot::{Limit, Mark, Plot, Series};
use crate::report::scale::Axis;

/// The file's text.
pub fn text(profile: &Profile, command: &str) -> String {
    let Profile { scene, setting, steps, unit, .. } = profile;
    let mut page = Page::new(
        &format!("{scene}: what a step costs"),
        &format!(
            "Scene {scene}, {setting}, seed {}, {steps} steps of 1/60 s on {} ({}). Costs are {unit} of the engine's six stages, \
             without link and digests. Means are over steps {} to {steps}; p99 and worst are over the whole run.",
            profile.seed,
            profile.target.label,
            profile.target.board,
            steps / 2 + 1,
        ),
    );
    for clock in Clock::USUAL {
        page.answer(&verdict(profile, clock));
    }
    page.paragraph(&format!("Cycles are {}.", profile.cycles.basis));
    page.paragraph(profile.limit.as_deref().unwrap_or_default());
    if profile.points.len() > 1 {
        curve(&mut page, profile);
    }
    if let Some(point) = profile.points.last() {
        stages(&mut page, profile, point);
        page.section("Memory", &memory(profile, point));
    }
    if !profile.cycles.mix.is_empty() {
        mix(&mut page, profile);
    }
    page.finish(&profile.provenance, command)
}

fn curve(page: &mut Page, profile: &Profile) {
    page.section(
        "How the cost grows",
        "Each mark is a measurement. A dashed line is the time that a processor of that clock has between two steps: \
         below it, 60 steps a second hold.",
    );
    let series = |name: &str, of: &dyn Fn(&Point) -> f64| Series {
        name: name.into(),
        joined: true,
        marked: true,
        broken: false,
        look: None,
        points: profile
            .points
            .iter()
            .map(|point| Mark {
                x: f64::from(point.bodies),
                y: of(point),
                note: format!("{} bodies: {}", point.bodies, grouped(of(point))),
                ringed: false,
            })
            .collect(),
    };
    let limits = Clock::USUAL
        .map(|clock| Limit { name: format!("all of {clock}"), value: clock.budget() / profile.cycles.per_count });
    let highest = profile.points.iter().map(|point| point.total.worst as f64).fold(0.0, f64::max);
    page.plot(&Plot {
        title: "Cost of a step by number of bodies".into(),
        x: Axis::linear("bodies"),
        y: Axis::linear(format!("{} a step", profile.unit)),
        series: vec![
            series("worst step", &|point| point.total.worst as f64),
            series("99 % of steps", &|point| point.total.p99 as f64),
            series("mean", &|point| point.total.mean),
        ],
        // A budget far above everything would only flatten the curves.
        limits: limits.into_iter().filter(|limit| limit.value < 3.0 * highest).collect(),
    });
    let header = ["bodies", "contacts, most", "mean", "mean a body", "p99", "worst", "worst at step"];
    let loads = Clock::USUAL.map(|clock| format!("worst, of {clock}"));
    let header: Vec<String> = header.iter().map(ToString::to_string).chain(loads).collect();
    let rows: Vec<Vec<String>> = profile.points.iter().map(|point| curve_row(profile, point)).collect();
    page.table(&header, &rows, |index| {
        profile.capacities.iter().any(|capacity| capacity.fits == Some(profile.points[index].bodies))
    });
}

fn curve_row(profile: &Profile, point: &Point) -> Vec<String> {
    let Summary { mean, p99, worst, worst_step } = point.total;
    let loads = Clock::USUAL.map(|clock| format!("{:.1} %", 100.0 * profile.cycles.load(worst as f64, clock)));
    [
        point.bodies.to_string(),
        point.contacts_peak.to_string(),
        grouped(mean),
        grouped(mean / f64::from(point.bodies)),
        grouped(p99 as f64),
        grouped(worst as f64),
        worst_step.to_string(),
    ]
    .into_iter()
    .chain(loads)
    .collect()
}

fn stages(page: &mut Page, profile: &Profile, point: &Point) {
    page.section(
        &format!("Where the time goes, {} bodies", point.bodies),
        "The stages in the order in which they run. The worst step is the dearest whole step, not the sum of each stage's worst.",
    );
    let header = ["stage", "mean", "of the mean", "p99", "worst", "worst at step"].map(str::to_owned);
    let row = |name: &str, cost: &Summary| {
        vec![
            name.to_owned(),
            grouped(cost.mean),
            format!("{:.1} %", 100.0 * cost.mean / point.total.mean.max(1.0)),
            grouped(cost.p99 as f64),
            grouped(cost.worst as f64),
            cost.worst_step.to_string(),
        ]
    };
    let mut rows: Vec<_> = point.stages.iter().map(|stage| row(&stage.stage, &stage.cost)).collect();
    rows.push(row("step", &point.total));
    let total = rows.len() - 1;
    page.table(&header, &rows, |index| index == total);
    let series = point.series.iter().map(|(stage, counts)| {
        let values: Vec<f64> = counts.iter().map(|&count| count as f64).collect();
        Series::over_steps(stage.to_string(), &values)
    });
    page.plot(&Plot {
        title: format!("Cost of each stage over the run, {} bodies", point.bodies),
        x: Axis::linear("step, 60 a second"),
        y: Axis::linear(format!("{} a step", profile.unit)),
        series: series.collect(),
        limits: Vec::new(),
    });
}

fn mix(page: &mut Page, profile: &Profile) {
    page.section(
        "From instructions to cycles",
        "QEMU counts instructions exactly, and knows no cycles. The estimate charges each class of instructions what the ESP32-C3 \
         takes for it, the upper figure where that depends on operands or neighbours: a load whose value isn't used at once \
         takes 1, a division 3 to 35.",
    );
    let header = ["class", "of all instructions", "cycles each"].map(str::to_owned);
    let row =
        |share: &Share| vec![share.class.into(), format!("{:.1} %", 100.0 * share.part), share.cycles.to_string()];
    let rows: Vec<_> = profile.cycles.mix.iter().map(row).collect();
    page.table(&header, &rows, |_| false);
}
