//! Steps that put the device itself on trial: a bad link, and faults on purpose. They take images that obey such orders.

use std::env;
use std::path::Path;
use std::process::Command;

use super::scenarios;
use super::step::{Result, Verdict};
use crate::error::Error;
use crate::firmware::image::{self, Board, Build};
use crate::firmware::subprocess;

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

fn on_qemu(trial: &str) -> Result {
    rig(trial, "qemu", &image::build_as(Board::QemuVirt, Build::PROVOKE)?)
}

fn on_esp32c3(trial: &str) -> Result {
    match scenarios::emulated(Build::PROVOKE)? {
        Ok((target, elf)) => rig(trial, &target, &elf),
        Err(missing) => Ok(Verdict::Skipped(missing)),
    }
}

/// Runs a trial with this very program; a part of it that was skipped proves nothing.
fn rig(trial: &str, target: &str, elf: &Path) -> Result {
    let program = env::current_exe().map_err(|error| Error::target(format!("cannot find rig itself: {error}"), ""))?;
    let mut command = Command::new(program);
    command.args([trial, "--target", target, "--elf"]).arg(elf);
    let ended = subprocess::watch(&format!("rig {trial}"), &mut command)?;
    let output = ended.output.trim_end();
    if ended.success && !output.contains("SKIPPED") {
        let held = output.lines().filter(|line| line.starts_with("ok ")).count();
        Ok(Verdict::Passed(format!("{held} trials held\n{output}")))
    } else {
        Ok(Verdict::Failed(format!("cargo rig {trial} --target {}\n{output}", shell_words::quote(target))))
    }
}
