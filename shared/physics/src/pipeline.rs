//! The stages, in the order in which [`step`](crate::step()) runs them, and the scheduler that says when.

pub mod scheduler;

pub(crate) mod bounce;
pub(crate) mod broadphase;
pub(crate) mod carry;
pub(crate) mod ccd;
pub(crate) mod events;
pub(crate) mod flat;
pub(crate) mod grid;
pub(crate) mod grounded;
pub(crate) mod integrate;
pub(crate) mod narrowphase;
pub(crate) mod one_way;
pub(crate) mod order;
pub(crate) mod pairs;
pub(crate) mod position;
pub(crate) mod sleep;
pub(crate) mod sweep;
pub(crate) mod terrain;
