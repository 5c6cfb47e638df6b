//! Builds the firmware for a board.

use std::fmt;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use clap::Args;

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

/// What an image is built for, beside its board.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Args)]
#[group(id = "build_kind")]
#[allow(clippy::struct_excessive_bools, reason = "switches of a command line, each by itself")]
pub struct Build {
    /// A test build: it obeys commands that make it fail
    #[arg(long)]
    pub provoke: bool,

    /// For the ESP32-C3's own USB port instead of UART0
    #[arg(long)]
    pub usb: bool,

    /// Logs go to a debug probe's RTT instead of the link
    #[arg(long)]
    pub rtt: bool,

    /// Without the engine and its scenes: a device that only talks
    #[arg(long)]
    pub bare: bool,

    /// Not the product but its unit tests, as `rig test` runs them
    #[arg(long)]
    pub tests: bool,
}

impl Build {
    /// A product for UART0.
    pub const PRODUCT: Self = Self { provoke: false, usb: false, rtt: false, bare: false, tests: false };
    /// The same for trials.
    pub const PROVOKE: Self = Self { provoke: true, ..Self::PRODUCT };
    /// A device that only talks.
    pub const BARE: Self = Self { bare: true, ..Self::PRODUCT };
    /// The unit tests.
    pub const TESTS: Self = Self { tests: true, ..Self::PRODUCT };

    /// What it adds to the firmware, by the names of its features.
    fn features(self) -> impl Iterator<Item = &'static str> {
        let features = [("usb", self.usb), ("rtt", self.rtt), ("provoke", self.provoke), ("tests", self.tests)];
        features.into_iter().filter(|&(_, is_on)| is_on).map(|(name, _)| name)
    }
}

/// Builds the firmware for a RISC-V board and returns its image; next to no work if it is up to date.
///
/// # Errors
/// If there is no toolchain or the firmware doesn't compile; the error carries the compiler's words.
pub fn build(board: Board) -> Result<PathBuf, Error> {
    build_as(board, Build::PRODUCT)
}

/// Builds the firmware for use or for tests.
///
/// # Errors
/// As [`build`].
pub fn build_as(board: Board, kind: Build) -> Result<PathBuf, Error> {
    let mut cargo = Toolchain::find()?.cargo("build")?;
    choose(board, &mut cargo)?;
    let mut suffix = String::new();
    for feature in kind.features() {
        cargo.args(["--features", feature]);
        suffix = format!("{suffix}-{feature}");
    }
    if kind.bare {
        cargo.arg("--no-default-features");
        suffix += "-bare";
    }
    // Another image of the same sources: what reads its logs mustn't take it for this one.
    cargo.env("FLAT_BUILD", workspace::build_id()? + &suffix);
    let name = format!("{board}{suffix}");
    subprocess::run(&format!("building the {name} firmware"), &mut cargo)?;

    // All boards' images leave the build under one name: each gets a place of its own.
    let built = workspace::target_dir()?.join("firmware").join(RISCV_TARGET).join(PROFILE).join("flat-firmware");
    let image = path(&name)?;
    let partial = image.with_extension("partial");
    // The rename replaces the image in one go, under an emulator that may still be reading the old one.
    fs::create_dir_all(image.with_file_name(""))
        .and_then(|()| fs::copy(&built, &partial))
        .and_then(|_| fs::rename(&partial, &image))
        .map_err(|error| {
            Error::target(format!("cannot copy {} to {}: {error}", built.display(), image.display()), "")
        })?;
    Ok(image)
}

/// The part of a build's name that identifies its sources.
pub fn sources(build: &str) -> &str {
    build.split('-').next().unwrap_or(build)
}

/// Where the image of a board that says of itself to be of this build is, if it was built here.
///
/// # Errors
/// If the workspace is gone.
pub fn of(board: &str, build: &str) -> Result<PathBuf, Error> {
    let features = build.find('-').map_or("", |start| &build[start..]);
    path(&format!("{board}{features}"))
}

fn path(name: &str) -> Result<PathBuf, Error> {
    Ok(workspace::target_dir()?.join("firmware/images").join(format!("{name}.elf")))
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
