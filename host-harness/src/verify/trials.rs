//! Steps that put the device itself on trial: a bad link, and faults on purpose. They take images that obey such orders.

use std::env;
use std::path::Path;
use std::process::Command;

use super::scenarios;
use super::step::{Result, Verdict};
use crate::error::Error;
use crate::firmware::image::{self, Board, Build};
use crate::firmware::subprocess::{self, Ended};
use crate::firmware::suite;

pub(super) fn link_qemu() -> Result {
    on_qemu("stress")
}

pub(super) fn link_esp32c3() -> Result {
    on_esp32c3("stress")
}

pub(super) fn faults_qemu() -> Result {
    on_qemu("faults")
}

pub(super) fn faults_esp32c3() -> Result {
    on_esp32c3("faults")
}

pub(super) fn tests_qemu() -> Result {
    let ended = run("test", &["qemu_virt"])?;
    Ok(verdict(&ended, "rig test qemu_virt"))
}

/// Links the same tests for the chip.
pub(super) fn tests_esp32c3() -> Result {
    let tests = suite::list(&image::build_as(Board::Esp32c3, Build::TESTS)?)?;
    Ok(Verdict::Passed(format!("{} tests linked, and none run: `cargo rig test esp32c3` does on a board", tests.len())))
}

fn on_qemu(trial: &str) -> Result {
    rig(trial, "qemu", &image::build_as(Board::QemuVirt, Build::PROVOKE)?)
}

fn on_esp32c3(trial: &str) -> Result {
    match scenarios::emulated(Build::PROVOKE)? {
        Ok((target, elf)) => rig(trial, &target.to_string(), &elf),
        Err(missing) => Ok(Verdict::Skipped(missing)),
    }
}

/// Runs a trial of a target.
fn rig(trial: &str, target: &str, elf: &Path) -> Result {
    let ended = run(trial, &["--target", target, "--elf", &elf.to_string_lossy()])?;
    Ok(verdict(&ended, &format!("rig {trial} --target {}", shell_words::quote(target))))
}

/// Runs this very program.
fn run(subcommand: &str, arguments: &[&str]) -> core::result::Result<Ended, Error> {
    let program = env::current_exe().map_err(|error| Error::target(format!("cannot find rig itself: {error}"), ""))?;
    subprocess::watch(&format!("rig {subcommand}"), Command::new(program).arg(subcommand).args(arguments))
}

/// What the lines of a trial come to; a part of it that was skipped proves nothing.
fn verdict(ended: &Ended, command: &str) -> Verdict {
    let output = ended.output.trim_end();
    let held = output.lines().filter(|line| line.starts_with("ok ")).count();
    if ended.success && held > 0 && !output.contains("SKIPPED") {
        Verdict::Passed(format!("{held} trials held\n{output}"))
    } else {
        Verdict::Failed(format!("cargo {command}\n{output}"))
    }
}
