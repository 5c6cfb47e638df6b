//! What `rig tradeoff` may be asked.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use crate::cli::{LevelArg, MOST_STEPS, ScalarArg, seconds};
use crate::profile::one_target;
use crate::target::Target;
use crate::target::reset::ResetArgs;

/// Arguments of `rig tradeoff`.
#[derive(Debug, Args)]
pub struct TradeoffArgs {
    /// Scenarios [default: some with a known answer and some hard ones]
    #[arg(value_name = "SCENARIO")]
    pub scenarios: Vec<String>,

    /// Bodies in each scene [default: the scene's]
    #[arg(long, value_name = "N")]
    pub bodies: Option<u16>,

    /// Accuracy levels, with commas between them
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = [LevelArg::Flat, LevelArg::Grounded, LevelArg::Exact])]
    pub levels: Vec<LevelArg>,

    /// Passes of the solver, with commas between them
    #[arg(long, value_delimiter = ',', value_name = "N", default_values_t = [1, 2, 4],
          value_parser = clap::value_parser!(u8).range(1..=16))]
    pub iterations: Vec<u8>,

    /// Number formats, with commas between them
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = [ScalarArg::Fixed, ScalarArg::F32, ScalarArg::F64])]
    pub scalars: Vec<ScalarArg>,

    /// Steps to run [default: the scene's]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=MOST_STEPS))]
    pub steps: Option<u32>,

    /// Where cost is measured: `qemu` counts instructions, a board cycles. Errors are measured on the mock, which must end
    /// with the same bits
    #[arg(long, value_name = "TARGET", default_value = "qemu", value_parser = one_target)]
    pub target: Target,

    /// Writes every figure to this file, a line for each setting
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,

    /// Writes tables and plots as one page that needs no other file
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,

    /// Also writes docs/tradeoff.svg and the table between the README's tradeoff marks
    #[arg(long)]
    pub publish: bool,

    /// Longest wait for any sign of progress
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    pub timeout: Duration,

    /// Whether to reset a board.
    #[command(flatten)]
    pub reset: ResetArgs,

    /// QEMU image to run instead of building one
    #[arg(long, value_name = "PATH")]
    pub elf: Option<PathBuf>,
}
