//! Frames to serial bytes.

use embedded_io_async::Write as _;
use flat_wire::MAX_FRAME;

use super::outbox::OUTBOX;
use crate::board::Transmitter;
use crate::fault;

/// Bytes handed to the port at once: the lock on the outbox lasts for a copy of so many.
const CHUNK: usize = 64;

/// Ends whatever the boot loader said, so that the first frame stands on its own.
const DELIMITER: [u8; 1] = [0];

/// Sends what the device's former life has left to say, then drains the outbox for ever.
#[embassy_executor::task]
pub(crate) async fn transmit(mut serial: Transmitter) -> ! {
    // A port that fails to send has cost a frame: the host sees the gap in the sequence numbers.
    let _ = serial.write_all(&DELIMITER).await;
    let mut buffer = [0; MAX_FRAME];
    let _ = serial.write_all(fault::last_words(&mut buffer)).await;
    let chunk = &mut buffer[..CHUNK];
    loop {
        let count = OUTBOX.read(chunk).await;
        let _ = serial.write_all(&chunk[..count]).await;
    }
}
