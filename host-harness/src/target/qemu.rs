//! The `qemu_virt` firmware in QEMU: a real rv32imc image over an emulated UART.

use std::path::Path;
use std::process::Command;

use super::child;
use super::link::Link;
use crate::error::Error;
use crate::firmware::provision::QEMU;

/// The board. `lowrisc-ibex` is exactly rv32imc: atomics and floats trap, as on an ESP32-C3.
const MACHINE: &str = "-M virt -cpu lowrisc-ibex -m 16M -smp 1 -bios none -display none -monitor none";

/// How fast the virtual processor is; either way `sleep=off` doesn't wait for the wall clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Speed {
    /// 125 million instructions a virtual second, as on an ESP32-C3.
    #[default]
    Board,
    /// 1000 million: a step has long ended, and the line gone quiet, when the next one begins, so that no interrupt is counted
    /// into a stage.
    Quiet,
}

impl Speed {
    /// Virtual nanoseconds of an instruction, as a power of two.
    fn shift(self) -> u8 {
        match self {
            Self::Board => 3,
            Self::Quiet => 0,
        }
    }
}

/// Starts QEMU on an image.
///
/// # Errors
/// If the image isn't there or QEMU cannot be started.
pub fn open(elf: &Path, speed: Speed) -> Result<Link, Error> {
    if !elf.is_file() {
        return Err(Error::target(
            format!("no firmware image at {}", elf.display()),
            "leave --elf out and rig builds the image itself",
        ));
    }
    let mut command = machine(elf, speed);
    command.args(["-serial", "stdio"]);
    child::spawn(&mut command, "`cargo verify` installs it; or by hand: apt install qemu-system-misc")
}

/// A call of QEMU on an image that asks its debugger for arguments, by semihosting, and tells it how it ends.
pub fn with_arguments(elf: &Path, arguments: &[&str]) -> Command {
    let mut command = machine(elf, Speed::Board);
    let config = format!("enable=on,target=native,arg={}", arguments.join(",arg="));
    command.args(["-serial", "none", "-semihosting-config", &config]);
    command
}

fn machine(elf: &Path, speed: Speed) -> Command {
    let mut command = Command::new(QEMU);
    command.args(MACHINE.split_whitespace()).arg("-icount").arg(format!("shift={},sleep=off", speed.shift()));
    command.arg("-kernel").arg(elf);
    command
}
