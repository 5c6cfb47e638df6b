//! The command line.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand, ValueEnum};
use flat_physics::Stage;
use flat_rig::variant::VariantArgs;
use flat_wire::message::{Flip, Level, Order, Point, ScalarKind};

use crate::advise::AdviseArgs;
use crate::baseline::BaselineArgs;
use crate::effects::EffectsArgs;
use crate::firmware::flash::FlashArgs;
use crate::firmware::image::{Board, Build};
use crate::firmware::inspect::InspectArgs;
use crate::input::Inputs;
use crate::job::Job;
use crate::monitor::MonitorArgs;
use crate::peers::PeersArgs;
use crate::profile::ProfileArgs;
use crate::setting::Setting;
use crate::target::reset::ResetArgs;
use crate::target::{Target, TargetList};
use crate::tradeoff::TradeoffArgs;
use crate::trials::faults::FaultsArgs;
use crate::trials::stress::StressArgs;
use crate::trials::unit_tests::TestArgs;
use crate::verify::VerifyArgs;

/// Runs flat's scenes on the in-process mock, on QEMU and on boards, and checks what must hold.
#[derive(Debug, Parser)]
#[command(name = "rig", bin_name = "cargo rig", version)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What rig can do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Runs scenarios on one or more targets and checks their promises
    Run(RunArgs),
    /// Does everything that must pass before a change goes in, and installs what that needs
    Verify(VerifyArgs),
    /// Says where a scene's time goes, stage by stage, and how many bodies hold 60 steps a second
    Profile(ProfileArgs),
    /// Holds instruction counts and sizes against those that are committed
    Baseline(BaselineArgs),
    /// Says what accuracy costs in time: levels, passes and number formats, error against cost
    Tradeoff(TradeoffArgs),
    /// Finds the cheapest setting that meets stated tolerances on a scene
    Advise(AdviseArgs),
    /// Says what each effect costs, in instructions and in bytes
    Effects(EffectsArgs),
    /// Puts flat's cost of a step beside that of other engines
    Peers(PeersArgs),
    /// Lists the serial ports and the boards behind them
    Ports,
    /// Puts the firmware on a board through espflash, or says how
    Flash(FlashArgs),
    /// Shows what a board logs, its faults and restarts, and how late its steps are
    Monitor(MonitorArgs),
    /// Shows what the ESP32-C3's image takes of the chip, and what its code in RAM still wants from flash
    Inspect(InspectArgs),
    /// Disturbs a device's link in every way, and checks that physics doesn't notice
    Stress(StressArgs),
    /// Makes a test build fail in every way it can, and checks what it says
    Faults(FaultsArgs),
    /// Runs the firmware's unit tests on the device: here in QEMU, on a board through probe-rs
    Test(TestArgs),
    /// Builds the firmware for a board and prints the path of the image
    Build {
        /// The board.
        #[arg(value_enum)]
        board: Board,

        /// What for.
        #[command(flatten)]
        kind: Build,
    },
}

/// Arguments of `rig run`.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct RunArgs {
    /// Scenarios to run [default: all]; `--list` names them
    #[arg(value_name = "SCENARIO")]
    pub scenarios: Vec<String>,

    /// Where to run: `mock`, `qemu`, `esp-qemu` (Espressif's), `serial[:PATH[@BAUD]]`, `tcp:HOST:PORT`, `exec:COMMAND`. Several with commas between
    /// them, or by repeating the option. exec: takes the rest of its value, commas and spaces included. Every
    /// target is compared with the mock, step by step.
    #[arg(long = "target", value_name = "TARGET", default_value = "mock")]
    targets: Vec<TargetList>,

    /// Prints the scenarios and what they promise, and runs nothing
    #[arg(long)]
    pub list: bool,

    /// Bodies in the scene [default: the scene's]
    #[arg(long, value_name = "N")]
    pub bodies: Option<u16>,

    /// Seed of the scene's random numbers [default: the scene's]
    #[arg(long, value_name = "S")]
    pub seed: Option<u32>,

    /// Order in which the bodies are inserted
    #[arg(long, value_enum, default_value_t)]
    pub order: OrderArg,

    /// Departures from the scenes as they are written.
    #[command(flatten)]
    pub variant: VariantArgs,

    /// Runs every scenario in all its perturbations: seeds, orders, mirrored, turned, shifted, gravities, mixtures, sizes
    #[arg(long, conflicts_with_all = ["bodies", "seed", "order", "VariantArgs", "flip", "input"])]
    pub perturbed: bool,

    /// Prints the figure of every check beside its bar
    #[arg(long)]
    pub figures: bool,

    /// How to compute.
    #[command(flatten)]
    pub setting: Setting,

    /// Steps to run, 60 a second [default: the scene's]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST_STEPS))]
    pub steps: Option<u32>,

    /// What the player does, in scenarios that have one: buttons and how many steps they are held, one after the other, as in
    /// `right:60 jump+right:20 idle:30`; @FILE reads that from a file [default: the scenario plays by itself]
    #[arg(long, value_name = "INPUTS", value_parser = Inputs::read)]
    pub input: Option<Inputs>,

    /// Writes everything that was found to this file
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,

    /// Longest wait for any sign of progress
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = seconds)]
    timeout: Duration,

    /// QEMU image to run instead of building one; for a board, the image that it runs, to read its logs and faults with
    #[arg(long, value_name = "PATH")]
    pub elf: Option<PathBuf>,

    /// Whether to reset a board.
    #[command(flatten)]
    pub reset: ResetArgs,

    /// Inverts a bit of a body's horizontal velocity on the last target, after a stage (number or name) of a step:
    /// proves that the comparison notices. Rest swallows the last bits, then nothing parts
    #[arg(long, value_name = "STEP:STAGE:BODY:BIT", value_parser = flip)]
    pub flip: Option<Flip>,
}

/// Two days at 60 steps a second; a digest of each is kept.
pub const MOST_STEPS: i64 = 10_000_000;

const EXIT_CODES: &str = "Exit codes: 0 all checks held; 1 a check failed; 2 usage; 3 no target, or a time-out; \
                          4 the target speaks another protocol; 130 interrupted";

impl RunArgs {
    /// All targets in the order given.
    pub fn targets(&self) -> Vec<Target> {
        self.targets.iter().flat_map(|list| list.0.iter().cloned()).collect()
    }

    /// Longest wait for any sign of progress.
    pub fn timeout(&self) -> Duration {
        self.timeout
    }

    /// The command that runs one scenario on one target again, ready for a shell.
    pub fn rerun(&self, job: &Job, target: &Target) -> String {
        let mut words = vec!["cargo".to_owned(), "rig".into(), "run".into(), job.scene.name.into()];
        let mut option = |name: &str, value: Option<String>| {
            words.extend(value.into_iter().flat_map(|value| [format!("--{name}"), value]));
        };
        option("target", Some(target.to_string()));
        option("steps", self.steps.map(|steps| steps.to_string()));
        if matches!(target, Target::Qemu | Target::EspQemu) {
            option("elf", self.elf.as_ref().map(|elf| elf.display().to_string()));
        }
        let last = self.targets.last().and_then(|list| list.0.last());
        if last == Some(target) {
            option(
                "flip",
                self.flip.map(|Flip { point, body, bit }| format!("{}:{}:{body}:{bit}", point.step, point.stage)),
            );
        }
        words.extend(job.options());
        words.extend(self.setting.options());
        words.extend(self.reset.option().map(str::to_owned));
        shell_words::join(words)
    }
}

/// A choice by its name, unless it is the default.
pub fn given<T: ValueEnum + Default + PartialEq>(choice: &T) -> Option<String> {
    (*choice != T::default()).then(|| choice.to_possible_value().map(|value| value.get_name().to_owned())).flatten()
}

/// A duration on the command line.
///
/// # Errors
/// In words.
pub fn seconds(text: &str) -> Result<Duration, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (0.001..=86_400.0).contains(&seconds) => Ok(Duration::from_secs_f64(seconds)),
        _ => Err("must be a number of seconds, 0.001 to 86400".into()),
    }
}

fn flip(text: &str) -> Result<Flip, String> {
    let [step, stage, body, bit] = text.split(':').collect::<Vec<_>>()[..] else {
        return Err("must be STEP:STAGE:BODY:BIT, as in 37:solve_velocity:12:3".into());
    };
    let step = step.parse().ok().filter(|&step| step > 0).ok_or("STEP must be a number from 1")?;
    let stage = match stage.parse() {
        Ok(index) => Stage::ALL.get::<usize>(index).copied(),
        Err(_) => Stage::ALL.into_iter().find(|known| known.to_string() == stage),
    };
    let stage = stage.ok_or_else(|| {
        let names = Stage::ALL.map(|stage| stage.to_string());
        format!("STAGE must be 0 to {} or one of {}", names.len() - 1, names.join(", "))
    })?;
    let body = body.parse().map_err(|_| "BODY must be a slot, 0 to 65535")?;
    let bit = bit.parse().map_err(|_| "BIT must be a number from 0")?;
    Ok(Flip { point: Point { step, stage: stage.index() as u8 }, body, bit })
}

/// `--order`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum OrderArg {
    /// As the scene lists them.
    #[default]
    Forward,
    /// Last first.
    Reverse,
    /// A permutation drawn from the seed.
    Shuffled,
}

impl From<OrderArg> for flat_scenes::Order {
    fn from(order: OrderArg) -> Self {
        match order {
            OrderArg::Forward => Self::Forward,
            OrderArg::Reverse => Self::Reverse,
            OrderArg::Shuffled => Self::Shuffled,
        }
    }
}

impl From<OrderArg> for Order {
    fn from(order: OrderArg) -> Self {
        match order {
            OrderArg::Forward => Self::Forward,
            OrderArg::Reverse => Self::Reverse,
            OrderArg::Shuffled => Self::Shuffled,
        }
    }
}

/// `--level`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LevelArg {
    /// Plain impulses, the cheapest.
    Flat,
    /// Accumulated impulses and a pass from the ground up.
    #[default]
    Grounded,
    /// More passes, and the time of impact for whoever is fast.
    Exact,
}

impl From<LevelArg> for flat_physics::Level {
    fn from(level: LevelArg) -> Self {
        match level {
            LevelArg::Flat => Self::Flat,
            LevelArg::Grounded => Self::Grounded,
            LevelArg::Exact => Self::Exact,
        }
    }
}

impl From<LevelArg> for Level {
    fn from(level: LevelArg) -> Self {
        match level {
            LevelArg::Flat => Self::Flat,
            LevelArg::Grounded => Self::Grounded,
            LevelArg::Exact => Self::Exact,
        }
    }
}

/// `--scalar`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum ScalarArg {
    /// Fixed point.
    #[default]
    Fixed,
    /// IEEE 754 binary32.
    F32,
    /// IEEE 754 binary64.
    F64,
}

impl From<ScalarArg> for ScalarKind {
    fn from(scalar: ScalarArg) -> Self {
        match scalar {
            ScalarArg::Fixed => Self::Fixed,
            ScalarArg::F32 => Self::F32,
            ScalarArg::F64 => Self::F64,
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn every_command_and_option_has_a_name_of_its_own() {
        Cli::command().debug_assert();
    }
}
