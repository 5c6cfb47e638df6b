//! Frames to serial bytes.

use embedded_io_async::Write as _;

use super::outbox::OUTBOX;
use crate::board::Transmitter;

/// Bytes handed to the port at once: the lock on the outbox lasts for a copy of so many.
const CHUNK: usize = 64;

/// Ends whatever the boot loader said, so that the first frame stands on its own.
const DELIMITER: [u8; 1] = [0];

/// Drains the outbox for ever.
#[embassy_executor::task]
pub(crate) async fn transmit(mut serial: Transmitter) -> ! {
    let mut chunk = [0; CHUNK];
    let mut next = &DELIMITER[..];
    loop {
        // A port that fails to send has cost a frame: the host sees the gap in the sequence numbers.
        let _ = serial.write_all(next).await;
        let count = OUTBOX.read(&mut chunk).await;
        next = &chunk[..count];
    }
}
