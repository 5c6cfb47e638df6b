//! The costs on the terminal.

use console::style;

use super::findings::{Costs, SceneCosts, Sizes, Switches, Toggle};
use crate::report::figures::{grouped, table};

/// Prints them.
pub fn print(costs: &Costs) {
    for scene in &costs.scenes {
        println!(
            "{} {} bodies, {}: {} instructions a step",
            style(scene.scene).bold(),
            scene.bodies,
            scene.effects,
            grouped(scene.step)
        );
        let mut table = table(&HEADER);
        for toggle in &scene.toggles {
            table.add_row(row(scene, toggle));
        }
        println!("{table}\n{}\n", switches(scene));
    }
    if let Some(sizes) = &costs.sizes {
        println!("{}", summary(sizes));
        let mut table = table(&SIZES_HEADER);
        for row in size_rows(sizes) {
            table.add_row(row);
        }
        println!("{table}\n");
    }
    let problems = costs.problems();
    if problems.is_empty() {
        println!("{} what isn't called for costs next to nothing", style("ok:").green());
    }
    for problem in problems {
        println!("{} {problem}", style("failed:").red().bold());
    }
}

/// Columns of a scene's table.
pub const HEADER: [&str; 6] = ["effect", "in the scene", "instructions a step", "a body", "of the step", "bits"];
/// Columns of the table of sizes.
pub const SIZES_HEADER: [&str; 6] = [
    "effect",
    "code, alone on gravity",
    "code, beside all others",
    "RAM, alone",
    "functions of its own",
    "linked where it is off",
];

/// A scene's line.
pub fn row(scene: &SceneCosts, toggle: &Toggle) -> Vec<String> {
    let called_for = if toggle.called_for { "called for" } else { "not called for" };
    let Some(cost) = toggle.cost else {
        let why = toggle.refused.as_deref().unwrap_or_default().rsplit(": ").next().unwrap_or_default();
        let cells = [called_for, "can't be turned over", "", "", why];
        return [toggle.effect.to_string()].into_iter().chain(cells.map(str::to_owned)).collect();
    };
    vec![
        toggle.effect.to_string(),
        called_for.into(),
        grouped(cost),
        format!("{:.1}", cost / f64::from(scene.bodies)),
        format!("{:.2} %", scene.percent(cost)),
        if toggle.same_bits { "the same".into() } else { "change".into() },
    ]
}

/// What deciding at run time costs.
pub fn switches(scene: &SceneCosts) -> String {
    let Switches { compiled, run_time, unused, same_bits } = scene.switches;
    format!(
        "In a program for this scene's effects alone a step takes {} instructions, in one for every effect {}: {:.2} % for each of \
         the {unused} that aren't called for. {}",
        grouped(compiled),
        grouped(run_time),
        scene.switches.percent_each(),
        if same_bits { "Both end with the same bits." } else { "They end with other bits!" },
    )
}

/// Lines of the table of sizes.
pub fn size_rows(sizes: &Sizes) -> Vec<Vec<String>> {
    sizes
        .effects
        .iter()
        .map(|size| {
            vec![
                size.effect.clone(),
                grouped(size.to_small.text as f64),
                grouped(size.to_rest.text as f64),
                grouped(size.to_small.ram as f64),
                size.functions.len().to_string(),
                if size.lingering.is_empty() { "none".into() } else { size.lingering.len().to_string() },
            ]
        })
        .collect()
}

/// The two games at the ends.
pub fn summary(sizes: &Sizes) -> String {
    format!(
        "Games built for a set of effects, on riscv32imc, in bytes: gravity and boxes on a floor {} of code and {} of RAM (16 \
         bodies, 32 contacts); with everything {} and {}.",
        grouped(sizes.small.text as f64),
        grouped(sizes.small.ram as f64),
        grouped(sizes.all.text as f64),
        grouped(sizes.all.ram as f64),
    )
}
