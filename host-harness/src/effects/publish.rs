//! The committed copy: a table between two marks in the README.

use std::fmt::Write;

use super::findings::Costs;
use super::table;
use crate::error::Error;
use crate::report::figures::grouped;
use crate::report::marks;

/// The marks' name.
const MARK: &str = "effects";

/// Writes the table.
///
/// # Errors
/// If the README cannot be written or has no such marks.
pub fn publish(costs: &Costs) -> Result<(), Error> {
    marks::publish("README.md", MARK, &markdown(costs))
}

/// A line an effect: what it adds to a step of each scene that doesn't call for it, or takes from one that does, and its bytes.
fn markdown(costs: &Costs) -> String {
    let mut text = String::from("| effect |");
    for scene in &costs.scenes {
        let _ = write!(text, " {} {} |", scene.scene, scene.bodies);
    }
    let sizes = costs.sizes.as_ref();
    text += if sizes.is_some() { " code, alone on gravity | code, beside all others |\n" } else { "\n" };
    let columns = costs.scenes.len() + if sizes.is_some() { 2 } else { 0 };
    let _ = writeln!(text, "|---|{}", "--:|".repeat(columns));
    let first = costs.scenes.first().map_or(&[][..], |scene| &scene.toggles);
    for (line, toggle) in first.iter().enumerate() {
        let _ = write!(text, "| {} |", toggle.effect);
        for scene in &costs.scenes {
            let toggle = &scene.toggles[line];
            let cell = match toggle.cost {
                None => "-".into(),
                Some(cost) if toggle.called_for => format!("**{}** ({:.1} %)", grouped(cost), scene.percent(cost)),
                Some(cost) => format!("{} ({:.2} %)", grouped(cost), scene.percent(cost)),
            };
            let _ = write!(text, " {cell} |");
        }
        if let Some(size) = sizes.and_then(|sizes| sizes.effects.get(line)) {
            let _ = write!(text, " {} | {} |", grouped(size.to_small.text as f64), grouped(size.to_rest.text as f64));
        }
        text.push('\n');
    }
    text += "\nInstructions of a step on rv32imc, bytes on riscv32imc. **Bold** is called for by the scene: what turning it off saves; the \
             rest is what turning it on costs a scene without any use for it. ";
    if let Some(sizes) = sizes {
        text += &table::summary(sizes);
    }
    let _ = write!(text, "\nMeasured {}; made by `cargo rig effects --publish`.", costs.provenance);
    text
}
