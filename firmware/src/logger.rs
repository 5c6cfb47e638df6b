//! Where `defmt` writes to: log messages, still encoded, wait here for the link.
//!
//! Writing never waits. A message takes a critical section for as long as it takes to encode, a few us: that is all that it can
//! delay a step by.

use core::cell::UnsafeCell;

use critical_section::RestoreState;
use defmt::Encoder;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use flat_session::Logs;
use flat_wire::message::Frame;

/// Bytes that may wait: some hundred messages.
const WAITING: usize = 2048;

defmt::timestamp!("{=u64:us}", embassy_time::Instant::now().as_micros());

#[defmt::global_logger]
struct Logger;

static STATE: State = State(UnsafeCell::new(Inner {
    restore: RestoreState::invalid(),
    is_taken: false,
    encoder: Encoder::new(),
    logs: Logs::new(),
}));
static FILLED: Signal<CriticalSectionRawMutex, ()> = Signal::new();

/// What is only touched inside a critical section.
struct State(UnsafeCell<Inner>);

struct Inner {
    /// How the critical section of the message under way is to end.
    restore: RestoreState,
    is_taken: bool,
    encoder: Encoder,
    logs: Logs<WAITING>,
}

// SAFETY: every access is inside a critical section: `next` opens one for each, and `Logger` holds one from `acquire` to
// `release`, which defmt calls around everything else.
unsafe impl Sync for State {}

impl State {
    /// # Safety
    ///
    /// Inside a critical section, and no other reference may be alive.
    #[allow(clippy::mut_from_ref, reason = "the caller promises that it is the only one")]
    unsafe fn inner(&self) -> &mut Inner {
        // SAFETY: promised by the caller.
        unsafe { &mut *self.0.get() }
    }
}

/// The next frame of log messages; waits for one.
pub(crate) async fn next() -> Frame {
    loop {
        // SAFETY: in a critical section, and a message under way holds one too, so none is.
        let frame = critical_section::with(|_| unsafe { STATE.inner() }.logs.take());
        if let Some(frame) = frame {
            return frame;
        }
        FILLED.wait().await;
    }
}

// SAFETY: `acquire` opens a critical section that `release` closes, so that no other context can write in between; a second
// `acquire` of the same context, from within a message's own formatting, panics as defmt asks.
unsafe impl defmt::Logger for Logger {
    fn acquire() {
        // SAFETY: `release` releases it.
        let restore = unsafe { critical_section::acquire() };
        // SAFETY: in a critical section.
        let inner = unsafe { STATE.inner() };
        assert!(!inner.is_taken, "a log message was written while another one was being formatted");
        (inner.is_taken, inner.restore) = (true, restore);
        inner.logs.begin();
        let Inner { encoder, logs, .. } = inner;
        encoder.start_frame(|bytes| logs.append(bytes));
    }

    unsafe fn flush() {
        // The link empties the ring by itself.
    }

    unsafe fn release() {
        // SAFETY: in the critical section that `acquire` opened.
        let inner = unsafe { STATE.inner() };
        let Inner { encoder, logs, .. } = inner;
        encoder.end_frame(|bytes| logs.append(bytes));
        logs.end();
        inner.is_taken = false;
        let restore = inner.restore;
        FILLED.signal(());
        // SAFETY: the state that `acquire` was given.
        unsafe { critical_section::release(restore) };
    }

    unsafe fn write(bytes: &[u8]) {
        // SAFETY: in the critical section that `acquire` opened.
        let Inner { encoder, logs, .. } = unsafe { STATE.inner() };
        encoder.write(bytes, |bytes| logs.append(bytes));
    }
}
