//! Builds the firmware for a board.

use std::fmt;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use clap::{Args, ValueEnum};

use super::esp32::{self, XTENSA_TARGET};
use super::toolchain::{RISCV_TARGET, Toolchain};
use super::{subprocess, workspace};
use crate::error::Error;

/// The profile in the root manifest that device images are built with.
const PROFILE: &str = "firmware";

/// A board that the firmware runs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Board {
    /// QEMU's `virt` machine with an rv32imc core.
    QemuVirt,
    /// ESP32-C3.
    Esp32c3,
    /// ESP32; takes Espressif's compiler.
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

    /// The target that its core is.
    fn target(self) -> &'static str {
        match self {
            Self::QemuVirt | Self::Esp32c3 => RISCV_TARGET,
            Self::Esp32 => XTENSA_TARGET,
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

    /// Physics has the ESP32's second core to itself
    #[arg(long)]
    pub second_core: bool,

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
    pub const PRODUCT: Self =
        Self { provoke: false, usb: false, second_core: false, rtt: false, bare: false, tests: false };
    /// The same for trials.
    pub const PROVOKE: Self = Self { provoke: true, ..Self::PRODUCT };
    /// A device that only talks.
    pub const BARE: Self = Self { bare: true, ..Self::PRODUCT };
    /// The unit tests.
    pub const TESTS: Self = Self { tests: true, ..Self::PRODUCT };

    /// What it adds to the firmware, by the names of its features.
    fn features(self) -> impl Iterator<Item = &'static str> {
        let Self { provoke, usb, second_core, rtt, bare: _, tests } = self;
        [("usb", usb), ("second-core", second_core), ("rtt", rtt), ("provoke", provoke), ("tests", tests)]
            .into_iter()
            .filter(|&(_, is_on)| is_on)
            .map(|(name, _)| name)
    }

    /// What its images' names end in: a word each, since a dash stands between them.
    fn suffix(self) -> String {
        let features = self.features().chain(self.bare.then_some("bare"));
        features.fold(String::new(), |suffix, feature| suffix + "-" + feature.rsplit('-').next().unwrap_or(feature))
    }
}

/// Builds the firmware for a board and returns its image; next to no work if it is up to date.
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
    let mut cargo = match board {
        Board::QemuVirt | Board::Esp32c3 => Toolchain::find()?.cargo("build")?,
        Board::Esp32 => esp32::cargo("build")?,
    };
    choose(board, kind, &mut cargo)?;
    let name = format!("{board}{}", kind.suffix());
    subprocess::run(&format!("building the {name} firmware"), &mut cargo)?;

    // All boards' images leave the build under one name: each gets a place of its own.
    let built = workspace::target_dir()?.join("firmware").join(board.target()).join(PROFILE).join("flat-firmware");
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

/// Chooses package, profile and features in a cargo call, and tells the firmware its build id.
///
/// The firmware reads the id with `option_env!`, so that cargo rebuilds that one crate when it changes.
///
/// # Errors
/// If the sources cannot be read.
pub fn choose(board: Board, kind: Build, cargo: &mut Command) -> Result<(), Error> {
    cargo.args(["--package", "flat-firmware", "--profile", PROFILE, "--features", board.feature()]);
    for feature in kind.features() {
        cargo.args(["--features", feature]);
    }
    if kind.bare {
        cargo.arg("--no-default-features");
    }
    // Another image of the same sources: what reads its logs mustn't take it for this one.
    cargo.env("FLAT_BUILD", workspace::build_id()? + &kind.suffix());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_for_the_esp32_are_those_for_the_esp32c3_with_its_library_compiled() {
        let config = fs::read_to_string(workspace::root().unwrap().join(".cargo/config.toml")).unwrap();
        let alias = |name: &str| {
            let line = config.lines().find(|line| line.starts_with(&format!("{name} = "))).unwrap();
            line.split_once(" = \"").unwrap().1.to_owned()
        };
        for verb in ["build", "flash"] {
            let theirs =
                alias(&format!("{verb}-esp32c3")).replace(RISCV_TARGET, XTENSA_TARGET).replace("esp32c3", "esp32");
            let expected = theirs.replacen(" --package", " -Zbuild-std=core,alloc --package", 1);
            assert_eq!(alias(&format!("{verb}-esp32")), expected);
        }
    }

    #[test]
    fn what_an_image_is_built_for_ends_its_name() {
        assert_eq!(Build::PRODUCT.suffix(), "");
        assert_eq!(Build { usb: true, bare: true, ..Build::PROVOKE }.suffix(), "-usb-provoke-bare");
        assert_eq!(sources("0123-usb-provoke"), "0123");
    }
}
