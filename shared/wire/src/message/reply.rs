//! What a device answers.

use heapless::{String, Vec};
use serde::{Deserialize, Serialize};

use super::{Frame, Reason, ScalarKind};

/// Device to host.
#[allow(clippy::large_enum_variant, reason = "there is no heap to box the larger ones in")]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Event {
    /// Answer to the command with this sequence number.
    Reply {
        /// Sequence number of the command's frame.
        to: u16,
        /// The answer.
        reply: Reply,
    },
    /// Part of the stream.
    Frame(Frame),
}

/// Answers to commands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Reply {
    /// Who is there.
    Hello(Hello),
    /// The scene stands.
    Loaded(Loaded),
    /// Done, nothing to say.
    Done,
    /// Not done, nothing changed; why.
    Refused(Reason),
    /// The present state of affairs.
    Status(Status),
}

/// Identity and limits of a device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hello {
    /// [`crate::PROTOCOL_VERSION`] of the device.
    pub protocol: u16,
    /// Identifies the sources that the device was built from.
    pub build: String<32>,
    /// Board name.
    pub board: String<16>,
    /// CPU clock in Hz; 0 = unknown.
    pub clock_hz: u32,
    /// What [`Frame::StageTimes`] counts.
    pub counter: Counter,
    /// Capacities, one entry for each number format that the device can run.
    pub capacities: Vec<Capacity, 3>,
}

/// Room for one number format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Capacity {
    /// The number format.
    pub scalar: ScalarKind,
    /// Most bodies.
    pub bodies: u16,
    /// Most contacts.
    pub contacts: u16,
}

/// Unit of stage times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Counter {
    /// The device has none: all zero.
    #[default]
    None,
    /// Retired instructions.
    Instructions,
    /// CPU cycles.
    Cycles,
    /// Nanoseconds.
    Nanoseconds,
}

/// A scene as built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Loaded {
    /// Bodies in the world, static ones included.
    pub bodies: u16,
    /// Digest before the first step.
    pub digest: u64,
}

/// The session's counters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Status {
    /// Steps done since the scene was loaded.
    pub step: u32,
    /// Steps still to run.
    pub remaining: u32,
    /// Time that has passed but isn't simulated yet, in us.
    pub backlog_us: u64,
    /// Frames received intact.
    pub received: u32,
    /// Frames received damaged, and discarded.
    pub damaged: u32,
    /// Detail frames dropped because the link was slow: state, contacts, times.
    pub dropped_detail: u32,
    /// Step and statistics frames dropped because the link was slow.
    pub dropped_steps: u32,
    /// Worst lateness of any step since the run began, us, as in [`Frame::Timing`].
    pub late_us: u32,
    /// Longest step since the run began, us.
    pub took_us: u32,
    /// Steps of the run that ended after the next one was due.
    pub overruns: u32,
    /// The stack that all tasks and interrupts share.
    pub stack: Stack,
}

/// Use of a stack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stack {
    /// Size in bytes; 0 = the device doesn't know.
    pub size: u32,
    /// Most bytes ever in use since the device started.
    pub peak: u32,
}
