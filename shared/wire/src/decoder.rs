//! How the bytes of a line become messages again, whatever the line did to them.

use core::fmt;

use cobs::{DecodeResult, DecoderState};
use heapless::Vec;
use serde::de::DeserializeOwned;

use crate::PROTOCOL_VERSION;
use crate::frame::{CHECKSUM, CRC, DELIMITER, MAX_FRAME, SEQUENCE};

/// Most bytes that a frame can hold: COBS adds at least one.
const MAX_CONTENT: usize = MAX_FRAME - DELIMITER - 1;

/// Receives frames byte by byte, finds the next frame after garbage, and keeps count.
///
/// Holds one frame; the type of the messages is up to [`push`](Self::push).
#[derive(Debug)]
pub struct Decoder {
    cobs: DecoderState,
    content: Vec<u8, MAX_CONTENT>,
    /// The present frame was refused already; waiting for its delimiter.
    skipping: bool,
    /// Sequence number that the next frame should have; none = any.
    expected: Option<u16>,
    counters: Counters,
}

/// A message, and the sequence number of the frame that brought it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Packet<T> {
    /// The sender's count of frames; wraps.
    pub sequence: u16,
    /// The message.
    pub message: T,
}

/// What a decoder has seen so far. Each count stays at its maximum once there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Messages received.
    pub received: u32,
    /// Frames refused, one for each [`FrameError`].
    pub damaged: u32,
    /// Frames that were sent but never arrived intact, by the gaps in the sequence numbers.
    ///
    /// A damaged frame can't be trusted with its number, so it counts here as well, as soon as a later one arrives. A
    /// number that goes back, or forward by half the range, is a repetition or a restarted sender: it counts nothing.
    pub missing: u32,
}

impl Decoder {
    /// A decoder at the start of a line.
    pub const fn new() -> Self {
        Self {
            cobs: DecoderState::Idle,
            content: Vec::new(),
            skipping: false,
            expected: None,
            counters: Counters { received: 0, damaged: 0, missing: 0 },
        }
    }

    /// Takes the line's next byte; returns a message or an error when that byte settles the fate of a frame.
    ///
    /// # Errors
    ///
    /// The frame was refused, see [`FrameError`]. Nothing has to be done to receive the next one.
    pub fn push<T: DeserializeOwned>(&mut self, byte: u8) -> Option<Result<Packet<T>, FrameError>> {
        let result = self.unstuff(byte)?.and_then(|()| self.open());
        let count = match result {
            Ok(_) => &mut self.counters.received,
            Err(_) => &mut self.counters.damaged,
        };
        *count = count.saturating_add(1);
        Some(result)
    }

    /// What was received so far.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// Undoes COBS. At the end of a frame its bytes are in `content`.
    fn unstuff(&mut self, byte: u8) -> Option<Result<(), FrameError>> {
        if self.skipping {
            self.skipping = byte != 0;
            return None;
        }
        if matches!(self.cobs, DecoderState::Idle) {
            self.content.clear();
        }
        match self.cobs.feed(byte) {
            Ok(DecodeResult::NoData) => None,
            Ok(DecodeResult::DataContinue(data)) => {
                self.content.push(data).err()?;
                self.cobs = DecoderState::Idle;
                self.skipping = true;
                Some(Err(FrameError::Oversize))
            }
            Ok(DecodeResult::DataComplete) => Some(Ok(())),
            Err(_) => Some(Err(FrameError::Truncated)),
        }
    }

    /// Checks `content` and reads the message in it.
    fn open<T: DeserializeOwned>(&mut self) -> Result<Packet<T>, FrameError> {
        let (checked, crc) = self.content.split_last_chunk::<CHECKSUM>().ok_or(FrameError::Truncated)?;
        let (sequence, message) = checked.split_first_chunk::<SEQUENCE>().ok_or(FrameError::Truncated)?;
        if CRC.checksum(checked) != u32::from_le_bytes(*crc) {
            return Err(FrameError::Damaged);
        }
        let sequence = u16::from_le_bytes(*sequence);
        let packet = match postcard::take_from_bytes(message) {
            Ok((message, [])) => Ok(Packet { sequence, message }),
            // Bytes too many are as foreign as bytes too few.
            Ok(_) | Err(_) => Err(FrameError::Malformed { sequence }),
        };
        self.follow(sequence);
        packet
    }

    /// Counts the frames between the one expected and this one.
    fn follow(&mut self, sequence: u16) {
        let gap = self.expected.map_or(0, |expected| sequence.wrapping_sub(expected));
        if gap < 1 << 15 {
            self.counters.missing = self.counters.missing.saturating_add(u32::from(gap));
        }
        self.expected = Some(sequence.wrapping_add(1));
    }
}

impl Default for Decoder {
    fn default() -> Self {
        Self::new()
    }
}

/// Why a frame was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// The checksum is wrong.
    Damaged,
    /// The frame ended before its time: bytes were lost, or it was received from the middle on.
    Truncated,
    /// No delimiter within [`MAX_FRAME`] bytes. Reported then; what follows up to the delimiter is skipped.
    Oversize,
    /// Intact, but no message of the receiver's table.
    Malformed {
        /// Sequence number of the frame, so that it can be answered.
        sequence: u16,
    },
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Damaged => {
                write!(f, "a frame was damaged on the line (wrong CRC-32); if many are, check cable and baud rate")
            }
            Self::Truncated => {
                write!(f, "a frame was cut short; once after connecting is normal, if many are, bytes get lost")
            }
            Self::Oversize => {
                write!(
                    f,
                    "no end of frame within {MAX_FRAME} bytes; check the baud rate and that this is a flat device"
                )
            }
            Self::Malformed { sequence } => write!(
                f,
                "frame {sequence} is intact but not in the message table of protocol {PROTOCOL_VERSION}; \
                 build host and device from the same sources"
            ),
        }
    }
}

impl core::error::Error for FrameError {}
