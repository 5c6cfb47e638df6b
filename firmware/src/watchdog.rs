//! Notices work that doesn't end: a task that hangs takes its whole executor with it.
//!
//! Work says when it begins and ends; the board's timer asks [`overdue`] from an interrupt above all tasks, at least every
//! [`PERIOD`] while something is under way. Where the chip has a watchdog in hardware, that timer feeds it: it resets a
//! device whose interrupts are off for good.

use core::sync::atomic::{AtomicU32, Ordering};

use embassy_time::{Duration, Instant};

/// How long work may take. The longest honest piece is a tick: four steps and their frames.
const LIMIT: Duration = Duration::from_secs(3);

/// How often to ask.
pub(crate) const PERIOD: Duration = Duration::from_millis(500);

/// The executor for physics.
pub(crate) static PHYSICS: Work = Work::new("physics");
/// The executor for the link.
pub(crate) static LINK: Work = Work::new("the link");

/// What an executor has under way.
pub(crate) struct Work {
    /// Whose, for people.
    pub(crate) name: &'static str,
    /// When it began, in 1.024 ms; 0 = nothing is under way.
    since: AtomicU32,
}

impl Work {
    const fn new(name: &'static str) -> Self {
        Self { name, since: AtomicU32::new(0) }
    }

    /// Work begins.
    pub(crate) fn begin(&self) {
        self.since.store(now().max(1), Ordering::Relaxed);
    }

    /// It has ended.
    pub(crate) fn end(&self) {
        self.since.store(0, Ordering::Relaxed);
    }

    fn is_overdue(&self) -> bool {
        let since = self.since.load(Ordering::Relaxed);
        since != 0 && now().wrapping_sub(since) > (LIMIT.as_micros() >> 10) as u32
    }
}

/// Whether anything is under way.
#[cfg(feature = "qemu_virt")]
pub(crate) fn is_needed() -> bool {
    [&PHYSICS, &LINK].iter().any(|work| work.since.load(Ordering::Relaxed) != 0)
}

/// Work that should have ended long ago.
pub(crate) fn overdue() -> Option<&'static Work> {
    [&PHYSICS, &LINK].into_iter().find(|work| work.is_overdue())
}

/// Device time in 1.024 ms; wraps after 50 days.
fn now() -> u32 {
    (Instant::now().as_micros() >> 10) as u32
}
