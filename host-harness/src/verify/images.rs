//! Steps on the firmware and its images.

use std::env;

use serde_json::Value;

use super::step::{Result, Verdict};
use crate::error::Error;
use crate::firmware::elf::Image;
use crate::firmware::esp32::{self, Outcome};
use crate::firmware::image::{self, Board, Build};
use crate::firmware::inspect::Inspection;
use crate::firmware::provision;
use crate::firmware::toolchain::{RISCV_TARGET, Toolchain};
use crate::firmware::{subprocess, workspace};

/// Findings that are shown in full before the rest is only counted.
const SHOWN: usize = 20;

pub(super) fn provision() -> Result {
    provision::provision().map(Verdict::Passed)
}

pub(super) fn build_qemu_virt() -> Result {
    build(Board::QemuVirt)
}

pub(super) fn build_esp32c3() -> Result {
    build(Board::Esp32c3)
}

fn build(board: Board) -> Result {
    let image = Image::read(&image::build(board)?)?;
    Ok(Verdict::Passed(image.sizes.to_string()))
}

pub(super) fn lint_qemu_virt() -> Result {
    // Programs of the harness that are for bare metal, too; what they compute is the same on any target.
    let mut clippy = Toolchain::find()?.clippy()?;
    clippy.args(["--package", "flat-probe", "--package", "flat-xtensa", "--", "-Dwarnings"]);
    subprocess::run("clippy on the harness's programs for bare metal", &mut clippy)?;
    lint(Board::QemuVirt)
}

pub(super) fn lint_esp32c3() -> Result {
    lint(Board::Esp32c3)
}

/// The product and what shows its use, then what is built for other ends.
fn lint(board: Board) -> Result {
    let trials = Build { rtt: true, ..Build::PROVOKE };
    for kind in [Build::PRODUCT, trials, Build::TESTS, Build::BARE] {
        let mut clippy = Toolchain::find()?.clippy()?;
        image::choose(board, kind, &mut clippy)?;
        clippy.args(["--bins", "--examples", "--", "-Dwarnings"]);
        subprocess::run(&format!("clippy on the {board} firmware"), &mut clippy)?;
    }
    Ok(Verdict::Passed("no warnings".into()))
}

pub(super) fn elf_qemu_virt() -> Result {
    let image = Image::read(&image::build(Board::QemuVirt)?)?;
    instructions(&image)
}

pub(super) fn elf_esp32c3() -> Result {
    let image = Image::read(&image::build(Board::Esp32c3)?)?;
    let instructions = match instructions(&image)? {
        Verdict::Passed(text) => text,
        otherwise => return Ok(otherwise),
    };
    let inspection = Inspection::of(&image)?;
    let problems = inspection.problems();
    Ok(match &problems[..] {
        [] => Verdict::Passed(format!("{instructions}; {}", inspection.summary())),
        problems => Verdict::Failed(shown("what must not be in RAM or want from flash", problems)),
    })
}

/// Images that no other step builds: the other link, the other way for logs at another rate, and what shows the engine's use.
pub(super) fn variants_esp32c3() -> Result {
    image::build_as(Board::Esp32c3, Build::USB)?;
    let mut cargo = Toolchain::find()?.cargo("build")?;
    image::choose(Board::Esp32c3, Build { rtt: true, ..Build::PRODUCT }, &mut cargo)?;
    cargo.args(["--bins", "--examples"]).env("FLAT_BAUD", "115200");
    let _turn = image::turn()?;
    subprocess::run("building the examples, and the firmware with RTT for 115200 baud", &mut cargo)?;
    Ok(Verdict::Passed("usb; rtt at 115200 baud; the examples".into()))
}

/// The workspace's own commands for people with boards, up to the board itself: its runner only prints what it would do.
pub(super) fn aliases() -> Result {
    let toolchain = Toolchain::find()?;
    let rig = env::current_exe().map_err(|error| Error::target(format!("cannot find rig itself: {error}"), ""))?;
    let runner = Value::from(vec![&*rig.to_string_lossy(), "flash", "esp32c3", "--print", "--elf"]);
    let _turn = image::turn()?;
    for alias in ["build-qemu-virt", "flash-esp32c3"] {
        let mut cargo = toolchain.cargo(alias)?;
        cargo.env("FLAT_BUILD", workspace::build_id()?);
        cargo.args(["--config", &format!("target.{RISCV_TARGET}.runner={runner}")]);
        let said = subprocess::run(&format!("cargo {alias}"), &mut cargo)?;
        if alias.starts_with("flash") && !said.contains("espflash flash --chip esp32c3 ") {
            return Ok(Verdict::Failed(format!("cargo {alias} doesn't come to espflash:\n{said}")));
        }
    }
    Ok(Verdict::Passed("build-qemu-virt; flash-esp32c3, up to espflash".into()))
}

/// Looks for instructions that an rv32imc core traps on, with our decoder and with binutils'.
fn instructions(image: &Image) -> Result {
    let count = image.instructions().count();
    if count == 0 {
        return Ok(Verdict::Failed(format!("{} holds no instructions", image.path.display())));
    }
    let foreign: Vec<_> = image.foreign().iter().map(ToString::to_string).collect();
    if !foreign.is_empty() {
        return Ok(Verdict::Failed(shown("instructions of A, F or D", &foreign)));
    }
    match image.second_opinion()? {
        Some(unreadable) if !unreadable.is_empty() => {
            Ok(Verdict::Failed(shown("objdump reads more than rv32imc", &unreadable)))
        }
        Some(_) => Ok(Verdict::Passed(format!("{count} instructions, none of A, F or D; objdump agrees"))),
        None => Ok(Verdict::Passed(format!("{count} instructions, none of A, F or D"))),
    }
}

pub(super) fn esp32() -> Result {
    Ok(match esp32::check()? {
        Outcome::Built(path) => Verdict::Passed(format!("built {}", path.display())),
        Outcome::TypeChecked { release } => {
            Verdict::Passed(format!("a type-check with rustc {release}, not a build: no Xtensa compiler here"))
        }
        Outcome::Skipped(why) => Verdict::Skipped(why),
    })
}

fn shown(what: &str, findings: &[String]) -> String {
    let mut text = format!("{what}: {}", findings.len());
    for finding in findings.iter().take(SHOWN) {
        text.push_str("\n  ");
        text.push_str(finding);
    }
    if findings.len() > SHOWN {
        text.push_str("\n  ...");
    }
    text
}
