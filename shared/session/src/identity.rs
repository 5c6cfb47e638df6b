//! What a device says of itself, and what it can measure.

use flat_wire::message::Counter;

/// What a device says of itself.
#[derive(Clone, Copy, Debug)]
pub struct Identity {
    /// Board name, at most 16 bytes; the rest isn't sent.
    pub board: &'static str,
    /// Identifies the sources, at most 32 bytes; the rest isn't sent.
    pub build: &'static str,
    /// CPU clock, Hz; 0 = unknown.
    pub clock_hz: u32,
    /// What the stopwatch counts.
    pub counter: Counter,
}

/// A free-running counter for stage times; wraps.
pub trait Stopwatch {
    /// The count now, in the unit of [`Identity::counter`].
    fn count(&mut self) -> u32;
}
