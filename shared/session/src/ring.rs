//! Where frames wait for the line: a ring of bytes that keeps room for what matters more.

use flat_wire::MAX_FRAME;

use crate::{Class, Sink};

/// Bytes that details leave free for steps and statistics: the longest [`Step`](flat_wire::message::Frame::Step)
/// for a quarter of a second of 60 Hz, and one [`Statistics`](flat_wire::message::Frame::Statistics).
pub const STEP_RESERVE: usize = 512;

/// Bytes that all others leave free for replies and ends of runs: two of the longest replies and one
/// [`Finished`](flat_wire::message::Frame::Finished).
pub const REPLY_RESERVE: usize = 256;

/// A [`Sink`] of `N` bytes between the session and a slower line.
///
/// ```text
///  0                           N - STEP_RESERVE - REPLY_RESERVE    N - REPLY_RESERVE    N
///  |------------------------------------|--------------------------------|--------------|
///   Detail fills it up to here ---------^      Step up to here ----------^    Reply all
/// ```
///
/// A frame is taken when the ring, with it, is filled no further than its class may fill it, and is refused whole
/// otherwise. So a slow line loses details first, then steps, and replies only when the host asks faster than it
/// reads. Frames leave in the order in which they came, whatever their class.
#[derive(Debug)]
pub struct Ring<const N: usize> {
    bytes: [u8; N],
    /// Index of the oldest byte, below `N`.
    start: usize,
    /// Bytes waiting, at most `N`.
    waiting: usize,
    /// Number of the next frame.
    sequence: u16,
}

impl<const N: usize> Ring<N> {
    /// An empty ring; all zero, so that in a static it takes no flash.
    ///
    /// A ring in which the longest detail frame would never fit doesn't compile:
    ///
    /// ```compile_fail,E0080
    /// static RING: flat_session::Ring<1024> = flat_session::Ring::new();
    /// ```
    pub const fn new() -> Self {
        const {
            assert!(
                N >= MAX_FRAME + STEP_RESERVE + REPLY_RESERVE,
                "the ring must hold MAX_FRAME + STEP_RESERVE + REPLY_RESERVE bytes"
            );
        }
        Self { bytes: [0; N], start: 0, waiting: 0, sequence: 0 }
    }

    /// Whether nothing waits.
    pub const fn is_empty(&self) -> bool {
        self.waiting == 0
    }

    /// Bytes that a frame of this class may still use.
    pub fn room(&self, class: Class) -> usize {
        Self::limit(class).saturating_sub(self.waiting)
    }

    /// Moves the oldest bytes to the front of `out`, as many as there are and fit, and returns how many.
    ///
    /// The line may cut frames anywhere: what counts is the order of the bytes.
    pub fn read(&mut self, out: &mut [u8]) -> usize {
        let count = self.waiting.min(out.len());
        let (upper, lower) = out[..count].split_at_mut(count.min(N - self.start));
        upper.copy_from_slice(&self.bytes[self.start..][..upper.len()]);
        lower.copy_from_slice(&self.bytes[..lower.len()]);
        self.start = Self::wrapped(self.start + count);
        self.waiting -= count;
        count
    }

    /// How far a class may fill the ring, in bytes.
    const fn limit(class: Class) -> usize {
        match class {
            Class::Detail => N - STEP_RESERVE - REPLY_RESERVE,
            Class::Step => N - REPLY_RESERVE,
            Class::Reply => N,
        }
    }

    /// An index that ran past the end by less than `N`, back in the ring.
    const fn wrapped(index: usize) -> usize {
        if index < N { index } else { index - N }
    }
}

impl<const N: usize> Sink for Ring<N> {
    fn sequence(&self) -> u16 {
        self.sequence
    }

    fn push(&mut self, class: Class, frame: &[u8]) -> bool {
        if frame.len() > self.room(class) {
            return false;
        }
        let end = Self::wrapped(self.start + self.waiting);
        let (upper, lower) = frame.split_at(frame.len().min(N - end));
        self.bytes[end..][..upper.len()].copy_from_slice(upper);
        self.bytes[..lower.len()].copy_from_slice(lower);
        self.waiting += frame.len();
        self.skip();
        true
    }

    fn skip(&mut self) {
        self.sequence = self.sequence.wrapping_add(1);
    }
}

impl<const N: usize> Default for Ring<N> {
    fn default() -> Self {
        Self::new()
    }
}
