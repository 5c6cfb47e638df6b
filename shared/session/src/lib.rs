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
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod any_world;
mod backtrace;
mod cut;
mod identity;
mod logs;
mod measures;
mod punctuality;
mod ring;
mod session;
mod sink;
mod stream;

pub use any_world::Worlds;
pub use backtrace::return_addresses;
pub use cut::cut;
pub use identity::{Identity, Stopwatch};
pub use logs::Logs;
pub use ring::{REPLY_RESERVE, Ring, STEP_RESERVE};
pub use session::{LinkCounters, Session};
pub use sink::{Class, Sink, encode};
