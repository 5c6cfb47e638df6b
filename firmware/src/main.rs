//! `flat` on a microcontroller: three tasks around the session that also runs in the host's mock.
//!
//! ```text
//!   serial in -> receive -> [ARRIVALS] -> simulate -> [OUTBOX] -> transmit -> serial out
//!                                            ^
//!                                microsecond timer of the board
//! ```
//! 1. Steps are paced by the board's timer alone. A slow, silent or noisy link never delays one.
//! 2. A link slower than the stream costs frames, by rule and counted; the rule is the session's.
//! 3. A board is a clock, two halves of a serial port, a stopwatch and a name; everything else is shared.
#![no_std]
#![no_main]
#![deny(clippy::undocumented_unsafe_blocks)]

mod board;
mod tasks;

use embassy_executor::{SendSpawner, Spawner};
use flat_session::Identity;

/// Identifies the sources: `FLAT_BUILD` where the build sets it, else the version.
pub(crate) const BUILD: &str = match option_env!("FLAT_BUILD") {
    Some(build) => build,
    None => env!("CARGO_PKG_VERSION"),
};
const _: () = assert!(BUILD.len() <= 32, "FLAT_BUILD is longer than the protocol's 32 bytes");

/// What a board hands over once it runs.
pub(crate) struct Parts {
    /// What the board says of itself.
    pub(crate) identity: Identity,
    /// Times the stages.
    pub(crate) stopwatch: board::Stopwatch,
    /// Serial in.
    pub(crate) receiver: board::Receiver,
    /// Serial out.
    pub(crate) transmitter: board::Transmitter,
}

/// Starts the tasks: physics on its own executor where the board has one above the link's.
pub(crate) fn start(parts: Parts, physics: SendSpawner, link: Spawner) {
    let Parts { identity, stopwatch, receiver, transmitter } = parts;
    // Each task has room for one instance, and this function is called once: no token is ever refused.
    link.spawn(tasks::transmit(transmitter).expect("first instance"));
    link.spawn(tasks::receive(receiver).expect("first instance"));
    physics.spawn(tasks::simulate(identity, stopwatch).expect("first instance"));
}
