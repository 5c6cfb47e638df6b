//! Log messages on their way to the line: whole or not at all.

use flat_wire::message::{Frame, LOG_BYTES};
use heapless::{Deque, Vec};

/// Encoded log messages that wait for the line, `N` bytes of them.
///
/// A message comes in parts, between [`begin`](Self::begin) and [`end`](Self::end). One that doesn't fit is lost, as a
/// whole, and counted: writing never waits.
#[derive(Debug)]
pub struct Logs<const N: usize> {
    bytes: Deque<u8, N>,
    /// Bytes of the message under way, the last ones in the queue.
    open: usize,
    /// Whether a part of the message under way found no room.
    spilled: bool,
    /// Messages lost so far.
    lost: u32,
}

impl<const N: usize> Logs<N> {
    /// Nothing logged yet.
    pub const fn new() -> Self {
        Self { bytes: Deque::new(), open: 0, spilled: false, lost: 0 }
    }

    /// Begins a message.
    pub fn begin(&mut self) {
        (self.open, self.spilled) = (0, false);
    }

    /// Adds a part to the message that was begun.
    pub fn append(&mut self, part: &[u8]) {
        for &byte in part {
            if self.spilled || self.bytes.push_back(byte).is_err() {
                self.spilled = true;
                return;
            }
            self.open += 1;
        }
    }

    /// Ends the message: it is now on its way, or lost.
    pub fn end(&mut self) {
        if self.spilled {
            self.bytes.truncate(self.bytes.len() - self.open);
            self.lost = self.lost.saturating_add(1);
        }
        self.open = 0;
    }

    /// Takes the oldest bytes out, as many as fit a frame; none if no message waits.
    ///
    /// Frames may cut messages anywhere: what counts is the order of the bytes.
    pub fn take(&mut self) -> Option<Frame> {
        let count = (self.bytes.len() - self.open).min(LOG_BYTES);
        let bytes: Vec<u8, LOG_BYTES> = (0..count).filter_map(|_| self.bytes.pop_front()).collect();
        (count > 0).then_some(Frame::Log { lost: self.lost, bytes })
    }
}

impl<const N: usize> Default for Logs<N> {
    fn default() -> Self {
        Self::new()
    }
}
