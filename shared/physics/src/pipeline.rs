//! The stages, in the order in which [`step`](crate::step()) runs them, and the scheduler that says when.

pub mod scheduler;

pub(crate) mod broadphase;
pub(crate) mod events;
pub(crate) mod grid;
pub(crate) mod integrate;
pub(crate) mod narrowphase;
pub(crate) mod position;
pub(crate) mod velocity;
