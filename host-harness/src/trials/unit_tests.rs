//! `rig test`: the firmware's unit tests, each in a device that has just started. QEMU runs them here; a board takes probe-rs.

use std::path::Path;
use std::process::Command;

use clap::Args;
use console::style;

use crate::error::Error;
use crate::firmware::image::{self, Board, Build};
use crate::firmware::suite::{self, UnitTest};
use crate::firmware::{subprocess, toolchain};
use crate::target::qemu;

/// The tool that runs tests on a board.
const PROBE_RS: &str = "probe-rs";

/// Arguments of `rig test`.
#[derive(Debug, Args)]
pub struct TestArgs {
    /// Where to run them.
    #[arg(value_enum, default_value_t = Board::QemuVirt)]
    board: Board,

    /// Builds and lists them, and runs none
    #[arg(long)]
    list: bool,
}

/// Runs the tests; true if none failed.
///
/// # Errors
/// If they don't compile, or nothing here can run them.
pub fn run(arguments: &TestArgs) -> Result<bool, Error> {
    let board = arguments.board;
    let elf = image::build_as(board, Build::TESTS)?;
    let tests = suite::list(&elf)?;
    if arguments.list {
        for test in &tests {
            println!("{}", test.name);
        }
        return Ok(true);
    }
    if board == Board::QemuVirt {
        let mut passed = true;
        for test in &tests {
            passed &= tell(test, &in_qemu(&elf, test)?);
        }
        return Ok(passed);
    }
    let mut command = Command::new(PROBE_RS);
    command.args(["run", "--chip", board.feature()]).arg(&elf);
    if toolchain::installed(PROBE_RS).is_none() {
        return Err(Error::target(
            format!("{PROBE_RS} isn't installed, which runs tests on a board"),
            format!(
                "`cargo install probe-rs-tools --locked`, then:\n  {PROBE_RS} run --chip {board} {}",
                elf.display()
            ),
        ));
    }
    let status = command.status().map_err(|error| Error::target(format!("cannot run {PROBE_RS}: {error}"), ""))?;
    Ok(status.success())
}

/// What came of a test.
enum Outcome {
    Passed,
    Ignored,
    /// What it said.
    Failed(String),
}

/// Runs a test in QEMU.
fn in_qemu(elf: &Path, test: &UnitTest) -> Result<Outcome, Error> {
    if test.ignored {
        return Ok(Outcome::Ignored);
    }
    let mut command = qemu::with_arguments(elf, &["run_addr", &test.entry.to_string()]);
    let ended = subprocess::watch_for(&test.name, &mut command, test.limit)?;
    // Without a code, it didn't end by itself.
    let passed = ended.code.is_some() && ended.success != test.should_panic;
    Ok(if passed { Outcome::Passed } else { Outcome::Failed(ended.output) })
}

/// Prints what came of a test; true if it didn't fail.
fn tell(test: &UnitTest, outcome: &Outcome) -> bool {
    let (verdict, words) = match outcome {
        Outcome::Passed => (style("ok     ").green(), ""),
        Outcome::Ignored => (style("ignored").yellow(), ""),
        Outcome::Failed(words) => (style("FAIL   ").red().bold(), words.trim_end()),
    };
    println!("{verdict} {}", test.name);
    for line in words.lines() {
        println!("        {line}");
    }
    !matches!(outcome, Outcome::Failed(_))
}
