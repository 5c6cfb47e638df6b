//! `rig`: runs flat's scenes on the in-process mock, on QEMU and on boards, and checks what must hold.

// A binary has no outside: `pub` means the rest of the program.
#![allow(unreachable_pub)]

mod advise;
mod baseline;
mod bench;
mod cli;
mod client;
mod collect;
mod compare;
mod drive;
mod effects;
mod error;
mod firmware;
mod interpret;
mod interrupt;
mod job;
mod journal;
mod measure;
mod monitor;
mod observe;
mod peers;
mod process_group;
mod profile;
mod report;
mod run;
mod setting;
mod target;
mod trace;
mod tradeoff;
mod trials;
mod verify;

use std::process::ExitCode;

use clap::Parser;
use flat_rig::{check, input, number};

use cli::{Cli, Command};

fn main() -> ExitCode {
    report::reader::may_leave();
    let arguments = Cli::parse();
    let outcome = interrupt::install().and_then(|()| match arguments.command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Profile(arguments) => profile::run(&arguments),
        Command::Baseline(arguments) => baseline::run(&arguments),
        Command::Tradeoff(arguments) => tradeoff::run(&arguments),
        Command::Advise(arguments) => advise::run(&arguments),
        Command::Effects(arguments) => effects::run(&arguments),
        Command::Peers(arguments) => peers::run(&arguments),
        Command::Flash(arguments) => firmware::flash::run(&arguments).map(|()| true),
        Command::Monitor(arguments) => monitor::run(&arguments).map(|()| true),
        Command::Ports => target::ports::print().map(|()| true),
        Command::Inspect(arguments) => firmware::inspect::run(&arguments),
        Command::Stress(arguments) => trials::stress::run(&arguments),
        Command::Faults(arguments) => trials::faults::run(&arguments),
        Command::Test(arguments) => trials::unit_tests::run(&arguments),
        Command::Build { board, kind } => {
            println!("{}", firmware::image::build_as(board, kind)?.display());
            Ok(true)
        }
    });
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(error::CHECK_FAILED),
        Err(error) => {
            eprintln!("{} {error}", console::style("error:").red().bold().for_stderr());
            error.exit_code()
        }
    }
}
