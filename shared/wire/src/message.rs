//! The whole protocol as one table: what a host may ask, what a device answers, what it streams.
//!
//! Messages carry raw numbers and names; what they mean to an engine is the session's business.

mod command;
mod reply;
mod stream;

use heapless::String;

pub use command::{
    Command, Detail, Flip, Flow, Level, Mishap, Mix, Order, Point, ScalarKind, SceneRequest, StreamRequest, Variant,
};
pub use reply::{Capacity, Counter, Event, Hello, Loaded, Reply, Stack, Status};
pub use stream::{
    BodyPosition, BodyState, Cause, ContactEvent, ContactState, Fault, FaultKind, Frame, Measures, Phase, Place,
    Statistics,
};

/// A scene's name.
pub type Name = String<24>;
/// Text that explains a refusal.
pub type Reason = String<96>;

/// Bytes of log messages in one [`Frame::Log`].
pub const LOG_BYTES: usize = 240;
/// Addresses in a [`Fault`].
pub const BACKTRACE: usize = 24;

/// Stages of one physics step; the length of every per-stage array.
pub const STAGES: usize = 6;
/// Bodies in one [`Frame::Bodies`], as many as [`crate::MAX_FRAME`] holds at their longest.
pub const BODIES_PER_FRAME: usize = 9;
/// Bodies in one [`Frame::Positions`].
pub const POSITIONS_PER_FRAME: usize = 36;
/// Contacts in one [`Frame::Contacts`], as many as [`crate::MAX_FRAME`] holds at their longest.
pub const CONTACTS_PER_FRAME: usize = 8;
/// Contact events in one [`Frame::Events`], as many as [`crate::MAX_FRAME`] holds at their longest.
pub const EVENTS_PER_FRAME: usize = 8;
