//! The device program without I/O: commands in, frames out, steps in between.
//!
//! Time, bytes and cycle counts come in as arguments, so the boards, QEMU and the mock run the same code, and what it does
//! is tested without any of them.
//!
//! ```text
//! commands ─▶ Session::handle ─▶ replies ─┐
//!                                         ├─▶ Sink (a Ring) ─▶ line
//! time ─────▶ Session::tick ──▶ frames ───┘
//!              scheduler ─▶ world: one stage at a time ─▶ stream: what to send of it
//! ```
//! Without the feature `physics` there is [`bare`] in place of all that, and nothing of the engine is compiled.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

#[cfg(feature = "physics")]
mod any_world;
mod backtrace;
pub mod bare;
mod cut;
#[cfg(feature = "physics")]
mod demo;
mod identity;
mod link;
mod logs;
#[cfg(feature = "physics")]
mod measures;
#[cfg(feature = "physics")]
mod punctuality;
mod ring;
#[cfg(feature = "physics")]
mod session;
mod sink;
#[cfg(feature = "physics")]
mod stream;

#[cfg(feature = "physics")]
pub use any_world::Worlds;
pub use backtrace::return_addresses;
pub use cut::cut;
#[cfg(feature = "physics")]
pub use demo::Demo;
pub use identity::{Identity, Stopwatch};
pub use link::LinkCounters;
pub use logs::Logs;
pub use ring::{REPLY_RESERVE, Ring, STEP_RESERVE};
#[cfg(feature = "physics")]
pub use session::Session;
pub use sink::{Class, Sink, encode};
