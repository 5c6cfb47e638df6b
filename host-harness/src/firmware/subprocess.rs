//! Programs that take a while: a sign of life while they run, their output if they fail, no survivors on Ctrl-C.

use std::io::{BufRead, BufReader, ErrorKind, PipeReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::error::Error;
use crate::interrupt;
use crate::process_group;
use crate::report::progress;

/// How long an interrupted program may take to clean up before it is killed.
const GRACE: Duration = Duration::from_secs(5);

/// How a program ended.
#[derive(Clone, Debug)]
pub struct Ended {
    /// Whether it reported success.
    pub success: bool,
    /// Its exit code; none if a signal ended it.
    pub code: Option<i32>,
    /// Standard output and standard error as they came.
    pub output: String,
}

/// Runs a program to its end and wants success.
///
/// # Errors
/// If it cannot be started or fails; the error carries its output. [`crate::error::Kind::Interrupted`] on Ctrl-C.
pub fn run(title: &str, command: &mut Command) -> Result<String, Error> {
    let ended = watch(title, command)?;
    if ended.success {
        return Ok(ended.output);
    }
    let code = ended.code.map_or("killed by a signal".into(), |code| format!("exit code {code}"));
    let words: String = ended.output.split_inclusive('\n').filter(|line| !is_cargo_status(line)).collect();
    Err(Error::target(format!("{title} failed ({code}):\n{}", words.trim_end()), ""))
}

/// Whether a line only says what cargo is busy with: a verb that ends in column 12, as in `   Compiling core v0.0.0`.
fn is_cargo_status(line: &str) -> bool {
    line.split_at_checked(12).is_some_and(|(verb, object)| {
        let verb = verb.trim_start();
        verb.starts_with(|first: char| first.is_ascii_uppercase())
            && verb.chars().all(|letter| letter.is_ascii_alphabetic())
            && object.starts_with(' ')
    })
}

/// Runs a program to its end, with its last line of output beside a spinner.
///
/// # Errors
/// If it cannot be started. [`crate::error::Kind::Interrupted`] on Ctrl-C.
pub fn watch(title: &str, command: &mut Command) -> Result<Ended, Error> {
    watch_for(title, command, Duration::MAX)
}

/// As [`watch`], but ends the program after `limit`, and says so in its output.
///
/// # Errors
/// As [`watch`].
pub fn watch_for(title: &str, command: &mut Command, limit: Duration) -> Result<Ended, Error> {
    let started = Instant::now();
    let program = command.get_program().to_string_lossy().into_owned();
    let broken = |error: std::io::Error| {
        let next = if error.kind() == ErrorKind::NotFound { format!("install {program}") } else { String::new() };
        Error::target(format!("{title}: cannot run `{program}`: {error}"), next)
    };
    // One pipe for both streams keeps their lines in order.
    let (output, input) = std::io::pipe().map_err(broken)?;
    command.stdin(Stdio::null()).stdout(input.try_clone().map_err(broken)?).stderr(input);
    process_group::lead(command);
    let mut running = Running(command.spawn().map_err(broken)?);
    // The command still holds the pipe's writing ends, without which the reader would never see the end.
    command.stdout(Stdio::null()).stderr(Stdio::null());

    let spinner = spinner(title);
    let lines = lines_of(output);
    let mut output = String::new();
    loop {
        match lines.recv_timeout(interrupt::POLL) {
            Ok(line) => {
                spinner.set_message(line.trim().to_owned());
                output.push_str(&line);
            }
            Err(RecvTimeoutError::Timeout) => interrupt::check()?,
            Err(RecvTimeoutError::Disconnected) => break,
        }
        if started.elapsed() > limit {
            spinner.finish_and_clear();
            let output = format!("{output}{title} takes longer than {} s\n", limit.as_secs_f32());
            return Ok(Ended { success: false, code: None, output });
        }
    }
    let status = running.0.wait().map_err(broken)?;
    spinner.finish_and_clear();
    interrupt::check()?;
    Ok(Ended { success: status.success(), code: status.code(), output })
}

fn spinner(title: &str) -> ProgressBar {
    let spinner = progress::show(ProgressBar::new_spinner().with_prefix(title.to_owned()));
    if let Ok(style) = ProgressStyle::with_template("{spinner} {prefix} {elapsed:.dim} {wide_msg:.dim}") {
        spinner.set_style(style);
    }
    spinner.enable_steady_tick(Duration::from_millis(120));
    spinner
}

/// Lines, each with its end, from a thread of their own; the channel closes when the last writer does.
fn lines_of(pipe: PipeReader) -> Receiver<String> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let mut reader = BufReader::new(pipe);
        let mut line = Vec::new();
        while reader.read_until(b'\n', &mut line).is_ok_and(|length| length > 0) {
            if sender.send(String::from_utf8_lossy(&line).into_owned()).is_err() {
                return;
            }
            line.clear();
        }
    });
    receiver
}

/// A running program; dropping it asks it and what it started to end, and then sees to it.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        if matches!(self.0.try_wait(), Ok(Some(_))) {
            return;
        }
        process_group::end(&mut self.0, Some(GRACE));
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(script: &str) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        command
    }

    #[test]
    fn both_streams_are_kept_in_order() {
        let output = run("echo", &mut shell("echo one; echo two >&2; printf three")).unwrap();
        assert_eq!(output, "one\ntwo\nthree");
    }

    #[test]
    fn a_failure_carries_code_and_output() {
        let error = run("failing", &mut shell("echo why >&2; exit 7")).unwrap_err();
        assert_eq!(error.what(), "failing failed (exit code 7):\nwhy");
    }

    #[test]
    fn cargo_progress_is_no_part_of_a_failure() {
        for line in ["   Compiling core v0.0.0 (/src)", "    Blocking waiting for file lock", " Downloading crates ..."]
        {
            assert!(is_cargo_status(line), "{line}");
        }
        for line in [
            "error[E0433]: no such thing",
            "   |     ^^^^^ here",
            "   --> src/main.rs:3:5",
            "",
            "    Some words of advice",
        ] {
            assert!(!is_cargo_status(line), "{line}");
        }
    }

    #[test]
    fn a_program_that_goes_on_is_ended() {
        let started = Instant::now();
        let ended = watch_for("sleeping", &mut shell("sleep 60"), Duration::from_millis(50)).unwrap();
        assert!(!ended.success && started.elapsed() < GRACE, "{ended:?}");
        assert_eq!(ended.output, "sleeping takes longer than 0.05 s\n");
    }

    #[test]
    fn a_missing_program_is_named() {
        let error = run("looking", &mut Command::new("no-such-program-here")).unwrap_err();
        assert!(error.what().contains("no-such-program-here"), "{error}");
    }
}
