//! The proof that what each step runs lies in the ESP32-C3's instruction RAM, by name.
//!
//! Code in flash waits for the cache, about 2 us a miss, so that a step's length would hang on what ran before it. Names are
//! found through the debug information, which knows inlined copies too, and so the proof covers what is called through
//! pointers. What all that wants from flash is listed in [`super::references`].

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;

use super::dwarf::Place;
use super::elf::Image;
use super::references::IRAM;
use crate::error::Error;

/// What lies between the timer's interrupt and the end of a step, as beginnings of paths, in the order in which it runs.
///
/// Each must have code, and all its code, inlined copies included, must lie in RAM. A name without code fails the check: what
/// was renamed proves nothing.
const HOT_PATH: [&str; 15] = [
    // The timer queue, and the turn of the executor for physics.
    "esp_rtos::timer::TimeDriver::arm_next_wakeup",
    "esp_rtos::timer::timer_tick_handler",
    "embassy_executor::raw::waker::wake",
    "esp_rtos::embassy::handle_interrupt",
    // How many steps are due. The rest of the scheduler only answers questions.
    "flat_physics::pipeline::scheduler::Scheduler::elapse",
    "flat_physics::pipeline::scheduler::Scheduler::take",
    // The stages. Whatever else stands beside them in their modules, a spawn may call from flash.
    "flat_physics::pipeline::broadphase::update",
    "flat_physics::pipeline::narrowphase::",
    "flat_physics::pipeline::integrate::velocities",
    "flat_physics::pipeline::flat::solve",
    "flat_physics::pipeline::grounded::",
    "flat_physics::pipeline::warm_start::",
    "flat_physics::pipeline::integrate::positions",
    "flat_physics::pipeline::position::correct",
    "flat_physics::pipeline::events::publish",
];

/// The number formats that are here to be compared with fixed point, not to be fast: their code stays in flash.
const FLOATS: [&str; 2] = ["::<f32", "::<f64"];

/// What the check found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Places of the hot path: functions and inlined copies of functions.
    pub places: usize,
    /// Their bytes.
    pub bytes: u32,
    /// What is wrong, a line each; empty if the proof holds.
    pub problems: BTreeSet<String>,
}

/// Looks where the hot path lies.
///
/// # Errors
/// If the image's debug information is damaged.
pub fn check(image: &Image) -> Result<Report, Error> {
    let places = image.places(|name| {
        HOT_PATH.iter().any(|start| name.starts_with(start)) && !FLOATS.iter().any(|format| name.contains(format))
    })?;
    Ok(examine(image, &places, &HOT_PATH))
}

fn examine(image: &Image, places: &[Place], names: &[&'static str]) -> Report {
    let mut report = Report::default();
    // By the function that holds the code: where it starts, and what of the hot path is in it.
    let mut outside: BTreeMap<&str, (u32, BTreeSet<&str>)> = BTreeMap::new();
    for name in names {
        let found: Vec<_> = places.iter().filter(|place| place.function.starts_with(name)).collect();
        if found.is_empty() {
            report.problems.insert(format!("{name} has no code: if it was renamed, tell {}", file!()));
        }
        for Place { function, code } in found.iter().filter(|place| !IRAM.contains(&place.code.start)) {
            let (start, inside) = outside.entry(image.code_name(code.start)).or_insert((code.start, BTreeSet::new()));
            *start = code.start.min(*start);
            inside.insert(function.split_once("::<").map_or(function.as_str(), |(path, _)| path));
        }
        report.places += found.len();
    }
    for (within, (start, inside)) in outside {
        let inside: Vec<_> = inside.into_iter().collect();
        report.problems.insert(format!("{start:#010x} is not in RAM: {within} holds {}", inside.join(", ")));
    }
    report.bytes = covered(places.iter().map(|place| place.code.clone()).collect());
    report
}

/// Bytes that lie in at least one of the ranges.
fn covered(mut ranges: Vec<Range<u32>>) -> u32 {
    ranges.sort_by_key(|range| range.start);
    let (total, _) = ranges.iter().fold((0, 0), |(total, end), range| {
        (total + range.end.saturating_sub(range.start.max(end)), end.max(range.end))
    });
    total
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "hot path of {} bytes in RAM, at {} places", self.bytes, self.places)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::firmware::elf::{Function, Sizes};

    const RAM: u32 = 0x4038_0000;
    const FLASH: u32 = 0x4200_0000;

    fn image(functions: &[(&str, u32)]) -> Image {
        let function = |&(name, address): &(&str, u32)| Function { name: name.to_owned(), address, size: 16 };
        Image::of(functions.iter().map(function).collect(), &[], Sizes::default())
    }

    fn place(function: &str, start: u32) -> Place {
        Place { function: function.to_owned(), code: start..start + 16 }
    }

    fn problems(image: &Image, places: &[Place], names: &[&'static str]) -> Vec<String> {
        examine(image, places, names).problems.into_iter().collect()
    }

    #[test]
    fn code_in_ram_passes() {
        let image = image(&[("run", RAM)]);
        let report = examine(&image, &[place("engine::step", RAM), place("engine::step", RAM + 8)], &["engine::"]);
        assert_eq!((report.places, report.bytes, report.problems.len()), (2, 24, 0));
    }

    #[test]
    fn one_inlined_copy_in_flash_fails() {
        let image = image(&[("run", RAM), ("load", FLASH)]);
        let places = [place("engine::step", RAM), place("engine::step", FLASH)];
        assert_eq!(problems(&image, &places, &["engine::"]), ["0x42000000 is not in RAM: load holds engine::step"]);
    }

    #[test]
    fn a_name_without_code_fails() {
        let problems = problems(&image(&[]), &[place("engine::step", RAM)], &["engine::", "scheduler"]);
        assert!(matches!(&problems[..], [problem] if problem.contains("scheduler")), "{problems:?}");
    }
}
