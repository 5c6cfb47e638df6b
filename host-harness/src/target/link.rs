//! A byte link to a device: two threads pump bytes, so neither a send nor a receive can block for long.

use std::io::{ErrorKind, Read, Write};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Instant;

use crate::error::Error;
use crate::interrupt;

/// What keeps a link open; dropping it closes the link and everything that was started for it.
pub trait Peer: Send {
    /// How the other end came to its end.
    fn obituary(&mut self) -> String;
}

/// An open link.
pub struct Link {
    outgoing: Sender<Vec<u8>>,
    incoming: Receiver<Vec<u8>>,
    peer: Box<dyn Peer>,
}

impl Link {
    /// A link over two channels that somebody else serves.
    pub fn over_channels(outgoing: Sender<Vec<u8>>, incoming: Receiver<Vec<u8>>, peer: Box<dyn Peer>) -> Self {
        Self { outgoing, incoming, peer }
    }

    /// A link over a pair of blocking streams.
    pub fn over_streams(
        from: impl Read + Send + 'static,
        to: impl Write + Send + 'static,
        peer: Box<dyn Peer>,
    ) -> Self {
        let (outgoing, to_write) = mpsc::channel();
        let (read, incoming) = mpsc::channel();
        thread::spawn(move || pump_out(to, &to_write));
        thread::spawn(move || pump_in(from, &read));
        Self { outgoing, incoming, peer }
    }

    /// Sends bytes.
    ///
    /// # Errors
    /// If the other end has gone.
    pub fn send(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.outgoing.send(bytes.to_vec()).map_err(|_| self.ended())
    }

    /// Receives whatever comes first, or nothing if nothing came by the deadline.
    ///
    /// # Errors
    /// If the other end has gone, or on Ctrl-C.
    pub fn receive(&mut self, deadline: Instant) -> Result<Vec<u8>, Error> {
        loop {
            interrupt::check()?;
            let left = deadline.saturating_duration_since(Instant::now());
            match self.incoming.recv_timeout(left.min(interrupt::POLL)) {
                Ok(bytes) if bytes.is_empty() => {}
                Ok(bytes) => return Ok(bytes),
                Err(RecvTimeoutError::Disconnected) => return Err(self.ended()),
                Err(RecvTimeoutError::Timeout) if left.is_zero() => return Ok(Vec::new()),
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }

    fn ended(&mut self) -> Error {
        Error::target(self.peer.obituary(), "look at what the target itself says, reset it, and run this again")
    }
}

fn pump_out(mut to: impl Write, bytes: &Receiver<Vec<u8>>) {
    for chunk in bytes {
        if to.write_all(&chunk).and_then(|()| to.flush()).is_err() {
            return;
        }
    }
}

fn pump_in(mut from: impl Read, bytes: &Sender<Vec<u8>>) {
    let mut buffer = [0; 4096];
    loop {
        let count = match from.read(&mut buffer) {
            Ok(0) => return,
            Ok(count) => count,
            // A port that reads with a time-out: the empty chunk finds out whether anybody still listens.
            Err(error) if matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock) => 0,
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(_) => return,
        };
        if bytes.send(buffer[..count].to_vec()).is_err() {
            return;
        }
    }
}
