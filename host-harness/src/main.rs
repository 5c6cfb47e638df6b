//! `rig`: runs flat's scenes on the in-process mock, on QEMU and on boards, and checks what must hold.

// A binary has no outside: `pub` means the rest of the program.
#![allow(unreachable_pub)]

mod bench;
mod check;
mod cli;
mod client;
mod collect;
mod compare;
mod drive;
mod error;
mod firmware;
mod interrupt;
mod job;
mod number;
mod process_group;
mod report;
mod run;
mod target;
mod trace;
mod verify;

use std::process::ExitCode;

use clap::Parser;

use cli::{Cli, Command};

fn main() -> ExitCode {
    let arguments = Cli::parse();
    let outcome = interrupt::install().and_then(|()| match arguments.command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Build { board } => {
            println!("{}", firmware::image::build(board.into())?.display());
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
