//! The scenarios and what they promise, as a table.

use comfy_table::{ContentArrangement, Table, presets};
use flat_scenes::{Player, Scene};

use crate::check::Words;

/// Prints the table.
pub fn print(scenes: &[&Scene]) {
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_HORIZONTAL_ONLY)
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_header(["scenario", "purpose", "effects", "bodies", "steps", "promises"]);
    for scene in scenes {
        let parameters = scene.defaults;
        let promises: Vec<String> =
            scene.promises(&parameters, Player::Demo).iter().map(|promise| Words(promise).to_string()).collect();
        table.add_row([
            scene.name.to_owned(),
            scene.purpose.to_owned(),
            scene.effects.to_string(),
            parameters.bodies.to_string(),
            scene.steps.to_string(),
            promises.join("\n"),
        ]);
    }
    println!("{table}");
}
