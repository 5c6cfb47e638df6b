//! Where frames go.

use flat_wire::message::Event;
use flat_wire::{MAX_FRAME, encode};

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

/// Where encoded frames go: whole or not at all.
pub trait Sink {
    /// Takes the frame, or returns false and takes nothing of it.
    fn push(&mut self, class: Class, frame: &[u8]) -> bool;
}

/// Numbers, encodes and hands over events.
#[derive(Debug)]
pub(crate) struct Sender {
    sequence: u16,
    buffer: [u8; MAX_FRAME],
}

impl Sender {
    pub(crate) const fn new() -> Self {
        Self { sequence: 0, buffer: [0; MAX_FRAME] }
    }

    /// False if the sink had no room: then the sequence number is still to be used, or to be [`skip`](Self::skip)ped.
    pub(crate) fn offer(&mut self, class: Class, event: &Event, sink: &mut dyn Sink) -> bool {
        // Every event of the table fits a frame, which flat-wire's tests prove; one that didn't would count as dropped.
        let taken = encode(self.sequence, event, &mut self.buffer).is_ok_and(|frame| sink.push(class, frame));
        if taken {
            self.skip();
        }
        taken
    }

    /// Leaves a gap in the sequence, by which the host sees that a frame was dropped.
    pub(crate) fn skip(&mut self) {
        self.sequence = self.sequence.wrapping_add(1);
    }
}
