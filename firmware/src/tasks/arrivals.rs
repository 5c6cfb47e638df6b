//! Commands on their way from the link to the simulation.

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use flat_session::LinkCounters;
use flat_wire::message::{Command, Stack};

/// Commands that wait while a step runs. A full channel makes the receiver wait, and with it, where the port knows how,
/// the host.
const WAITING: usize = 4;

/// An intact frame.
pub(super) struct Arrival {
    pub(super) sequence: u16,
    /// None = not in this device's table.
    pub(super) command: Option<Command>,
    /// The receiver's counters, this frame included.
    pub(super) link: LinkCounters,
    /// For a command that asks: how deep the stack was.
    pub(super) stack: Option<Stack>,
}

/// From `receive` to `simulate`.
pub(super) static ARRIVALS: Channel<CriticalSectionRawMutex, Arrival, WAITING> = Channel::new();
