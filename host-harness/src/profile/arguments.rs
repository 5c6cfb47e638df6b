//! What `rig profile` may be asked.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use crate::cli::{MOST_STEPS, OrderArg, seconds};
use crate::setting::Setting;
use crate::target::reset::ResetArgs;
use crate::target::{Target, TargetList};

/// Arguments of `rig profile`.
#[derive(Debug, Args)]
pub struct ProfileArgs {
    /// Scenario to profile; `cargo rig run --list` names them
    #[arg(long, value_name = "SCENARIO", default_value = "ball_pit")]
    pub scene: String,

    /// Bodies, `N` or `A..B`; over a range, also the most that hold 60 steps a second [default: the scene's]
    #[arg(long, value_name = "N|A..B", value_parser = bodies)]
    pub bodies: Option<RangeInclusive<u16>>,

    /// Seed of the scene's random numbers [default: the scene's]
    #[arg(long, value_name = "S")]
    pub seed: Option<u32>,

    /// Order in which the bodies are inserted
    #[arg(long, value_enum, default_value_t)]
    pub order: OrderArg,

    /// How to compute.
    #[command(flatten)]
    pub setting: Setting,

    /// Where to measure: `qemu` counts instructions, `serial[:PATH[@BAUD]]`, `tcp:HOST:PORT` and `exec:COMMAND` whatever the
    /// board there counts
    #[arg(long, value_name = "TARGET", default_value = "qemu", value_parser = one_target)]
    pub target: Target,

    /// Steps to run, 60 a second; means are taken over the second half [default: the scene's]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=MOST_STEPS))]
    pub steps: Option<u32>,

    /// Writes every figure to this file, a line for each stage and body count
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,

    /// Writes everything to this file
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,

    /// Writes tables and plots as one page that needs no other file
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,

    /// Longest wait for any sign of progress
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    pub timeout: Duration,

    /// QEMU image to run instead of building one
    #[arg(long, value_name = "PATH")]
    pub elf: Option<PathBuf>,

    /// Whether to reset a board.
    #[command(flatten)]
    pub reset: ResetArgs,
}

/// `N` or `A..B`, both ends included.
fn bodies(text: &str) -> Result<RangeInclusive<u16>, String> {
    let number = |text: &str| text.trim().parse::<u16>().ok().filter(|&bodies| bodies > 0);
    let range = match text.split_once("..") {
        Some((first, last)) => number(first).zip(number(last.trim_start_matches('='))),
        None => number(text).map(|bodies| (bodies, bodies)),
    };
    match range {
        Some((first, last)) if first <= last => Ok(first..=last),
        _ => Err("must be a count from 1, or a range of two with .. between them, as in 20..400".into()),
    }
}

/// One target.
///
/// # Errors
/// In words, if there is none of that name, or there are several.
pub fn one_target(text: &str) -> Result<Target, String> {
    let TargetList(targets) = text.parse()?;
    match &targets[..] {
        [target] => Ok(target.clone()),
        _ => Err("one target at a time".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_are_a_count_or_a_range() {
        assert_eq!(bodies("100"), Ok(100..=100));
        assert_eq!(bodies("20..400"), Ok(20..=400));
        for text in ["", "0", "5..", "..5", "400..20", "1..70000", "a..b"] {
            assert!(bodies(text).is_err(), "{text}");
        }
    }
}
