//! The `qemu_virt` firmware in QEMU: a real rv32imc image over an emulated UART.

use std::path::Path;
use std::process::Command;

use super::child;
use super::link::Link;
use crate::error::Error;
use crate::firmware::provision::QEMU;

/// The board. `lowrisc-ibex` is exactly rv32imc: atomics and floats trap, as on an ESP32-C3.
/// `shift=3` runs 125 million instructions a virtual second; `sleep=off` doesn't wait for the wall clock.
const MACHINE: &str = "-M virt -cpu lowrisc-ibex -m 16M -smp 1 -bios none -display none -monitor none \
                       -serial stdio -icount shift=3,sleep=off";

/// Starts QEMU on an image.
///
/// # Errors
/// If the image isn't there or QEMU cannot be started.
pub fn open(elf: &Path) -> Result<Link, Error> {
    if !elf.is_file() {
        return Err(Error::target(
            format!("no firmware image at {}", elf.display()),
            "leave --elf out and rig builds the image itself",
        ));
    }
    let mut command = Command::new(QEMU);
    command.args(MACHINE.split_whitespace()).arg("-kernel").arg(elf);
    child::spawn(&mut command, "`cargo verify` installs it; or by hand: apt install qemu-system-misc")
}
