//! What a frame is made of, and how a message becomes one.

use core::fmt;

use crc::{CRC_32_ISO_HDLC, Crc};
use postcard::ser_flavors::{Cobs, Slice, crc::CrcModifier};
use serde::Serialize;

/// Longest frame on the line in bytes, delimiter included.
///
/// Every message of the table fits, whatever its values. Longer frames would cost both sides buffers and lose
/// more to each damaged byte.
pub const MAX_FRAME: usize = 512;

/// Longest message in postcard bytes that fits a frame whatever its content.
///
/// COBS spends a byte at the front and at most one more for every 254.
pub const MAX_MESSAGE: usize = MAX_FRAME - DELIMITER - (1 + MAX_FRAME / 254) - SEQUENCE - CHECKSUM;

/// Bytes of the sequence number.
pub(crate) const SEQUENCE: usize = size_of::<u16>();
/// Bytes of the checksum.
pub(crate) const CHECKSUM: usize = size_of::<u32>();
/// Bytes of the delimiter, a zero.
pub(crate) const DELIMITER: usize = 1;

/// The checksum of Ethernet and zip, by a table of 256 words.
pub(crate) static CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// Writes `message` to the front of `out` as one frame, delimiter included, and returns it.
///
/// `sequence` is the sender's count of frames; it wraps. The message is encoded straight into `out`, with no
/// other buffer in between.
///
/// # Errors
///
/// When the frame would be longer than [`MAX_FRAME`]. No message of the table is.
pub fn encode<'a, T: Serialize>(
    sequence: u16,
    message: &T,
    out: &'a mut [u8; MAX_FRAME],
) -> Result<&'a [u8], EncodeError> {
    let cobs = Cobs::try_new(Slice::new(out)).map_err(EncodeError)?;
    let checked = CrcModifier::new(cobs, CRC.digest());
    // An array of bytes, unlike the number, has the same length whatever its value.
    postcard::serialize_with_flavor(&(sequence.to_le_bytes(), message), checked)
        .map(|frame| &*frame)
        .map_err(EncodeError)
}

/// A message that can't be sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EncodeError(postcard::Error);

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "the message doesn't fit a frame of {MAX_FRAME} bytes, split it over several: {}", self.0)
    }
}

impl core::error::Error for EncodeError {}
