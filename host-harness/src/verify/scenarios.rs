//! Steps that run scenarios, through the command line that people use.

use std::env;
use std::path::PathBuf;
use std::process::Command;

use super::step::{Result, Verdict};
use crate::error::{CHECK_FAILED, Error};
use crate::firmware::image::{self, Board, Build};
use crate::firmware::subprocess::{self, Ended};
use crate::firmware::xtensa;
use crate::target::{Target, esp_qemu};

/// A command that runs an ESP32-C3 image, `{elf}`, with the board's link on its standard input and output: `uart0`, or `usb` if
/// the command has a `{link}` to say so.
const EMULATOR: &str = "FLAT_C3_EMULATOR";

/// Where [`flip`] inverts a bit: after which stage of which step, which body, which bit of its velocity.
const FLIP: (u32, &str, u16, u8) = (37, "solve_velocity", 12, 3);

pub(super) fn mock() -> Result {
    rig(&["--target", "mock"])
}

pub(super) fn qemu_fixed() -> Result {
    rig(&["--target", "mock,qemu", "--scalar", "fixed"])
}

pub(super) fn qemu_f32() -> Result {
    rig(&["--target", "mock,qemu", "--scalar", "f32"])
}

pub(super) fn esp32c3_fixed() -> Result {
    esp32c3("fixed")
}

pub(super) fn esp32c3_f32() -> Result {
    esp32c3("f32")
}

pub(super) fn xtensa() -> Result {
    match xtensa::build()? {
        Ok(program) => {
            let target = Target::Exec(xtensa::emulation(&program)).to_string();
            rig(&["--target", "mock", "--target", &target, "--scalar", "fixed"])
        }
        Err(missing) => Ok(Verdict::Skipped(missing)),
    }
}

pub(super) fn esp_qemu() -> Result {
    match esp_qemu::probe() {
        Ok(()) => rig(&["--target", "mock,esp-qemu", "--scalar", "fixed"]),
        Err(missing) => Ok(Verdict::Skipped(missing.to_string())),
    }
}

fn esp32c3(scalar: &str) -> Result {
    match emulated(Build::PRODUCT)? {
        Ok((target, _)) => rig(&["--target", "mock", "--target", &target.to_string(), "--scalar", scalar]),
        Err(missing) => Ok(Verdict::Skipped(missing)),
    }
}

/// The other link: what the scenes come to doesn't hang on it, so that one of them will do.
pub(super) fn esp32c3_usb() -> Result {
    match emulated(Build::USB)? {
        Ok((target, elf)) => {
            let (target, elf) = (target.to_string(), elf.to_string_lossy());
            rig(&["ball_pit", "--target", "mock", "--target", &target, "--elf", &elf])
        }
        Err(missing) => Ok(Verdict::Skipped(missing)),
    }
}

/// The target that runs an ESP32-C3 image under emulation, and the image; else why there is none.
pub(super) fn emulated(kind: Build) -> core::result::Result<core::result::Result<(Target, PathBuf), String>, Error> {
    let Ok(command) = env::var(EMULATOR) else {
        return Ok(Err(format!(
            "no emulator for the ESP32-C3: set {EMULATOR} to a command with {{elf}} for the image, {{link}} for `uart0` or \
             `usb`, and that link on its standard input and output"
        )));
    };
    if !command.contains("{elf}") {
        return Err(Error::usage(format!("{EMULATOR} is `{command}`, without {{elf}}"), "say where the image goes"));
    }
    if kind.usb && !command.contains("{link}") {
        return Ok(Err(format!("{EMULATOR} has no {{link}}, where this step would say `usb` and others `uart0`")));
    }
    let elf = image::build_as(Board::Esp32c3, kind)?;
    let link = if kind.usb { "usb" } else { "uart0" };
    let command = command.replace("{link}", link).replace("{elf}", &shell_words::quote(&elf.to_string_lossy()));
    Ok(Ok((Target::Exec(command), elf)))
}

/// A comparison that cannot fail proves nothing: here it must fail, and say where.
pub(super) fn flip() -> Result {
    let (step, stage, body, bit) = FLIP;
    let point = format!("{step}:{stage}:{body}:{bit}");
    let ended = run(&["ball_pit", "--target", "mock,qemu", "--flip", &point])?;
    let named = [format!("step {step}"), stage.to_owned(), format!("body {body}")];
    let missing: Vec<_> = named.iter().filter(|name| !ended.output.contains(*name)).collect();
    if ended.code != Some(i32::from(CHECK_FAILED)) {
        Ok(Verdict::Failed(format!(
            "a bit was flipped and rig ended with {:?}:\n{}",
            ended.code,
            ended.output.trim_end()
        )))
    } else if missing.is_empty() {
        Ok(Verdict::Passed(format!("located: {}", named.join(", "))))
    } else {
        Ok(Verdict::Failed(format!("the failure doesn't name {missing:?}:\n{}", ended.output.trim_end())))
    }
}

fn rig(arguments: &[&str]) -> Result {
    let ended = run(arguments)?;
    let output = ended.output.trim_end();
    if ended.success {
        Ok(Verdict::Passed(output.lines().last().unwrap_or_default().trim().to_owned()))
    } else {
        Ok(Verdict::Failed(format!("cargo rig run {}\n{output}", shell_words::join(arguments))))
    }
}

/// Runs `rig run` with this very program.
fn run(arguments: &[&str]) -> core::result::Result<Ended, Error> {
    let program = env::current_exe().map_err(|error| Error::target(format!("cannot find rig itself: {error}"), ""))?;
    subprocess::watch("rig run", Command::new(program).arg("run").args(arguments))
}
