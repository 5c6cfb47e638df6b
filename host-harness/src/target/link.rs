//! A byte link to a device: two threads pump bytes, so neither a send nor a receive can block for long.

use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

use crate::error::Error;
use crate::interrupt;

/// What keeps a link open; dropping it closes the link and everything that was started for it.
pub trait Peer: Send {
    /// How the other end came to its end.
    fn obituary(&mut self) -> String;

    /// Resets a device that doesn't answer, if that may be done from here; true if it was done.
    fn reset(&mut self) -> bool {
        false
    }
}

/// An open link.
pub struct Link {
    outgoing: Sender<Vec<u8>>,
    incoming: Receiver<Vec<u8>>,
    peer: Box<dyn Peer>,
    image: Option<PathBuf>,
    is_open: bool,
    throttle: Arc<Throttle>,
}

/// How a link's bytes are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// As fast as they come.
    Fast,
    /// At most so many a millisecond.
    PerMillisecond(usize),
    /// Not at all.
    Paused,
}

/// Bytes that the reading thread takes each millisecond; as many as there are at [`usize::MAX`].
struct Throttle(AtomicUsize);

impl Throttle {
    fn fast() -> Arc<Self> {
        Arc::new(Self(AtomicUsize::new(usize::MAX)))
    }

    /// Waits as it must, and says how many bytes to read now.
    fn wait(&self) -> usize {
        loop {
            match self.0.load(Ordering::Relaxed) {
                usize::MAX => return usize::MAX,
                bytes => {
                    thread::sleep(Duration::from_millis(1));
                    if bytes > 0 {
                        return bytes;
                    }
                }
            }
        }
    }
}

impl Link {
    /// A link over two channels that somebody else serves.
    pub fn over_channels(outgoing: Sender<Vec<u8>>, incoming: Receiver<Vec<u8>>, peer: Box<dyn Peer>) -> Self {
        Self { outgoing, incoming, peer, image: None, is_open: true, throttle: Throttle::fast() }
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
        let throttle = Throttle::fast();
        let shared = Arc::clone(&throttle);
        thread::spawn(move || pump_in(from, &read, &shared));
        Self { outgoing, incoming, peer, image: None, is_open: true, throttle }
    }

    /// Says which image the other end runs.
    pub fn with_image(self, image: Option<PathBuf>) -> Self {
        Self { image, ..self }
    }

    /// The image that the other end runs, if that is known.
    pub fn image(&self) -> Option<&Path> {
        self.image.as_deref()
    }

    /// Says how bytes are read from now on, where a thread of this link reads them.
    pub fn set_reading(&mut self, reading: Reading) {
        let bytes = match reading {
            Reading::Fast => usize::MAX,
            Reading::PerMillisecond(bytes) => bytes,
            Reading::Paused => 0,
        };
        self.throttle.0.store(bytes, Ordering::Relaxed);
    }

    /// Sends bytes.
    ///
    /// # Errors
    /// If the other end has gone.
    pub fn send(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.outgoing.send(bytes.to_vec()).map_err(|_| self.ended())
    }

    /// Resets a device that doesn't answer, if that may be done from here; true if it was done.
    pub fn reset(&mut self) -> bool {
        self.peer.reset()
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

    /// Whether the other end was there when last looked at.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    fn ended(&mut self) -> Error {
        self.is_open = false;
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

fn pump_in(mut from: impl Read, bytes: &Sender<Vec<u8>>, throttle: &Throttle) {
    let mut buffer = [0; 4096];
    loop {
        let most = throttle.wait().min(buffer.len());
        let count = match from.read(&mut buffer[..most]) {
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
