//! Frames on their way to the link: the simulation's, and those of tasks that it may interrupt.

use core::cell::RefCell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use flat_session::{Class, Ring, Sink, encode};
use flat_wire::MAX_FRAME;
use flat_wire::message::Event;

use crate::board;

/// From all tasks to `transmit`.
pub(crate) static OUTBOX: Outbox = Outbox::new();

/// A ring of whole frames behind a lock that is held for one copy at a time, never over a step.
pub(crate) struct Outbox {
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

    /// Encodes an event and takes it, or returns false if there is no room. For tasks below the simulation, which may
    /// number a frame of its own meanwhile: then this one is encoded again, with the next number.
    pub(crate) fn offer(&self, class: Class, event: &Event, buffer: &mut [u8; MAX_FRAME]) -> bool {
        loop {
            let sequence = self.next_sequence();
            // Every event of the table fits a frame, which flat-wire's tests prove.
            let Ok(frame) = encode(sequence, event, buffer) else {
                return false;
            };
            let taken = self.ring.lock(|ring| {
                let mut ring = ring.borrow_mut();
                (ring.sequence() == sequence).then(|| ring.push(class, frame))
            });
            if let Some(taken) = taken {
                self.filled.signal(());
                return taken;
            }
        }
    }

    /// Number of the next frame; 0 for who asks while a frame is being taken, which only a fault can.
    pub(crate) fn next_sequence(&self) -> u16 {
        self.ring.lock(|ring| ring.try_borrow().map_or(0, |ring| ring.sequence()))
    }
}

impl Sink for &Outbox {
    fn sequence(&self) -> u16 {
        self.next_sequence()
    }

    fn push(&mut self, class: Class, frame: &[u8]) -> bool {
        let taken = self.ring.lock(|ring| ring.borrow_mut().push(class, frame));
        self.filled.signal(());
        taken
    }

    fn skip(&mut self) {
        self.ring.lock(|ring| ring.borrow_mut().skip());
    }
}
