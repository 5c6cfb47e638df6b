//! Serial bytes to commands.

use embedded_io_async::Read;
use flat_session::LinkCounters;
use flat_wire::message::Command;
use flat_wire::{Decoder, FrameError};

use super::arrivals::{ARRIVALS, Arrival};
use crate::board::Receiver;
use crate::stack;

/// Bytes taken from the port at once.
const CHUNK: usize = 64;

/// Decodes whatever comes in; damaged frames are counted, and the counts travel with the next intact one.
#[embassy_executor::task]
pub(crate) async fn receive(mut serial: Receiver) -> ! {
    let mut decoder = Decoder::new();
    let mut chunk = [0; CHUNK];
    loop {
        // A line error (noise, overrun) has cost bytes: the decoder will miss them, count the damage and resync.
        let count = Read::read(&mut serial, &mut chunk).await.unwrap_or(0);
        for &byte in &chunk[..count] {
            let (sequence, command) = match decoder.push(byte) {
                Some(Ok(packet)) => (packet.sequence, Some(packet.message)),
                Some(Err(FrameError::Malformed { sequence })) => (sequence, None),
                Some(Err(_)) | None => continue,
            };
            let counters = decoder.counters();
            let link = LinkCounters { received: counters.received, damaged: counters.damaged };
            // Here, since it takes its time, and physics may interrupt it.
            let stack = matches!(command, Some(Command::Status)).then(stack::measure);
            #[cfg(feature = "provoke")]
            if let Some(Command::Provoke(mishap)) = command {
                crate::provoke::on_link(mishap);
            }
            ARRIVALS.send(Arrival { sequence, command, link, stack }).await;
        }
    }
}
