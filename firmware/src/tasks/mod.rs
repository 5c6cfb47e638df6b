//! The tasks, the same on every board, and what runs between them.

mod answer;
mod arrivals;
#[cfg(not(feature = "physics"))]
mod attend;
#[cfg(not(feature = "rtt"))]
mod log;
mod outbox;
mod receive;
#[cfg(feature = "physics")]
mod show;
#[cfg(feature = "physics")]
mod simulate;
mod transmit;

#[cfg(not(feature = "physics"))]
pub(crate) use attend::attend;
#[cfg(not(feature = "rtt"))]
pub(crate) use log::log;
pub(crate) use outbox::OUTBOX;
pub(crate) use receive::receive;
#[cfg(feature = "physics")]
pub(crate) use simulate::simulate;
pub(crate) use transmit::transmit;
