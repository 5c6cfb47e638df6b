//! Builds the firmware for a board.

use std::env;
use std::fmt;
use std::path::PathBuf;
use std::process::Command;

use clap::{Args, ValueEnum};

use super::esp32::{self, XTENSA_TARGET};
use super::product::Turn;
use super::toolchain::{RISCV_TARGET, Toolchain};
use super::{subprocess, workspace};
use crate::error::Error;

/// The profile in the root manifest that device images are built with.
pub const PROFILE: &str = "firmware";

/// What `.cargo/config.toml` says of `DEFMT_LOG`, and what else is a word.
const USUAL_LOGS: &str = "info";
const LOG_LEVELS: [&str; 5] = ["off", "error", "warn", "debug", "trace"];
/// Bytes of a build's name in the protocol, and how many digits of it identify the sources at least.
const LONGEST_NAME: usize = 32;
const LEAST_DIGITS: usize = 8;

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
    /// A product for the ESP32-C3's own USB port.
    pub const USB: Self = Self { usb: true, ..Self::PRODUCT };
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
    fn suffix(self, environment: &Environment) -> String {
        let features = self.features().chain(self.bare.then_some("bare"));
        let words = features.map(|feature| feature.rsplit('-').next().unwrap_or(feature).to_owned());
        words.chain(environment.words()).fold(String::new(), |suffix, word| suffix + "-" + &word)
    }
}

/// What variables of the environment change in an image.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Environment {
    /// `FLAT_BAUD`: UART0's rate; none = the usual one.
    baud: Option<String>,
    /// `DEFMT_LOG`: the logs that are compiled in; none = those of `.cargo/config.toml`.
    logs: Option<String>,
}

impl Environment {
    fn read() -> Self {
        let other_than = |name: &str, usual: &str| env::var(name).ok().filter(|value| value != usual);
        Self { baud: other_than("FLAT_BAUD", &flat_wire::BAUD.to_string()), logs: other_than("DEFMT_LOG", USUAL_LOGS) }
    }

    /// A word for each that isn't as usual. A filter is no word: a hash stands for it.
    fn words(&self) -> impl Iterator<Item = String> {
        let logs = self.logs.as_ref().map(|filter| {
            if LOG_LEVELS.contains(&&**filter) {
                filter.clone()
            } else {
                format!("{:04x}", workspace::hash(filter.as_bytes()) & 0xffff)
            }
        });
        self.baud.clone().into_iter().chain(logs)
    }
}

/// The rate of UART0 in images that are built now.
///
/// # Errors
/// If `FLAT_BAUD` is no number.
pub fn baud() -> Result<u32, Error> {
    let Some(baud) = Environment::read().baud else { return Ok(flat_wire::BAUD) };
    baud.parse().map_err(|_| Error::usage(format!("FLAT_BAUD is `{baud}`, not a number of baud"), "FLAT_BAUD=115200"))
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
    let name = format!("{board}{}", kind.suffix(&Environment::read()));
    let turn = turn()?;
    subprocess::run(&format!("building the {name} firmware"), &mut cargo)?;
    let built = directory()?.join(board.target()).join(PROFILE).join("flat-firmware");
    let image = path(&name)?;
    turn.keep(&built, &image)?;
    Ok(image)
}

/// Waits for the turn to build firmware.
///
/// # Errors
/// As [`Turn::wait`].
pub fn turn() -> Result<Turn, Error> {
    Turn::wait(&directory()?)
}

/// Cargo's target directory for the boards.
///
/// # Errors
/// If there is no workspace.
pub fn directory() -> Result<PathBuf, Error> {
    Ok(workspace::target_dir()?.join("firmware"))
}

/// Whether a build is of the sources with this id.
pub fn is_of_sources(build: &str, id: &str) -> bool {
    let digits = build.split('-').next().unwrap_or(build);
    digits.len() >= LEAST_DIGITS && id.starts_with(digits)
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
    Ok(directory()?.join("images").join(format!("{name}.elf")))
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
    cargo.env("FLAT_BUILD", build_name(&workspace::build_id()?, &kind.suffix(&Environment::read()))?);
    Ok(())
}

/// A build's name: as many digits of its sources' id as there is room for, and what it was built for.
fn build_name(id: &str, suffix: &str) -> Result<String, Error> {
    match LONGEST_NAME.checked_sub(suffix.len()) {
        Some(digits) if digits >= LEAST_DIGITS => Ok(id[..digits.min(id.len())].to_owned() + suffix),
        _ => Err(Error::usage(
            format!("a build's name has {LONGEST_NAME} bytes, too few for `{suffix}`"),
            "leave some of its switches out",
        )),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

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
        let usual = Environment::default();
        assert_eq!(Build::PRODUCT.suffix(&usual), "");
        let other = Build { usb: true, bare: true, ..Build::PROVOKE };
        assert_eq!(other.suffix(&usual), "-usb-provoke-bare");
        let environment = |baud: &str, logs: &str| Environment { baud: Some(baud.into()), logs: Some(logs.into()) };
        assert_eq!(Build::BARE.suffix(&environment("115200", "debug")), "-bare-115200-debug");
        assert_eq!(Build::BARE.suffix(&environment("9600", "info,flat=trace")), "-bare-9600-8b78");
    }

    #[test]
    fn a_build_is_of_its_sources_however_many_of_their_digits_its_name_has_room_for() {
        const ID: &str = "0123456789abcdef";
        for (suffix, expected) in
            [("", ID), ("-usb", "0123456789abcdef-usb"), ("-usb-rtt-provoke-bare", "0123456789a-usb-rtt-provoke-bare")]
        {
            let name = build_name(ID, suffix).unwrap();
            assert_eq!(name, expected);
            assert!(is_of_sources(&name, ID) && !is_of_sources(&name, "0123456fffffffff"), "{name}");
        }
        assert!(build_name(ID, "-usb-rtt-provoke-bare-115200").is_err());
    }
}
