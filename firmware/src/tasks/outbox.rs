//! Frames on their way from the simulation to the link.

use core::cell::RefCell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use flat_session::{Class, Ring, Sink};

use crate::board;

/// From `simulate` to `transmit`.
pub(super) static OUTBOX: Outbox = Outbox::new();

/// A ring of whole frames behind a lock that is held for one copy at a time, never over a step.
pub(super) struct Outbox {
    ring: Mutex<CriticalSectionRawMutex, RefCell<Ring<{ board::OUTBOX_BYTES }>>>,
    filled: Signal<CriticalSectionRawMutex, ()>,
}

impl Outbox {
    const fn new() -> Self {
        Self { ring: Mutex::new(RefCell::new(Ring::new())), filled: Signal::new() }
    }

    /// Takes some bytes out, at least one; waits for them.
    pub(super) async fn read(&self, out: &mut [u8]) -> usize {
        loop {
            let count = self.ring.lock(|ring| ring.borrow_mut().read(out));
            if count > 0 {
                return count;
            }
            self.filled.wait().await;
        }
    }
}

impl Sink for &Outbox {
    fn push(&mut self, class: Class, frame: &[u8]) -> bool {
        let taken = self.ring.lock(|ring| ring.borrow_mut().push(class, frame));
        self.filled.signal(());
        taken
    }
}
