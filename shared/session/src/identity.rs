//! What a device says of itself, and what it can measure.

use flat_wire::PROTOCOL_VERSION;
use flat_wire::message::{Capacity, Counter, Hello};
use heapless::Vec;

use crate::cut::cut;

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

impl Identity {
    /// With the room in its worlds, all that a host is told first.
    pub(crate) fn hello(&self, capacities: Vec<Capacity, 3>) -> Hello {
        Hello {
            protocol: PROTOCOL_VERSION,
            build: cut(format_args!("{}", self.build)),
            board: cut(format_args!("{}", self.board)),
            clock_hz: self.clock_hz,
            counter: self.counter,
            capacities,
        }
    }
}

/// The device's clock, and a free-running counter for stage times.
pub trait Stopwatch {
    /// Device time, us.
    fn now_us(&mut self) -> u64;
    /// The count now, in the unit of [`Identity::counter`]; wraps.
    fn count(&mut self) -> u32;
}
