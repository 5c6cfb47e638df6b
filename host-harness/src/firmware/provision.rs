//! Installs what is missing for firmware and emulator where it may, and else says exactly what to install.

use std::env;
use std::process::Command;

use super::subprocess;
use super::toolchain::{self, DEBIAN_COMPILER, RISCV_TARGET, Toolchain};
use super::{workspace, xtensa};
use crate::error::{Error, Kind};

/// The emulator of the `qemu_virt` board.
pub const QEMU: &str = "qemu-system-riscv32";
/// A disassembler that gives a second opinion on images; done without where it is missing.
pub const OBJDUMP: &str = "riscv64-unknown-elf-objdump";

/// Sees to a compiler for the boards and an emulator; returns what compiles now, in a line.
///
/// # Errors
/// If something is missing that cannot be installed from here; the error says how to install it by hand.
pub fn provision() -> Result<String, Error> {
    if Toolchain::find().and_then(|toolchain| toolchain.clippy()).is_err() {
        install_compiler()?;
    }
    let tools =
        [(QEMU, "qemu-system-misc"), (OBJDUMP, "binutils-riscv64-unknown-elf"), (xtensa::ASSEMBLER, xtensa::BINUTILS)];
    let missing: Vec<_> =
        tools.iter().filter(|(tool, _)| toolchain::installed(tool).is_none()).map(|&(_, package)| package).collect();
    if !missing.is_empty() && may_install_packages() {
        install_packages(&missing)?;
    }
    let toolchain = Toolchain::find()?;
    if toolchain::installed(QEMU).is_none() {
        return Err(Error::target(
            format!("no {QEMU} on the path"),
            "`apt install qemu-system-misc`, `dnf install qemu-system-riscv-core` or `brew install qemu`",
        ));
    }
    Ok(toolchain.describe())
}

/// Tries rustup, then Debian's packages. Where neither may install, [`Toolchain::find`] says what to do.
fn install_compiler() -> Result<(), Error> {
    if toolchain::installed("rustup").is_some() && rustup_may_install() {
        match rustup(&["target", "add", RISCV_TARGET]) {
            Ok(()) => {
                // Only the type-check for the ESP32 needs the library's sources; it says so where they are missing.
                return rustup(&["component", "add", "rust-src"]).or_else(unless_interrupted);
            }
            Err(error) if !may_install_packages() => return Err(error),
            Err(error) => unless_interrupted(error)?,
        }
    }
    if may_install_packages() {
        install_packages(&DEBIAN_COMPILER)?;
    }
    Ok(())
}

fn rustup(arguments: &[&str]) -> Result<(), Error> {
    let mut rustup = Command::new("rustup");
    rustup.current_dir(workspace::root()?).args(arguments);
    subprocess::run(&format!("rustup {}", arguments.join(" ")), &mut rustup).map(drop)
}

fn install_packages(packages: &[&str]) -> Result<(), Error> {
    let apt = || {
        let mut apt = Command::new("apt-get");
        apt.env("DEBIAN_FRONTEND", "noninteractive");
        apt
    };
    subprocess::run("apt-get update", apt().arg("update"))?;
    let title = format!("apt-get install {}", packages.join(" "));
    subprocess::run(&title, apt().args(["install", "--yes", "--no-install-recommends"]).args(packages)).map(drop)
}

/// What went wrong may be made up for in another way, unless somebody wants out.
fn unless_interrupted(error: Error) -> Result<(), Error> {
    if error.kind() == Kind::Interrupted { Err(error) } else { Ok(()) }
}

/// Whether this is Debian or its like, and we are root.
fn may_install_packages() -> bool {
    toolchain::installed("apt-get").is_some() && is_root()
}

#[cfg(unix)]
fn is_root() -> bool {
    nix::unistd::geteuid().is_root()
}

#[cfg(not(unix))]
fn is_root() -> bool {
    false
}

/// Whether rustup may fetch by itself; its own variable can forbid it.
fn rustup_may_install() -> bool {
    env::var_os("RUSTUP_AUTO_INSTALL").is_none_or(|value| value != "0")
}
