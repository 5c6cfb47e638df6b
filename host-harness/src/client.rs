//! The host's side of the protocol: requests with deadlines and retries, and the stream in between.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use flat_wire::message::{Cause, Command, Event, Fault, Frame, Hello, Mishap, Reply};
use flat_wire::{Counters, Decoder, FrameError, MAX_FRAME, PROTOCOL_VERSION};

use crate::error::{Error, Kind};
use crate::interrupt;
use crate::journal::Journal;
use crate::report::wait::Wait;
use crate::target::link::{Link, Reading};

/// How long an idempotent request waits before it is sent again.
const RETRY: Duration = Duration::from_millis(300);
/// How long a board may stay silent before it is reset, where rig may do that: longer than any boot loader takes.
const BEFORE_RESET: Duration = Duration::from_secs(3);
/// Bytes that are kept of what a device says before it speaks frames.
const PRELUDE: usize = 4096;

/// A device that has said hello.
pub struct Client {
    link: Link,
    name: String,
    patience: Duration,
    decoder: Decoder,
    sequence: u16,
    undecoded: VecDeque<u8>,
    undecodable: u32,
    journal: Journal,
    /// The end of what it said before it said hello.
    prelude: VecDeque<u8>,
}

impl Client {
    /// Says hello until the device answers: bytes sent before it listens are lost. A board that stays silent is reset once,
    /// where the link can do that.
    ///
    /// # Errors
    /// [`Kind::Protocol`] if it speaks another version; [`Kind::Target`] if it stays silent.
    pub fn connect(link: Link, name: String, patience: Duration) -> Result<(Self, Hello), Error> {
        let mut client = Self {
            journal: Journal::new(name.clone(), link.image().map(ToOwned::to_owned)),
            link,
            name,
            patience,
            decoder: Decoder::new(),
            sequence: 0,
            undecoded: VecDeque::new(),
            undecodable: 0,
            prelude: VecDeque::new(),
        };
        let hello = client.hello();
        match hello {
            Ok(hello) if hello.protocol == PROTOCOL_VERSION => {
                client.journal.introduce(&hello);
                client.prelude = VecDeque::new();
                Ok((client, hello))
            }
            Ok(hello) => Err(client.other_version(&hello)),
            // Intact frames that make no sense are the other way for a version to show.
            Err(error) if error.kind() == Kind::Target && client.undecodable > 0 => Err(Error::new(
                Kind::Protocol,
                format!(
                    "{} speaks another protocol: its frames arrive intact but mean nothing here; this rig speaks version \
                     {PROTOCOL_VERSION}",
                    client.name
                ),
                REBUILD,
            )),
            Err(error) => Err(error),
        }
    }

    fn hello(&mut self) -> Result<Hello, Error> {
        // Ends whatever half frame the line's noise or an earlier host left in the device's decoder.
        self.link.send(&[0])?;
        let (started, wait) = (Instant::now(), Wait::for_hello(&self.name));
        let answer = self.ask(&Command::Hello { protocol: PROTOCOL_VERSION }, |client| {
            wait.show(client.counters(), client.prelude.len());
            if started.elapsed() > BEFORE_RESET && client.link.reset() {
                eprintln!("{} doesn't answer: it was reset", client.name);
            }
        })?;
        match answer {
            Reply::Hello(hello) => Ok(hello),
            other => Err(self.unexpected("hello", &other)),
        }
    }

    /// What reports call the target.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Longest wait for any sign of progress.
    pub fn patience(&self) -> Duration {
        self.patience
    }

    /// Frames received, damaged and missing so far.
    pub fn counters(&self) -> Counters {
        self.decoder.counters()
    }

    /// Sends a request and waits for its reply; frames that come before it belong to an earlier run and are discarded.
    ///
    /// # Errors
    /// [`Kind::Target`] if none comes in time, [`Kind::Refused`] if the device refuses.
    pub fn request(&mut self, command: &Command) -> Result<Reply, Error> {
        self.ask(command, |_| {})
    }

    /// Does so, and calls `again` whenever it sends the request once more.
    fn ask(&mut self, command: &Command, mut again: impl FnMut(&mut Self)) -> Result<Reply, Error> {
        let started = Instant::now();
        let deadline = started + self.patience;
        let mut asked = vec![self.send(command)?];
        let mut retry = started + RETRY;
        while Instant::now() < deadline {
            let wake = if idempotent(command) { deadline.min(retry) } else { deadline };
            match self.event(wake)? {
                Some(Event::Reply { to, reply }) if asked.contains(&to) => {
                    return match reply {
                        Reply::Refused(reason) => Err(Error::new(
                            Kind::Refused,
                            format!("{} refuses `{}`: {reason}", self.name, title(command)),
                            "",
                        )),
                        reply => Ok(reply),
                    };
                }
                None if idempotent(command) => {
                    again(self);
                    asked.push(self.send(command)?);
                    retry = Instant::now() + RETRY;
                }
                Some(_) | None => {}
            }
        }
        Err(self.silent(&format!("the answer to `{}`", title(command)), started))
    }

    /// Whether the other end is still there.
    pub fn is_open(&self) -> bool {
        self.link.is_open()
    }

    /// Sends a request and doesn't wait for its reply.
    ///
    /// # Errors
    /// If the other end has gone.
    pub fn post(&mut self, command: &Command) -> Result<(), Error> {
        self.send(command).map(drop)
    }

    /// Sends bytes that are no frame.
    ///
    /// # Errors
    /// If the other end has gone.
    pub fn disturb(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.link.send(bytes)
    }

    /// Says how the link's bytes are read from now on.
    pub fn set_reading(&mut self, reading: Reading) {
        self.link.set_reading(reading);
    }

    /// Counts the device's logs from now on instead of showing them.
    pub fn hush(&mut self) {
        self.journal.hush();
    }

    /// Log messages so far that could be read.
    pub fn log_count(&self) -> u32 {
        self.journal.messages()
    }

    /// Waits until the device says that it has started; none if it doesn't.
    ///
    /// # Errors
    /// If the other end has gone.
    pub fn started(&mut self, deadline: Instant) -> Result<Option<Cause>, Error> {
        while Instant::now() < deadline {
            if let Some(Event::Frame(Frame::Started(cause))) = self.intact(deadline)? {
                return Ok(Some(cause));
            }
        }
        Ok(None)
    }

    /// Makes the device fail and waits for its last words.
    ///
    /// # Errors
    /// [`Kind::Refused`] if it is no test build, [`Kind::Target`] if it says nothing.
    pub fn provoke(&mut self, mishap: Mishap) -> Result<Fault, Error> {
        let command = Command::Provoke(mishap);
        let started = Instant::now();
        let sent = self.send(&command)?;
        while started.elapsed() < self.patience {
            match self.intact(started + self.patience)? {
                Some(Event::Frame(Frame::Fault(fault))) => return Ok(fault),
                Some(Event::Reply { to, reply: Reply::Refused(reason) }) if to == sent => {
                    return Err(Error::new(Kind::Refused, format!("{} refuses `provoke`: {reason}", self.name), ""));
                }
                Some(_) | None => {}
            }
        }
        Err(self.silent("the fault that was provoked", started))
    }

    /// What happened, where, and by which calls, in words.
    pub fn describe(&self, fault: &Fault) -> String {
        self.journal.describe(fault)
    }

    /// Sends a request that is answered by nothing but [`Reply::Done`].
    ///
    /// # Errors
    /// As [`Self::request`], and if the answer is another one.
    pub fn order(&mut self, command: &Command) -> Result<(), Error> {
        match self.request(command)? {
            Reply::Done => Ok(()),
            other => Err(self.unexpected(title(command), &other)),
        }
    }

    /// The stream's next frame, or none if none came by the deadline.
    ///
    /// # Errors
    /// If the other end has gone, or on Ctrl-C.
    pub fn frame(&mut self, deadline: Instant) -> Result<Option<Frame>, Error> {
        loop {
            match self.event(deadline)? {
                Some(Event::Frame(frame)) => return Ok(Some(frame)),
                Some(Event::Reply { .. }) => {}
                None => return Ok(None),
            }
        }
    }

    /// A time-out: what was awaited, for how long, and what to try.
    pub fn silent(&self, awaited: &str, since: Instant) -> Error {
        let counters = self.counters();
        let (bytes, text) = (self.prelude.len(), said(&self.prelude));
        let (heard, next) = match counters.received {
            0 if !text.is_empty() => (
                format!("; {bytes} bytes and no frame among them arrived{text}"),
                "put this firmware on the board, `cargo rig flash BOARD`, or name the port of another one",
            ),
            0 if bytes > 0 => (
                format!("; {bytes} bytes, {} damaged frames and no intact one arrived", counters.damaged),
                "check the speed, as in serial:/dev/ttyUSB0@115200, and that the target runs this firmware: `cargo rig flash BOARD`",
            ),
            0 => (
                "; nothing at all arrived".to_owned(),
                "check that the target runs this firmware and that port and speed are right; reset it; or give it longer with --timeout",
            ),
            received => (
                format!("; {received} intact and {} damaged frames had arrived", counters.damaged),
                "reset it, or give it longer with --timeout",
            ),
        };
        Error::target(
            format!("{}: waited {:.1} s for {awaited}{heard}", self.name, since.elapsed().as_secs_f32()),
            next,
        )
    }

    /// An answer that doesn't fit the question.
    pub fn unexpected(&self, question: &str, answer: &Reply) -> Error {
        Error::new(Kind::Protocol, format!("{} answered `{question}` with {answer:?}", self.name), REBUILD)
    }

    fn other_version(&self, hello: &Hello) -> Error {
        let Hello { protocol, board, build, .. } = hello;
        let what = format!(
            "{} speaks protocol version {protocol}; this rig speaks version {PROTOCOL_VERSION} (board {board}, build {build})",
            self.name
        );
        let older = if *protocol < PROTOCOL_VERSION { "firmware" } else { "rig" };
        let next = format!(
            "the {older} is the older one: update the sources if need be, then build both from the same ones: `cargo rig flash {board}`"
        );
        Error::new(Kind::Protocol, what, next)
    }

    fn send(&mut self, command: &Command) -> Result<u16, Error> {
        let sequence = self.sequence;
        let mut frame = [0; MAX_FRAME];
        let bytes = flat_wire::encode(sequence, command, &mut frame)
            .map_err(|error| Error::usage(format!("`{}` doesn't fit a frame: {error}", title(command)), ""))?;
        self.link.send(bytes)?;
        self.sequence = sequence.wrapping_add(1);
        Ok(sequence)
    }

    /// The next event of the stream or reply; what the device says of itself goes into the journal. None if none came by the
    /// deadline.
    fn event(&mut self, deadline: Instant) -> Result<Option<Event>, Error> {
        loop {
            match self.intact(deadline)? {
                Some(Event::Frame(Frame::Log { lost, bytes })) => self.journal.log(lost, &bytes),
                Some(Event::Frame(Frame::Fault(fault))) if self.journal.is_introduced() => {
                    return Err(self.journal.failed(&fault));
                }
                Some(Event::Frame(Frame::Fault(fault))) => self.journal.tell(&fault),
                Some(Event::Frame(Frame::Started(cause))) if self.journal.is_introduced() => {
                    return Err(self.journal.restarted(cause));
                }
                Some(Event::Frame(Frame::Started(cause))) => self.journal.started(cause),
                other => return Ok(other),
            }
            if Instant::now() > deadline + interrupt::POLL {
                return Ok(None);
            }
        }
    }

    /// The next intact frame, or none if none came by the deadline.
    fn intact(&mut self, deadline: Instant) -> Result<Option<Event>, Error> {
        loop {
            while let Some(byte) = self.undecoded.pop_front() {
                match self.decoder.push::<Event>(byte) {
                    Some(Ok(packet)) => return Ok(Some(packet.message)),
                    // Counted by the decoder; whoever needs what was lost notices its absence.
                    Some(Err(error)) => self.undecodable += u32::from(matches!(error, FrameError::Malformed { .. })),
                    None => {}
                }
            }
            let bytes = self.link.receive(deadline)?;
            if !self.journal.is_introduced() {
                self.prelude.extend(&bytes);
                self.prelude.drain(..self.prelude.len().saturating_sub(PRELUDE));
            }
            self.undecoded.extend(bytes);
            // A line that never falls silent must not outlast the deadline either.
            if self.undecoded.is_empty() || Instant::now() > deadline + interrupt::POLL {
                return Ok(None);
            }
        }
    }
}

/// The last lines of what was said in plain text, as boot loaders and other programs do; nothing if it was none.
fn said(bytes: &VecDeque<u8>) -> String {
    const LINES: usize = 4;
    const WIDTH: usize = 100;
    let text: String = bytes.iter().map(|&byte| byte as char).collect();
    let is_text =
        |line: &&str| (4..=WIDTH).contains(&line.len()) && line.chars().all(|c| c.is_ascii_graphic() || c == ' ');
    let lines: Vec<_> = text.split(['\n', '\r', '\0']).map(str::trim_end).filter(is_text).collect();
    let last = &lines[lines.len().saturating_sub(LINES)..];
    last.iter().flat_map(|line| ["\n  | ", line]).collect()
}

const REBUILD: &str = "build the firmware and rig from the same sources: `cargo rig build BOARD`, then flash it";

/// Whether sending a command twice does what sending it once does.
fn idempotent(command: &Command) -> bool {
    !matches!(command, Command::Run { .. } | Command::Flip(_) | Command::Provoke(_))
}

fn title(command: &Command) -> &'static str {
    match command {
        Command::Hello { .. } => "hello",
        Command::Load(_) => "load",
        Command::Stream(_) => "stream",
        Command::Run { .. } => "run",
        Command::Stop => "stop",
        Command::Status => "status",
        Command::Watch(_) => "watch",
        Command::Flip(_) => "flip",
        Command::Input { .. } => "input",
        Command::Provoke(_) => "provoke",
    }
}
