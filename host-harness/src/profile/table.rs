//! A profile on the terminal.

use comfy_table::Table;
use console::style;

use super::findings::{Capacity, Point, Profile};
use crate::measure::{Clock, Summary};
use crate::report::figures::{grouped, table};

/// Prints it.
pub fn print(profile: &Profile) {
    let Profile { scene, setting, steps, unit, .. } = profile;
    println!(
        "{} {setting}; {unit} a step, {steps} steps; mean of steps {} to {steps}, p99 and worst of all",
        style(scene).bold(),
        steps / 2 + 1,
    );
    if let Some(limit) = &profile.limit {
        println!("{} {limit}", style("note:").yellow());
    }
    if profile.points.len() > 1 {
        println!("{}", curve(profile));
    }
    if let Some(largest) = profile.points.last() {
        println!("{}", stages(largest));
        println!("{}", memory(profile, largest));
    }
    println!("cycles: {}", profile.cycles.basis);
    for clock in Clock::USUAL {
        println!("{}", verdict(profile, clock));
    }
}

fn stages(point: &Point) -> Table {
    let bodies = format!("{} bodies", point.bodies);
    let mut table = table(&[&bodies, "mean", "p99", "worst", "at step", "of the mean"]);
    for stage in &point.stages {
        let share = 100.0 * stage.cost.mean / point.total.mean.max(1.0);
        table.add_row(row(&stage.stage, &stage.cost, format!("{share:.1} %")));
    }
    table.add_row(row("step", &point.total, String::new()));
    table
}

fn row(name: &str, cost: &Summary, share: String) -> [String; 6] {
    [
        name.to_owned(),
        grouped(cost.mean),
        grouped(cost.p99 as f64),
        grouped(cost.worst as f64),
        cost.worst_step.to_string(),
        share,
    ]
}

fn curve(profile: &Profile) -> Table {
    let mut table = table(&["bodies", "contacts, most", "mean", "a body", "p99", "worst", "of 160 MHz", "of 240 MHz"]);
    for point in &profile.points {
        let load = |clock| format!("{:.1} %", 100.0 * profile.cycles.load(point.total.worst as f64, clock));
        table.add_row([
            point.bodies.to_string(),
            point.contacts_peak.to_string(),
            grouped(point.total.mean),
            grouped(point.total.mean / f64::from(point.bodies)),
            grouped(point.total.p99 as f64),
            grouped(point.total.worst as f64),
            load(Clock::USUAL[0]),
            load(Clock::USUAL[1]),
        ]);
    }
    table
}

/// What a world of that many bodies and contacts takes.
pub fn memory(profile: &Profile, point: &Point) -> String {
    let memory = &profile.memory;
    let contacts = usize::from(point.contacts_peak);
    let total = usize::from(point.in_world) * memory.body + contacts * memory.contact + memory.fixed;
    format!(
        "memory: {} bytes a body, {} a contact; {} bodies and {contacts} contacts at the most: {} bytes",
        memory.body,
        memory.contact,
        point.in_world,
        grouped(total as f64),
    )
}

/// What a clock has time for.
pub fn verdict(profile: &Profile, clock: Clock) -> String {
    let found = profile.capacities.iter().find(|capacity| capacity.clock == clock);
    let about = if profile.cycles.estimated { "estimated" } else { "counted" };
    let ends = (profile.points.first(), profile.points.last());
    match (found, ends) {
        (Some(Capacity { fits: Some(fits), fails: Some(fails), .. }), _) => {
            format!("60 Hz at {clock}: {fits} bodies hold it in every step ({about}; {fails} don't, both measured)")
        }
        (Some(Capacity { fits: Some(fits), .. }), _) => {
            format!("60 Hz at {clock}: all up to {fits} bodies hold it in every step ({about})")
        }
        (Some(_), (Some(first), _)) => {
            format!("60 Hz at {clock}: not even {} bodies hold it in every step ({about})", first.bodies)
        }
        (_, (_, Some(last))) => {
            let load = 100.0 * profile.cycles.load(last.total.worst as f64, clock);
            format!("60 Hz at {clock}: the worst step takes {load:.1} % of the time between two ({about})")
        }
        _ => String::new(),
    }
}
