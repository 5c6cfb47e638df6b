//! A profile as comma-separated values: a line for each body count and stage, and for the whole step.

use std::fmt::Write;

use super::findings::Profile;
use crate::measure::Summary;

/// The file's text.
pub fn text(profile: &Profile) -> String {
    let mut text = "scene,bodies,contacts_peak,stage,unit,mean,p99,worst,worst_step\n".to_owned();
    for point in &profile.points {
        let stages = point.stages.iter().map(|stage| (stage.stage.as_str(), &stage.cost));
        for (stage, cost) in stages.chain([("step", &point.total)]) {
            let Summary { mean, p99, worst, worst_step } = cost;
            let _ = writeln!(
                text,
                "{},{},{},{stage},{},{mean:.1},{p99},{worst},{worst_step}",
                profile.scene, point.bodies, point.contacts_peak, profile.unit
            );
        }
    }
    text
}
