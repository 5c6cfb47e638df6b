//! The device program of a build without physics: it says who it is and how its link does, and refuses everything that
//! takes a world.

use flat_wire::PROTOCOL_VERSION;
use flat_wire::message::{Command, Event, Reason, Reply, Stack, Status};
use heapless::Vec;

use crate::cut::cut;
use crate::identity::Identity;
use crate::link::LinkCounters;
use crate::sink::{Class, Sender, Sink};

/// The device program; what it shares with [`Session`](crate::Session) goes by the same names.
#[derive(Debug)]
pub struct Session {
    identity: Identity,
    sender: Sender,
    link: LinkCounters,
    stack: Stack,
    /// Replies that the host asked for faster than it read.
    dropped: u32,
}

impl Session {
    /// A device that has just started.
    pub fn new(identity: Identity) -> Self {
        let (link, stack) = (LinkCounters::default(), Stack::default());
        Self { identity, sender: Sender::new(), link, stack, dropped: 0 }
    }

    /// Carries out one command and answers it, whenever that is.
    pub fn handle(&mut self, _now_us: u64, sequence: u16, command: &Command, sink: &mut dyn Sink) {
        let reply = match command {
            Command::Hello { .. } => Reply::Hello(self.identity.hello(Vec::new())),
            Command::Status => Reply::Status(self.status()),
            _ => Reply::Refused(reason(format_args!("this build has no physics: it runs no scenes"))),
        };
        self.reply(sequence, reply, sink);
    }

    /// Answers a frame that arrived intact but isn't in this device's table of commands.
    pub fn refuse_unknown(&mut self, sequence: u16, sink: &mut dyn Sink) {
        let text = reason(format_args!("unknown command; this device speaks protocol {PROTOCOL_VERSION}"));
        self.reply(sequence, Reply::Refused(text), sink);
    }

    /// Answers a command that was carried out elsewhere.
    pub fn acknowledge(&mut self, sequence: u16, sink: &mut dyn Sink) {
        self.reply(sequence, Reply::Done, sink);
    }

    /// Takes note of the receiver's counters, for [`Status`].
    pub fn note_link(&mut self, counters: LinkCounters) {
        self.link = counters;
    }

    /// Takes note of how deep the stack was, for [`Status`].
    pub fn note_stack(&mut self, stack: Stack) {
        self.stack = stack;
    }

    fn status(&self) -> Status {
        let LinkCounters { received, damaged } = self.link;
        Status { received, damaged, stack: self.stack, dropped_steps: self.dropped, ..Status::default() }
    }

    fn reply(&mut self, to: u16, reply: Reply, sink: &mut dyn Sink) {
        if !self.sender.offer(Class::Reply, &Event::Reply { to, reply }, sink) {
            sink.skip();
            self.dropped = self.dropped.saturating_add(1);
        }
    }
}

fn reason(text: core::fmt::Arguments<'_>) -> Reason {
    cut(text)
}
