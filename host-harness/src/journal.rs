//! What a device says of itself beside its stream: logs, faults, restarts. Told on standard error as it comes.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use console::{Term, style};
use flat_wire::message::{Cause, Fault, FaultKind, Hello};

use crate::error::Error;
use crate::firmware::image;
use crate::firmware::logs::{Logs, Message};
use crate::firmware::symbols;

/// One device's.
pub struct Journal {
    target: String,
    /// The image that somebody says it runs.
    image: Option<PathBuf>,
    identity: Option<Identity>,
    key: Key,
    /// Log bytes from before it said who it is.
    early: Vec<u8>,
    /// Messages that the device itself lost, as it last said.
    lost: u32,
    unreadable: u32,
    messages: u32,
    is_hushed: bool,
}

struct Identity {
    board: String,
    build: String,
}

/// What reads the logs.
enum Key {
    /// Nothing was logged yet.
    Unopened,
    Open(Box<Logs>),
    /// There is none; that was said.
    Missing,
}

impl Journal {
    /// Of a device of which nothing is known but what reports call it, and perhaps its image.
    pub fn new(target: String, image: Option<PathBuf>) -> Self {
        Self {
            target,
            image,
            identity: None,
            key: Key::Unopened,
            early: Vec::new(),
            lost: 0,
            unreadable: 0,
            messages: 0,
            is_hushed: false,
        }
    }

    /// Counts log messages from now on instead of telling them.
    pub fn hush(&mut self) {
        self.is_hushed = true;
    }

    /// Messages so far that could be read.
    pub fn messages(&self) -> u32 {
        self.messages
    }

    /// The device has said who it is.
    pub fn introduce(&mut self, hello: &Hello) {
        self.identity = Some(Identity { board: hello.board.to_string(), build: hello.build.to_string() });
        let early = std::mem::take(&mut self.early);
        self.read(&early);
    }

    /// Whether the device has said who it is.
    pub fn is_introduced(&self) -> bool {
        self.identity.is_some()
    }

    /// Tells what the device logs.
    pub fn log(&mut self, lost: u32, bytes: &[u8]) {
        if self.is_introduced() {
            self.read(bytes);
        } else {
            self.early.extend_from_slice(bytes);
        }
        if lost > self.lost && !self.is_hushed {
            say(&format!("{} {} log messages were lost on the device", style("log").dim(), lost - self.lost));
        }
        self.lost = lost;
    }

    /// Tells that the device has started while somebody was about to talk to it; what it logs begins afresh.
    pub fn started(&mut self, cause: Cause) {
        if let Key::Open(logs) = &mut self.key {
            logs.skip();
        }
        self.early.clear();
        self.lost = 0;
        if !matches!(cause, Cause::PowerOn | Cause::Host) {
            say(&format!("{} {} has restarted {}", style("note:").yellow().bold(), self.target, because(cause)));
        }
    }

    /// Tells of a fault that nobody asked about.
    pub fn tell(&self, fault: &Fault) {
        say(&format!("{} {}", style("note:").yellow().bold(), self.describe(fault)));
    }

    /// A run that a fault has ended.
    pub fn failed(&self, fault: &Fault) -> Error {
        Error::target(self.describe(fault), "it restarts by itself: run this again to see whether it fails again")
    }

    /// A run that a restart has ended.
    pub fn restarted(&self, cause: Cause) -> Error {
        Error::target(
            format!("{} has restarted {}; what it was doing is lost", self.target, because(cause)),
            "run this again; if it restarts again, look at its supply and its cable",
        )
    }

    /// What happened, where, and by which calls.
    pub fn describe(&self, fault: &Fault) -> String {
        let seconds = fault.uptime_us as f64 / 1e6;
        let mut text = format!("{} failed {seconds:.6} s after its start: {}", self.target, kind(fault.kind));
        if let Some(place) = &fault.place {
            let _ = write!(text, " at {}:{}", symbols::shortened(&place.file), place.line);
        }
        for line in fault.message.lines() {
            let _ = write!(text, "\n  {line}");
        }
        if fault.backtrace.is_empty() {
            return text;
        }
        text.push_str("\n  backtrace, innermost first:");
        match self.image().and_then(|elf| symbols::name(&elf, &fault.backtrace)) {
            Ok(calls) => {
                for call in calls {
                    let _ = write!(text, "\n  {}", call.to_string().replace('\n', "\n  "));
                }
            }
            Err(why) => {
                for address in &fault.backtrace {
                    let _ = write!(text, "\n  {address:#010x}");
                }
                let _ = write!(text, "\n  without names: {why}");
            }
        }
        text
    }

    fn read(&mut self, bytes: &[u8]) {
        if bytes.is_empty() {
            return;
        }
        if matches!(self.key, Key::Unopened) {
            self.key = match self.image().and_then(|elf| Logs::new(&elf)) {
                Ok(logs) => Key::Open(Box::new(logs)),
                Err(why) => {
                    say(&format!(
                        "{} {} logs, but its logs cannot be read: {why}",
                        style("note:").yellow().bold(),
                        self.target
                    ));
                    Key::Missing
                }
            };
        }
        let Key::Open(logs) = &mut self.key else { return };
        let read = logs.read(bytes);
        self.messages += read.messages.len() as u32;
        self.unreadable += read.unreadable;
        if self.is_hushed {
            return;
        }
        for message in read.messages {
            say(&line(&message));
        }
        if read.unreadable > 0 {
            say(&format!("{} a message was damaged on its way ({} so far)", style("log").dim(), self.unreadable));
        }
    }

    /// The image that the device runs: the one that was named, or the one that rig built for such a board.
    fn image(&self) -> Result<Vec<u8>, String> {
        let Some(Identity { board, build }) = &self.identity else {
            return Err("the device hasn't said which image it runs".into());
        };
        let path = match &self.image {
            Some(path) => path.clone(),
            None => image::of(board, build).map_err(|error| error.what().to_owned())?,
        };
        let elf = fs::read(&path).map_err(|error| format!("{}: {error}; name its image with --elf", path.display()))?;
        if elf.windows(build.len()).any(|window| window == build.as_bytes()) {
            return Ok(elf);
        }
        Err(format!("{} is not the image of build {build} that it runs; name that with --elf", path.display()))
    }
}

/// A line on standard error, over whatever progress is shown there.
fn say(text: &str) {
    let terminal = Term::stderr();
    // A terminal that is gone has nobody to tell.
    let _ = if terminal.is_term() { terminal.clear_line() } else { Ok(()) };
    let _ = terminal.write_line(text);
}

fn line(message: &Message) -> String {
    let Message { time, level, text, place } = message;
    let level = match *level {
        "ERROR" => style(*level).red().bold(),
        "WARN" => style(*level).yellow(),
        other => style(other).dim(),
    };
    let place = place.as_ref().map(|place| format!("  {}", style(place).dim())).unwrap_or_default();
    format!("{} {time:>12} {level:<5} {text}{place}", style("log").dim())
}

fn kind(kind: FaultKind) -> &'static str {
    match kind {
        FaultKind::Panic => "panic",
        FaultKind::Exception => "exception",
        FaultKind::StackOverflow => "stack overflow",
        FaultKind::Watchdog => "watchdog",
    }
}

fn because(cause: Cause) -> &'static str {
    match cause {
        Cause::PowerOn => "because power came on or somebody reset it",
        Cause::Fault => "after a fault",
        Cause::Watchdog => "because a hardware watchdog had waited too long: even interrupts didn't run any more",
        Cause::Brownout => "because its supply voltage had dropped",
        Cause::Host => "because the host reset it",
    }
}
