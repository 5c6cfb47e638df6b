//! `rig verify`: everything that must hold before a change goes in, in one command that also installs what it needs.

mod bare;
mod baseline;
mod host;
mod images;
mod scenarios;
mod standalone;
mod step;
mod summary;
mod trials;

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Instant;

use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::error::{Error, Kind};
use step::{Result as StepResult, Step, Verdict};
use summary::Line;

/// Arguments of `rig verify`.
#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// Prints the steps and does nothing
    #[arg(long)]
    list: bool,

    /// Does only this step; may be repeated
    #[arg(long, value_name = "STEP", value_parser = PossibleValuesParser::new(names()))]
    only: Vec<String>,
}

/// Steps on the host's own crates, in their order; what finds most mistakes in least time comes first.
const HOST: [Step; 6] = [
    Step::new("format", "cargo fmt --check", &[], host::format),
    Step::new("lint", "clippy on the host's crates", &[], host::lint),
    Step::new("test", "unit, property and documentation tests", &[], host::test),
    Step::new("doc", "documentation without warnings", &[], host::doc),
    Step::new("scenes-mock", "all scenarios on the mock", &[], scenarios::mock),
    Step::new("lint-oracles", "clippy on the engines that flat is measured beside", &[], host::lint_oracles),
];

/// Steps on the firmware, which go on beside the others: neither needs the other's results, nor cargo's lock on them.
const FIRMWARE: [Step; 29] = [
    Step::new("provision", "compiler for the boards, and an emulator", &[], images::provision),
    Step::new("build-qemu_virt", "the image for QEMU", &["provision"], images::build_qemu_virt),
    Step::new("build-esp32c3", "the image for the ESP32-C3", &["provision"], images::build_esp32c3),
    Step::new(
        "lint-qemu_virt",
        "clippy on the firmware for QEMU, and on the harness's own programs for bare metal",
        &["provision"],
        images::lint_qemu_virt,
    ),
    Step::new("lint-esp32c3", "clippy on the firmware for the ESP32-C3", &["provision"], images::lint_esp32c3),
    Step::new(
        "elf-qemu_virt",
        "no instruction outside rv32imc in QEMU's image",
        &["build-qemu_virt"],
        images::elf_qemu_virt,
    ),
    Step::new(
        "elf-esp32c3",
        "the same for the ESP32-C3, and its hot path in RAM",
        &["build-esp32c3"],
        images::elf_esp32c3,
    ),
    Step::new(
        "baseline",
        "no more instructions and no more bytes than the committed ones",
        &["build-qemu_virt", "build-esp32c3"],
        baseline::compare,
    ),
    Step::new(
        "variants-esp32c3",
        "the ESP32-C3's other images, and the examples",
        &["provision"],
        images::variants_esp32c3,
    ),
    Step::new(
        "aliases",
        "cargo's commands for boards, as far as they go without one",
        &["build-qemu_virt", "build-esp32c3"],
        images::aliases,
    ),
    Step::new("esp32", "the ESP32's firmware: a build, or else a type-check", &[], images::esp32),
    Step::new("scenes-qemu", "the same bits on QEMU, fixed point", &["build-qemu_virt"], scenarios::qemu_fixed),
    Step::new("scenes-qemu-f32", "the same bits on QEMU, binary32", &["build-qemu_virt"], scenarios::qemu_f32),
    Step::new("flip", "one flipped bit on QEMU is noticed and located", &["build-qemu_virt"], scenarios::flip),
    Step::new(
        "scenes-esp32c3",
        "the same bits on an emulated ESP32-C3, fixed point",
        &["build-esp32c3"],
        scenarios::esp32c3_fixed,
    ),
    Step::new(
        "scenes-esp32c3-f32",
        "the same bits on an emulated ESP32-C3, binary32",
        &["build-esp32c3"],
        scenarios::esp32c3_f32,
    ),
    Step::new(
        "usb-esp32c3",
        "the same bits over an emulated ESP32-C3's own USB port",
        &["provision"],
        scenarios::esp32c3_usb,
    ),
    Step::new("demo-qemu", "without a host: demos on QEMU", &["build-qemu_virt"], standalone::qemu_virt),
    Step::new("demo-esp32c3", "without a host: demos on an emulated ESP32-C3", &["build-esp32c3"], standalone::esp32c3),
    Step::new(
        "scenes-xtensa",
        "the same bits on an Xtensa core in QEMU, fixed point",
        &["provision"],
        scenarios::xtensa,
    ),
    Step::new(
        "scenes-esp-qemu",
        "the same bits from the ESP32-C3's flash in Espressif's QEMU",
        &["build-esp32c3"],
        scenarios::esp_qemu,
    ),
    Step::new(
        "bare-qemu_virt",
        "without physics: nothing of it, and a device that talks",
        &["build-qemu_virt"],
        bare::qemu_virt,
    ),
    Step::new("bare-esp32c3", "the same for the ESP32-C3", &["provision"], bare::esp32c3),
    Step::new("tests-qemu", "the firmware's unit tests, on QEMU", &["provision"], trials::tests_qemu),
    Step::new("tests-esp32c3", "the same, linked for the ESP32-C3", &["provision"], trials::tests_esp32c3),
    Step::new("link-qemu", "a bad link delays no step on QEMU", &["build-qemu_virt"], trials::link_qemu),
    Step::new(
        "link-esp32c3",
        "a bad link delays no step on an emulated ESP32-C3",
        &["build-esp32c3"],
        trials::link_esp32c3,
    ),
    Step::new(
        "faults-qemu",
        "faults on QEMU say what, where and by which calls",
        &["build-qemu_virt"],
        trials::faults_qemu,
    ),
    Step::new("faults-esp32c3", "the same on an emulated ESP32-C3", &["build-esp32c3"], trials::faults_esp32c3),
];

/// Goes through the steps; true if none failed. A step that fails stops only those that need it.
///
/// # Errors
/// On Ctrl-C.
pub fn run(arguments: &VerifyArgs) -> Result<bool, Error> {
    if arguments.list {
        summary::list(&HOST);
        summary::list(&FIRMWARE);
        return Ok(true);
    }
    let chosen = |steps: &[Step]| steps.iter().copied().filter(|step| arguments.chooses(step)).collect::<Vec<_>>();
    let lanes = [chosen(&HOST), chosen(&FIRMWARE)];
    let count = Count { begun: AtomicUsize::new(0), of: lanes.iter().map(Vec::len).sum() };
    let lines = thread::scope(|scope| {
        let running = lanes.each_ref().map(|steps| scope.spawn(|| go_through(steps, &count)));
        let ended = running.map(|lane| lane.join().unwrap_or_else(|panic| resume_unwind(panic)));
        ended.into_iter().collect::<Result<Vec<_>, Error>>()
    })?
    .concat();
    summary::table(&lines);
    Ok(!lines.iter().any(|line| matches!(line.verdict, Verdict::Failed(_))))
}

/// How many steps were begun so far, and how many there are.
struct Count {
    begun: AtomicUsize,
    of: usize,
}

fn go_through(steps: &[Step], count: &Count) -> Result<Vec<Line>, Error> {
    let mut lines: Vec<Line> = Vec::new();
    for step in steps {
        summary::announce(count.begun.fetch_add(1, Ordering::Relaxed) + 1, count.of, step);
        let started = Instant::now();
        let verdict = match missing(step, &lines) {
            Some(needed) => Verdict::Skipped(format!("needs {needed}, which didn't pass")),
            None => settle((step.check)())?,
        };
        let line = Line { step: step.name, verdict, duration: started.elapsed() };
        summary::report(&line);
        lines.push(line);
    }
    Ok(lines)
}

impl VerifyArgs {
    fn chooses(&self, step: &Step) -> bool {
        self.only.is_empty() || self.only.iter().any(|name| name == step.name)
    }
}

fn names() -> impl Iterator<Item = &'static str> {
    HOST.iter().chain(&FIRMWARE).map(|step| step.name)
}

/// A step that this one needs and that was gone through without passing.
fn missing(step: &Step, done: &[Line]) -> Option<&'static str> {
    let unmet = |line: &&Line| step.needs.contains(&line.step) && !matches!(line.verdict, Verdict::Passed(_));
    done.iter().find(unmet).map(|line| line.step)
}

/// Whatever goes wrong in a step is that step's failure, except that somebody wants out.
fn settle(result: StepResult) -> Result<Verdict, Error> {
    match result {
        Err(error) if error.kind() == Kind::Interrupted => Err(error),
        Err(error) => Ok(Verdict::Failed(error.to_string())),
        Ok(verdict) => Ok(verdict),
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn steps_need_only_what_comes_before() {
        for steps in [&HOST[..], &FIRMWARE] {
            for (index, step) in steps.iter().enumerate() {
                for needed in step.needs {
                    assert!(steps[..index].iter().any(|before| before.name == *needed), "{} needs {needed}", step.name);
                }
            }
        }
    }

    #[test]
    fn a_step_waits_for_what_it_needs_and_for_nothing_else() {
        let line = |step, verdict| Line { step, verdict, duration: Duration::ZERO };
        let done = [line("lint", Verdict::Failed("why".into())), line("provision", Verdict::Passed(String::new()))];
        let step = Step::new("build", "", &["provision"], host::format);
        assert_eq!(missing(&step, &done), None);
        let step = Step::new("release", "", &["provision", "lint"], host::format);
        assert_eq!(missing(&step, &done), Some("lint"));
    }
}
