//! Any emulator or bridge that speaks over its standard input and output.

use std::process::Command;

use super::child;
use super::link::Link;
use crate::error::Error;

/// Starts the command, split into words as a POSIX shell would, without a shell.
///
/// # Errors
/// If it is empty, has an open quote, or cannot be started.
pub fn open(command: &str) -> Result<Link, Error> {
    let words = shell_words::split(command)
        .map_err(|error| Error::usage(format!("exec:{command}: {error}"), "close the quote"))?;
    let Some((program, arguments)) = words.split_first() else {
        return Err(Error::usage("exec: needs a command", "--target 'exec:COMMAND ARGUMENTS'"));
    };
    child::spawn(Command::new(program).args(arguments), "give the program's full path, as in exec:/path/to/emulator")
}
