//! The ESP32-C3's flash in Espressif's QEMU, which knows that chip; the QEMU of distributions doesn't.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::child;
use super::link::Link;
use crate::error::Error;
use crate::firmware::flash;
use crate::firmware::image::Board;
use crate::firmware::provision::QEMU;
use crate::firmware::toolchain;

/// The machine's name.
const MACHINE: &str = "esp32c3";
const INSTALL: &str = "Espressif's QEMU, `python $IDF_PATH/tools/idf_tools.py install qemu-riscv32`, first on the path";

/// Whether what it takes is installed.
///
/// # Errors
/// If not; the error names what is missing.
pub fn probe() -> Result<(), Error> {
    let Some(qemu) = toolchain::installed(QEMU) else {
        return Err(Error::target(format!("no {QEMU} on the path"), INSTALL));
    };
    let machines = Command::new(&qemu).args(["-machine", "help"]).output();
    let knows = machines.is_ok_and(|output| {
        String::from_utf8_lossy(&output.stdout).lines().any(|line| line.split(' ').next() == Some(MACHINE))
    });
    if !knows {
        return Err(Error::target(format!("{} has no machine `{MACHINE}`", qemu.display()), INSTALL));
    }
    if toolchain::installed("espflash").is_none() {
        return Err(Error::target("espflash isn't installed: it makes the flash's contents", flash::INSTALL));
    }
    Ok(())
}

/// Puts an image into a flash and starts QEMU on it.
///
/// # Errors
/// If something is missing, or fails.
pub fn open(elf: &Path) -> Result<Link, Error> {
    probe()?;
    let contents = contents_of(elf);
    flash::save(Board::Esp32c3, elf, &contents)?;
    let mut command = Command::new(QEMU);
    command.args(["-machine", MACHINE, "-icount", "3", "-display", "none", "-monitor", "none", "-serial", "stdio"]);
    command.arg("-drive").arg(format!("file={},if=mtd,format=raw", contents.display()));
    child::spawn(&mut command, INSTALL)
}

/// Beside the image; QEMU writes to it as the chip would.
fn contents_of(elf: &Path) -> PathBuf {
    elf.with_extension("flash.bin")
}
