//! The host's side of the protocol: requests with deadlines and retries, and the stream in between.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use flat_wire::message::{Command, Event, Frame, Hello, Reply};
use flat_wire::{Counters, Decoder, FrameError, MAX_FRAME, PROTOCOL_VERSION};

use crate::error::{Error, Kind};
use crate::interrupt;
use crate::target::link::Link;

/// How long an idempotent request waits before it is sent again.
const RETRY: Duration = Duration::from_millis(300);

/// A device that has said hello.
pub struct Client {
    link: Link,
    name: String,
    patience: Duration,
    decoder: Decoder,
    sequence: u16,
    undecoded: VecDeque<u8>,
    undecodable: u32,
}

impl Client {
    /// Says hello until the device answers: bytes sent before it listens are lost.
    ///
    /// # Errors
    /// [`Kind::Protocol`] if it speaks another version; [`Kind::Target`] if it stays silent.
    pub fn connect(link: Link, name: String, patience: Duration) -> Result<(Self, Hello), Error> {
        let mut client = Self {
            link,
            name,
            patience,
            decoder: Decoder::new(),
            sequence: 0,
            undecoded: VecDeque::new(),
            undecodable: 0,
        };
        // Ends whatever half frame the line's noise or an earlier host left in the device's decoder.
        client.link.send(&[0])?;
        match client.request(&Command::Hello { protocol: PROTOCOL_VERSION }) {
            Ok(Reply::Hello(hello)) if hello.protocol == PROTOCOL_VERSION => Ok((client, hello)),
            Ok(Reply::Hello(hello)) => Err(client.other_protocol(&format!("protocol version {}", hello.protocol))),
            Ok(other) => Err(client.unexpected("hello", &other)),
            // Intact frames that make no sense are the other way for a version to show.
            Err(error) if error.kind() == Kind::Target && client.undecodable > 0 => {
                Err(client.other_protocol("another protocol: its frames arrive intact but mean nothing here"))
            }
            Err(error) => Err(error),
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
        let started = Instant::now();
        let deadline = started + self.patience;
        let mut asked = vec![self.send(command)?];
        let mut again = started + RETRY;
        while Instant::now() < deadline {
            let wake = if idempotent(command) { deadline.min(again) } else { deadline };
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
                    asked.push(self.send(command)?);
                    again = Instant::now() + RETRY;
                }
                Some(_) | None => {}
            }
        }
        Err(self.silent(&format!("the answer to `{}`", title(command)), started))
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
        let heard = match counters.received {
            0 if counters.damaged > 0 => format!("; {} damaged frames and no intact one arrived", counters.damaged),
            0 => "; nothing at all arrived".to_owned(),
            received => format!("; {received} intact and {} damaged frames had arrived", counters.damaged),
        };
        Error::target(
            format!("{}: waited {:.1} s for {awaited}{heard}", self.name, since.elapsed().as_secs_f32()),
            "check that the target runs this firmware and that port and speed are right; reset it; or give it longer with --timeout",
        )
    }

    /// An answer that doesn't fit the question.
    pub fn unexpected(&self, question: &str, answer: &Reply) -> Error {
        Error::new(Kind::Protocol, format!("{} answered `{question}` with {answer:?}", self.name), REBUILD)
    }

    fn other_protocol(&self, theirs: &str) -> Error {
        Error::new(
            Kind::Protocol,
            format!("{} speaks {theirs}; this rig speaks version {PROTOCOL_VERSION}", self.name),
            REBUILD,
        )
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

    /// The next intact event, or none if none came by the deadline.
    fn event(&mut self, deadline: Instant) -> Result<Option<Event>, Error> {
        loop {
            while let Some(byte) = self.undecoded.pop_front() {
                match self.decoder.push::<Event>(byte) {
                    Some(Ok(packet)) => return Ok(Some(packet.message)),
                    // Counted by the decoder; whoever needs what was lost notices its absence.
                    Some(Err(error)) => self.undecodable += u32::from(matches!(error, FrameError::Malformed { .. })),
                    None => {}
                }
            }
            self.undecoded.extend(self.link.receive(deadline)?);
            // A line that never falls silent must not outlast the deadline either.
            if self.undecoded.is_empty() || Instant::now() > deadline + interrupt::POLL {
                return Ok(None);
            }
        }
    }
}

const REBUILD: &str = "build the firmware and rig from the same sources: `cargo rig build BOARD`, then flash it";

/// Whether sending a command twice does what sending it once does.
fn idempotent(command: &Command) -> bool {
    !matches!(command, Command::Run { .. } | Command::Flip(_))
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
    }
}
