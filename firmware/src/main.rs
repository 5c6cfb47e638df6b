//! `flat` on a microcontroller: three tasks around the session that also runs in the host's mock.
//!
//! ```text
//!                                  microsecond timer of the board
//!                                               v
//!   serial in -> receive -> [ARRIVALS] -> simulate -> [OUTBOX] -> transmit -> serial out
//!                                                        ^
//!                              defmt -> [LOGS] -> log ---+
//! ```
//! 1. `simulate` has an executor of its own, in an interrupt above all others. A slow, silent, flooded or stuck link, or a
//!    storm of log messages, never delays a step.
//! 2. A link slower than the stream costs frames, by rule and counted; the rule is the session's.
//! 3. Whatever goes wrong says so on the link, in a last frame, and the device starts anew.
//! 4. A board is a clock, two halves of a serial port, a counter and a name; everything else is shared.
#![no_std]
#![no_main]
#![deny(clippy::undocumented_unsafe_blocks)]
#![cfg_attr(feature = "tests", expect(dead_code, reason = "tests on the device start none of the tasks"))]
#![cfg_attr(not(feature = "physics"), expect(dead_code, reason = "without physics nothing is timed"))]

mod board;
mod fault;
mod kept;
#[cfg(not(feature = "rtt"))]
mod logger;
#[cfg(feature = "provoke")]
mod provoke;
mod stack;
mod tasks;
#[cfg(feature = "tests")]
mod tests;
mod watchdog;

#[cfg(feature = "rtt")]
use defmt_rtt as _;

use embassy_executor::{SendSpawner, Spawner};
use flat_session::{Class, Identity};
use flat_wire::MAX_FRAME;
use flat_wire::message::{Event, Frame};

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
    pub(crate) counter: board::StageCounter,
    /// Serial in.
    pub(crate) receiver: board::Receiver,
    /// Serial out.
    pub(crate) transmitter: board::Transmitter,
}

/// Starts the tasks: physics on its own executor, which interrupts the link's.
pub(crate) fn start(parts: Parts, physics: SendSpawner, link: Spawner) {
    let Parts { identity, receiver, transmitter, .. } = parts;
    let cause = fault::cause();
    defmt::info!("{=str} of build {=str} starts", identity.board, identity.build);
    // The outbox is empty: there is room.
    tasks::OUTBOX.offer(Class::Reply, &Event::Frame(Frame::Started(cause)), &mut [0; MAX_FRAME]);
    // Each task has room for one instance, and this function is called once: no token is ever refused.
    link.spawn(tasks::transmit(transmitter).expect("first instance"));
    link.spawn(tasks::receive(receiver).expect("first instance"));
    #[cfg(not(feature = "rtt"))]
    link.spawn(tasks::log().expect("first instance"));
    physics.spawn(cfg_select! {
        feature = "physics" => tasks::simulate(identity, parts.counter).expect("first instance"),
        _ => tasks::attend(identity).expect("first instance"),
    });
}
