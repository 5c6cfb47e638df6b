//! Where frames go.

use flat_wire::message::Event;
use flat_wire::{EncodeError, MAX_FRAME};

/// What gives way first when the link is slow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// State, contacts, times.
    Detail,
    /// Steps and statistics.
    Step,
    /// Replies and ends of runs.
    Reply,
}

/// Where encoded frames go: whole or not at all. It numbers them, so that several senders can share it.
pub trait Sink {
    /// Number of the next frame.
    fn sequence(&self) -> u16;

    /// Takes the frame, which has the next number, or returns false and takes nothing of it.
    fn push(&mut self, class: Class, frame: &[u8]) -> bool;

    /// Leaves a number out: by the gap the host sees that a frame was dropped.
    fn skip(&mut self);
}

/// Encodes an event as a frame, delimiter included.
///
/// # Errors
///
/// As [`flat_wire::encode`]: when the event doesn't fit, which flat-wire's tests exclude for all that its table allows.
#[inline(never)] // one copy for all senders, which firmware can place by its name
pub fn encode<'a>(sequence: u16, event: &Event, buffer: &'a mut [u8; MAX_FRAME]) -> Result<&'a [u8], EncodeError> {
    flat_wire::encode(sequence, event, buffer)
}

/// Encodes events and hands them over.
#[derive(Debug)]
pub(crate) struct Sender {
    buffer: [u8; MAX_FRAME],
}

impl Sender {
    pub(crate) const fn new() -> Self {
        Self { buffer: [0; MAX_FRAME] }
    }

    /// False if the sink had no room: then the number is still to be used, or to be [`skip`](Sink::skip)ped.
    pub(crate) fn offer(&mut self, class: Class, event: &Event, sink: &mut dyn Sink) -> bool {
        // One that didn't fit a frame would count as dropped.
        encode(sink.sequence(), event, &mut self.buffer).is_ok_and(|frame| sink.push(class, frame))
    }
}
