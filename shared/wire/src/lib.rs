//! The serial protocol between a `flat` device and its host: one table of messages, in frames that
//! survive a bad line.
//!
//! 1. **One table.** All that can be said stands in [`message`]. Host and device compare
//!    [`PROTOCOL_VERSION`] first and go no further when they differ.
//! 2. **Nothing is invented.** What is received was sent: a damaged frame is refused, but for the one in
//!    4 billion that a 32-bit checksum lets through.
//! 3. **Damage is local.** Whatever bytes arrive, the first intact frame behind a delimiter is received.
//! 4. **No loss is silent.** Refused frames and gaps in the sequence numbers are counted.
//! 5. **Memory is bounded.** No heap, no panic on any input, no frame above [`MAX_FRAME`] bytes.
//!
//! ```text
//!  memory   | sequence, u16 LE | message, postcard       | CRC-32, u32 LE |
//!           |<------------- covered by the CRC --------->|
//!
//!  line     | the same in COBS: 1 to 3 bytes longer, none of them zero | 00 |
//! ```
//!
//! - [`message`]: commands, replies and the stream;
//! - [`encode`]: a message becomes a frame;
//! - [`Decoder`]: bytes become messages, one byte at a time.
//!
//! The zero byte ends a frame and occurs nowhere else. More zeros between frames are harmless, so a sender
//! that doesn't know what the line carried before starts with one.
//!
//! ```
//! use flat_wire::{Decoder, MAX_FRAME, encode, message::Command};
//!
//! let mut buffer = [0; MAX_FRAME];
//! let frame = encode(7, &Command::Run { steps: 600 }, &mut buffer)?;
//!
//! let mut decoder = Decoder::new();
//! for &byte in frame {
//!     match decoder.push::<Command>(byte) {
//!         None => {} // not the end of a frame
//!         Some(Ok(packet)) => assert_eq!((packet.sequence, packet.message), (7, Command::Run { steps: 600 })),
//!         Some(Err(error)) => println!("{error}"), // counted; the next frame is received
//!     }
//! }
//! assert_eq!(decoder.counters().received, 1);
//! # Ok::<(), flat_wire::EncodeError>(())
//! ```
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod decoder;
mod frame;
pub mod message;

pub use decoder::{Counters, Decoder, FrameError, Packet};
pub use frame::{EncodeError, MAX_FRAME, MAX_MESSAGE, encode};

/// Version of the message table. Host and device must agree.
pub const PROTOCOL_VERSION: u16 = 1;

/// Rate of a UART between device and host, baud, where nobody names another: the highest that common USB bridges do
/// without errors.
pub const BAUD: u32 = 921_600;
