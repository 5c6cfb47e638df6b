//! A device that is a program: frames over its standard input and output.

use std::collections::VecDeque;
use std::io::{BufRead, BufReader, ErrorKind};
use std::process::{Child, ChildStderr, Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::link::{Link, Peer};
use crate::error::Error;
use crate::process_group;

/// Lines of the program's standard error that are kept for its obituary.
const LAST_WORDS: usize = 8;
/// How long a program may take from closing its output to its exit code and its last words.
const GRACE: Duration = Duration::from_millis(300);

/// Starts a program and opens a link to it.
///
/// # Errors
/// If it cannot be started; `install` then says how to get it.
pub fn spawn(command: &mut Command, install: &str) -> Result<Link, Error> {
    let program = command.get_program().to_string_lossy().into_owned();
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    process_group::lead(command);
    let mut child = command.spawn().map_err(|error| {
        let next = if error.kind() == ErrorKind::NotFound { install } else { "" };
        Error::target(format!("cannot start `{program}`: {error}"), next)
    })?;
    let (input, output, complaints) = (child.stdin.take(), child.stdout.take(), child.stderr.take());
    let last_words = complaints.map(LastWords::listen);
    let peer = Box::new(Running { program, child, last_words });
    match (output, input) {
        (Some(output), Some(input)) => Ok(Link::over_streams(output, input, peer)),
        _ => Err(Error::target(format!("`{}` has no standard input or output", peer.program), "")),
    }
}

/// The running program; dropping it kills and reaps it together with what it started.
struct Running {
    program: String,
    child: Child,
    last_words: Option<LastWords>,
}

impl Peer for Running {
    fn obituary(&mut self) -> String {
        // The output ends first; exit code and last words follow soon, unless something that it started lives on.
        let until = Instant::now() + GRACE;
        let mut status = None;
        while Instant::now() < until
            && !(status.is_some() && self.last_words.as_ref().is_none_or(LastWords::is_complete))
        {
            thread::sleep(Duration::from_millis(5));
            status = self.child.try_wait().ok().flatten();
        }
        let mut text = match status {
            Some(status) => format!("`{}` ended ({status})", self.program),
            None => format!("`{}` closed its output", self.program),
        };
        for line in self.last_words.iter().flat_map(LastWords::lines) {
            text.push_str("\n  | ");
            text.push_str(&line);
        }
        text
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        process_group::end(&mut self.child, None);
    }
}

/// The end of a program's standard error.
struct LastWords {
    lines: Arc<Mutex<VecDeque<String>>>,
    listener: JoinHandle<()>,
}

impl LastWords {
    fn listen(complaints: ChildStderr) -> Self {
        let lines = Arc::new(Mutex::new(VecDeque::new()));
        let kept = Arc::clone(&lines);
        let listener = thread::spawn(move || {
            for line in BufReader::new(complaints).lines().map_while(Result::ok) {
                let mut lines = kept.lock().unwrap_or_else(PoisonError::into_inner);
                if lines.len() == LAST_WORDS {
                    lines.pop_front();
                }
                lines.push_back(line);
            }
        });
        Self { lines, listener }
    }

    /// Whether there are no more to come.
    fn is_complete(&self) -> bool {
        self.listener.is_finished()
    }

    fn lines(&self) -> Vec<String> {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).iter().cloned().collect()
    }
}
