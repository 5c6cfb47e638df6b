//! `rig flash`: puts the firmware on a board, or into a file as its flash would hold it. espflash does the work.

use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;

use super::elf::Image;
use super::image::{self, Board, Build};
use super::references::FLASH_CODE;
use super::{subprocess, toolchain};
use crate::error::Error;
use crate::monitor;
use crate::target::{Target, ports};

/// The tool.
const ESPFLASH: &str = "espflash";

/// Arguments of `rig flash`.
#[derive(Debug, Args)]
pub struct FlashArgs {
    /// The board.
    #[arg(value_enum)]
    board: Board,

    /// The board's serial port [default: that of the one board there is]
    #[arg(long, value_name = "PATH")]
    port: Option<String>,

    /// What the image is built for.
    #[command(flatten)]
    kind: Build,

    /// Image to flash instead of building one
    #[arg(long, value_name = "PATH")]
    elf: Option<PathBuf>,

    /// Then shows what the board logs and how it does, until Ctrl-C
    #[arg(long)]
    monitor: bool,

    /// Writes what the whole flash would hold to this file, for Espressif's QEMU, and flashes nothing
    #[arg(long, value_name = "FILE", conflicts_with_all = ["port", "monitor"])]
    save: Option<PathBuf>,

    /// Prints the command and runs nothing
    #[arg(long, conflicts_with = "monitor")]
    print: bool,
}

/// Flashes a board, or says how.
///
/// # Errors
/// If there is no image, no board or no espflash, or if that fails.
pub fn run(arguments: &FlashArgs) -> Result<(), Error> {
    let board = arguments.board;
    if board == Board::QemuVirt {
        return Err(Error::usage(format!("{board} has no flash"), "`cargo rig run --target qemu` runs it"));
    }
    let elf = arguments.elf.clone().map_or_else(|| image::build_as(board, arguments.kind), Ok)?;
    check(board, &elf)?;
    if let Some(file) = &arguments.save {
        if arguments.print {
            print(&save_image(board, &elf, file));
            return Ok(());
        }
        return save(board, &elf, file);
    }
    let port = match &arguments.port {
        Some(port) => Some(port.clone()),
        // espflash says for itself where the board might be.
        None if arguments.print => None,
        None => Some(ports::find()?.0),
    };
    let mut command = flash(board, &elf, port.as_deref());
    if arguments.print {
        print(&command);
        return Ok(());
    }
    if toolchain::installed(ESPFLASH).is_none() {
        return Err(missing(&command));
    }
    let status = command.status().map_err(|error| Error::target(format!("cannot run {ESPFLASH}: {error}"), INSTALL))?;
    if !status.success() {
        return Err(Error::target(
            format!("{ESPFLASH} ended with {status}"),
            "hold the board's BOOT button while it connects; and end whatever else has the port open",
        ));
    }
    if arguments.monitor {
        let target = Target::Serial { path: port, baud: image::baud()? };
        return monitor::watch(&target, Some(elf));
    }
    Ok(())
}

/// Writes what the whole flash would hold, boot loader and partition table included, to a file.
///
/// # Errors
/// If espflash isn't there or fails.
pub fn save(board: Board, elf: &Path, file: &Path) -> Result<(), Error> {
    let mut command = save_image(board, elf, file);
    if toolchain::installed(ESPFLASH).is_none() {
        return Err(missing(&command));
    }
    subprocess::run("espflash save-image", &mut command).map(drop)
}

/// How to get espflash.
pub const INSTALL: &str = "cargo install espflash --locked";

fn missing(command: &Command) -> Error {
    Error::target(format!("{ESPFLASH} isn't installed"), format!("`{INSTALL}`, then:\n  {}", words(command)))
}

fn flash(board: Board, elf: &Path, port: Option<&str>) -> Command {
    let mut command = Command::new(ESPFLASH);
    command.args(["flash", "--chip", board.feature()]);
    if let Some(port) = port {
        command.args(["--port", port]);
    }
    command.arg(elf);
    command
}

fn save_image(board: Board, elf: &Path, file: &Path) -> Command {
    let mut command = Command::new(ESPFLASH);
    // QEMU's flash has one of the sizes that flash chips have: 4 MB is that of most modules.
    command.args(["save-image", "--chip", board.feature(), "--merge", "--flash-size", "4mb"]).arg(elf).arg(file);
    command
}

/// The chips share a target with QEMU's board, and so `cargo run` brings any image here.
fn check(board: Board, elf: &Path) -> Result<(), Error> {
    if board == Board::Esp32c3 && !Image::read(elf)?.sections.iter().any(|found| FLASH_CODE.contains(&found.address)) {
        return Err(Error::usage(
            format!("{} has no code in an ESP32-C3's flash", elf.display()),
            format!("an image for QEMU runs with `cargo rig run --target qemu --elf {}`", elf.display()),
        ));
    }
    Ok(())
}

fn print(command: &Command) {
    println!("{}", words(command));
}

/// A command as a shell takes it.
fn words(command: &Command) -> String {
    let program = command.get_program().to_string_lossy();
    shell_words::join(std::iter::once(program).chain(command.get_args().map(|word| word.to_string_lossy())))
}
