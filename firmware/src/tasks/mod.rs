//! The tasks, the same on every board, and what runs between them.

mod arrivals;
mod outbox;
mod receive;
mod simulate;
mod transmit;

pub(crate) use receive::receive;
pub(crate) use simulate::simulate;
pub(crate) use transmit::transmit;
