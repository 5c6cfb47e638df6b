//! Builds the firmware for a board.

use std::fmt;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use super::subprocess;
use super::toolchain::{RISCV_TARGET, Toolchain};
use super::workspace;
use crate::error::Error;

/// The profile in the root manifest that device images are built with.
const PROFILE: &str = "firmware";

/// A board that the firmware runs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Board {
    /// QEMU's `virt` machine with an rv32imc core.
    QemuVirt,
    /// ESP32-C3.
    Esp32c3,
    /// ESP32.
    Esp32,
}

impl Board {
    /// The firmware's feature for the board.
    pub fn feature(self) -> &'static str {
        match self {
            Self::QemuVirt => "qemu_virt",
            Self::Esp32c3 => "esp32c3",
            Self::Esp32 => "esp32",
        }
    }
}

impl fmt::Display for Board {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.feature())
    }
}

/// Builds the firmware for a RISC-V board and returns its image; next to no work if it is up to date.
///
/// # Errors
/// If there is no toolchain or the firmware doesn't compile; the error carries the compiler's words.
pub fn build(board: Board) -> Result<PathBuf, Error> {
    let mut cargo = Toolchain::find()?.cargo("build")?;
    choose(board, &mut cargo)?;
    subprocess::run(&format!("building the {board} firmware"), &mut cargo)?;

    // All boards' images leave the build under one name: each gets a place of its own.
    let target_dir = workspace::target_dir()?.join("firmware");
    let built = target_dir.join(RISCV_TARGET).join(PROFILE).join("flat-firmware");
    let images = target_dir.join("images");
    let (image, partial) = (images.join(format!("{board}.elf")), images.join(format!("{board}.partial")));
    // The rename replaces the image in one go, under an emulator that may still be reading the old one.
    fs::create_dir_all(&images)
        .and_then(|()| fs::copy(&built, &partial))
        .and_then(|_| fs::rename(&partial, &image))
        .map_err(|error| {
            Error::target(format!("cannot copy {} to {}: {error}", built.display(), image.display()), "")
        })?;
    Ok(image)
}

/// Chooses package, profile and feature in a cargo call, and tells the firmware its build id.
///
/// The firmware reads the id with `option_env!`, so that cargo rebuilds that one crate when it changes.
///
/// # Errors
/// If the sources cannot be read.
pub fn choose(board: Board, cargo: &mut Command) -> Result<(), Error> {
    cargo.args(["--package", "flat-firmware", "--profile", PROFILE, "--features", board.feature()]);
    cargo.env("FLAT_BUILD", workspace::build_id()?);
    Ok(())
}
