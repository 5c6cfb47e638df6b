//! The tasks, the same on every board, and what runs between them.

mod arrivals;
#[cfg(not(feature = "rtt"))]
mod log;
mod outbox;
mod receive;
mod simulate;
mod transmit;

#[cfg(not(feature = "rtt"))]
pub(crate) use log::log;
pub(crate) use outbox::OUTBOX;
pub(crate) use receive::receive;
pub(crate) use simulate::simulate;
pub(crate) use transmit::transmit;
