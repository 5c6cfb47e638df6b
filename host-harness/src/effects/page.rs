//! The costs as a page.

use super::findings::Costs;
use super::table::{HEADER, SIZES_HEADER, row, size_rows, summary, switches};
use crate::report::figures::grouped;
use crate::report::page::Page;

/// The file's text.
pub fn text(costs: &Costs) -> String {
    let mut page = Page::new(
        "What each effect costs",
        "A scene pays only for the effects that it calls for. Each effect is turned over on the same scenes: off where it is \
         called for, on where it isn't. Where the bits change, the run is another one, and the difference isn't the effect's \
         alone.",
    );
    let problems = costs.problems();
    if problems.is_empty() {
        page.answer("What isn't called for costs next to nothing, and is not linked.");
    }
    for problem in &problems {
        page.answer(problem);
    }
    for scene in &costs.scenes {
        page.section(
            &format!("{}, {} bodies", scene.scene, scene.bodies),
            &format!(
                "Calls for {}: {} instructions a step, mean of the run's second half, in QEMU, decided at run time.",
                scene.effects,
                grouped(scene.step)
            ),
        );
        let rows: Vec<_> = scene.toggles.iter().map(|toggle| row(scene, toggle)).collect();
        page.table(&HEADER.map(str::to_owned), &rows, |index| scene.toggles[index].called_for);
        page.paragraph(&switches(scene));
    }
    if let Some(sizes) = &costs.sizes {
        page.section("Bytes", &summary(sizes));
        page.table(&SIZES_HEADER.map(str::to_owned), &size_rows(sizes), |_| false);
        let own = sizes.effects.iter().filter(|size| !size.functions.is_empty());
        for size in own {
            page.paragraph(&format!("Only {} brings {}.", size.effect, size.functions.join(", ")));
        }
    }
    page.finish(&costs.provenance, &crate::profile::command())
}
