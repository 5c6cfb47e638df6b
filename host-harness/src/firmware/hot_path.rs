//! The proof that scheduler and step lie in the ESP32-C3's instruction RAM.
//!
//! Code in flash waits for the cache, about 2 us a miss, so that a step's length would hang on what ran before it. The proof
//! follows direct jumps; calls through pointers, of which the engine has none, it cannot see.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;

use super::dwarf::Place;
use super::elf::Image;
use super::instructions::Instruction;
use crate::error::Error;

/// Instruction RAM behind the cache's own 16 kB: "Internal Memory" in the *ESP32-C3 Technical Reference Manual*.
const IRAM: Range<u32> = 0x4038_0000..0x403e_0000;
/// Mask ROM, as fast as RAM: esp-hal lets the linker find `memcpy` and soft floats there.
const ROM: Range<u32> = 0x4000_0000..0x4006_0000;

/// What each step runs, as beginnings of paths, in the order of the pipeline.
///
/// Each must have code, and all its code, inlined copies included, must lie in RAM. A name without code fails the check: what
/// was renamed proves nothing.
const HOT_PATH: [&str; 9] = [
    // How many steps are due. The rest of the scheduler only answers questions.
    "flat_physics::pipeline::scheduler::Scheduler::elapse",
    "flat_physics::pipeline::scheduler::Scheduler::take",
    // The stages. Whatever else stands beside them in their modules, a spawn may call from flash.
    "flat_physics::pipeline::broadphase::detect",
    "flat_physics::pipeline::narrowphase::",
    "flat_physics::pipeline::integrate::velocities",
    "flat_physics::pipeline::velocity::solve",
    "flat_physics::pipeline::integrate::positions",
    "flat_physics::pipeline::position::correct",
    "flat_physics::pipeline::events::publish",
];

/// What the hot path may call in flash, as beginnings of names.
const COLD: [&str; 5] = [
    // Panics end the program: what they cost is nobody's jitter.
    "core::panicking::",
    "core::slice::index::slice_index_fail",
    "core::option::expect_failed",
    "core::option::unwrap_failed",
    // Square roots of f32 and f64, which are here to be compared with fixed point, not to be fast.
    "libm::math::sqrt",
];

/// What the check found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Places of the hot path: functions and inlined copies of functions.
    pub places: usize,
    /// Their bytes together with those of what they call in RAM.
    pub bytes: u32,
    /// What is wrong, a line each; empty if the proof holds.
    pub problems: BTreeSet<String>,
}

/// Looks where the hot path lies, and where it jumps to.
///
/// # Errors
/// If the image's debug information is damaged.
pub fn check(image: &Image) -> Result<Report, Error> {
    let places = image.places(|name| HOT_PATH.iter().any(|start| name.starts_with(start)))?;
    Ok(examine(image, &places, &HOT_PATH))
}

fn examine(image: &Image, places: &[Place], names: &[&'static str]) -> Report {
    let mut report = Report::default();
    for name in names {
        let found: Vec<_> = places.iter().filter(|place| place.function.starts_with(name)).collect();
        if found.is_empty() {
            report.problems.insert(format!("{name} has no code: if it was renamed, tell {}", file!()));
        }
        for Place { function, code } in found.iter().filter(|place| !IRAM.contains(&place.code.start)) {
            let within = image.function_at(code.start).map_or("?", |function| &function.name);
            report.problems.insert(format!("{:#010x} is not in RAM: {function}, in {within}", code.start));
        }
        report.places += found.len();
    }
    let jumps = jumps(image);
    let in_ram = places.iter().filter(|place| IRAM.contains(&place.code.start));
    let mut hot: Vec<_> = in_ram.map(|place| place.code.clone()).collect();
    let mut followed = BTreeSet::new();
    let mut next = 0;
    while let Some(code) = hot.get(next).cloned() {
        next += 1;
        for (from, &to) in jumps.range(code) {
            if ROM.contains(&to) {
                continue;
            }
            let Some(callee) = image.function_at(to) else {
                report.problems.insert(format!("{from:#010x} jumps to {to:#010x}, which has no name"));
                continue;
            };
            if !IRAM.contains(&to) {
                if !COLD.iter().any(|start| callee.name.starts_with(start)) {
                    report.problems.insert(format!("{from:#010x} calls {} at {to:#010x}, not in RAM", callee.name));
                }
            } else if to == callee.address && followed.insert(to) {
                hot.push(callee.address..callee.address + callee.size);
            }
        }
    }
    report.bytes = covered(hot);
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

/// All direct jumps and calls, from where to where.
fn jumps(image: &Image) -> BTreeMap<u32, u32> {
    let mut before: Option<(u32, Instruction)> = None;
    let mut jumps = BTreeMap::new();
    for (address, instruction) in image.instructions() {
        let far = before.and_then(|(at, auipc)| auipc.far_jump_target(instruction, at));
        if let Some(target) = far.or_else(|| instruction.jump_target(address)) {
            jumps.insert(address, target);
        }
        before = Some((address, instruction));
    }
    jumps
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

    fn image(functions: &[(&str, u32)], code: &[(u32, &[u32])]) -> Image {
        let function = |&(name, address): &(&str, u32)| Function { name: name.to_owned(), address, size: 16 };
        let bytes: Vec<(u32, Vec<u8>)> =
            code.iter().map(|(at, words)| (*at, words.iter().flat_map(|word| word.to_le_bytes()).collect())).collect();
        let code: Vec<_> = bytes.iter().map(|(at, bytes)| (*at, &bytes[..])).collect();
        Image::of(functions.iter().map(function).collect(), &code, Sizes::default())
    }

    fn place(function: &str, start: u32) -> Place {
        Place { function: function.to_owned(), code: start..start + 16 }
    }

    fn problems(image: &Image, places: &[Place], names: &[&'static str]) -> Vec<String> {
        examine(image, places, names).problems.into_iter().collect()
    }

    #[test]
    fn code_in_ram_passes() {
        let image = image(&[("run", RAM)], &[]);
        let report = examine(&image, &[place("engine::step", RAM), place("engine::step", RAM + 8)], &["engine::"]);
        assert_eq!((report.places, report.bytes, report.problems.len()), (2, 24, 0));
    }

    #[test]
    fn one_inlined_copy_in_flash_fails() {
        let image = image(&[("run", RAM), ("load", FLASH)], &[]);
        let places = [place("engine::step", RAM), place("engine::step", FLASH)];
        assert_eq!(problems(&image, &places, &["engine::"]), ["0x42000000 is not in RAM: engine::step, in load"]);
    }

    #[test]
    fn a_name_without_code_fails() {
        let problems = problems(&image(&[], &[]), &[place("engine::step", RAM)], &["engine::", "scheduler"]);
        assert!(matches!(&problems[..], [problem] if problem.contains("scheduler")), "{problems:?}");
    }

    #[test]
    fn calls_are_followed_through_ram_into_flash() {
        let functions =
            [("step", RAM), ("sort", RAM + 16), ("slow", FLASH), ("core::panicking::panic", FLASH + 0x1000)];
        // step: jal sort. sort: auipc ra, jalr 0 - 16(ra) to slow; the same to the panic.
        let code: [(u32, &[u32]); 2] =
            [(RAM, &[0x0100_00ef]), (RAM + 16, &[0x01c8_0097, 0xff00_80e7, 0x01c8_1097, 0xfe80_80e7])];
        let found = problems(&image(&functions, &code), &[place("engine::step", RAM)], &["engine::"]);
        assert_eq!(found, ["0x40380014 calls slow at 0x42000000, not in RAM"]);
    }
}
