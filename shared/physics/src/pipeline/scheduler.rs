//! From passing time to steps: exact sixtieths of a second, nothing discarded unless asked for.

use core::num::{NonZeroU8, NonZeroU32};

use crate::scalar::STEP_HZ;

/// One step in units of 1/60 us: 60 of them make a second's worth exactly, where a step of 16 667 us would drift by 20 ppm.
const STEP: u64 = 1_000_000;
const PER_US: u64 = STEP_HZ as u64;

/// How many steps may be run at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pace {
    /// Steps per update when all is well. Default 1; desktops may use 2.
    pub normal: NonZeroU8,
    /// Steps per update when more than 2.5 steps behind. Default 4.
    pub catch_up: NonZeroU8,
    /// Most steps that may be due at a time: time beyond that is discarded and counted, so that the game runs slow instead of
    /// catching up. Default none: nothing is discarded.
    pub limit: Option<NonZeroU32>,
}

impl Pace {
    /// 1 step, 4 when behind, nothing discarded.
    pub const DEFAULT: Self = Self { normal: NonZeroU8::MIN, catch_up: NonZeroU8::new(4).unwrap(), limit: None };
    /// 2 steps, 4 when behind, nothing discarded.
    pub const DESKTOP: Self = Self { normal: NonZeroU8::new(2).unwrap(), ..Self::DEFAULT };
}

impl Default for Pace {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Accumulates time and pays it out in steps. A step is 1/60 s and can't be made longer or shorter: all else would be another
/// simulation on every screen.
///
/// A game that draws 60 times a second runs one step a frame; at 120 frames a second, every other frame has none, and at 30 each
/// has two. That takes [`Pace::DESKTOP`]: with one step a frame, 30 frames a second fall behind and catch up in bursts of four.
/// Between steps, a body may be drawn at its position plus [`backlog_us`](Scheduler::backlog_us) of its velocity.
#[derive(Clone, Debug, Default)]
pub struct Scheduler {
    pace: Pace,
    /// Time not yet simulated, in 1/60 us.
    backlog: u64,
    /// Time that never will be, in 1/60 us.
    discarded: u64,
}

impl Scheduler {
    /// A scheduler with nothing due.
    pub const fn new(pace: Pace) -> Self {
        Self { pace, backlog: 0, discarded: 0 }
    }

    /// Notes that time has passed.
    pub fn elapse(&mut self, us: u64) {
        self.backlog = self.backlog.saturating_add(us.saturating_mul(PER_US));
        if let Some(limit) = self.pace.limit {
            let excess = self.backlog.saturating_sub(u64::from(limit.get()) * STEP);
            self.backlog -= excess;
            self.discarded = self.discarded.saturating_add(excess);
        }
    }

    /// Steps to run now; their time is taken off the backlog.
    pub fn take(&mut self) -> u8 {
        let limit = if self.backlog > STEP * 5 / 2 { self.pace.catch_up } else { self.pace.normal };
        let steps = (self.backlog / STEP).min(u64::from(limit.get()));
        self.backlog -= steps * STEP;
        steps as u8
    }

    /// Time that has passed but isn't simulated yet, us, rounded down.
    pub fn backlog_us(&self) -> u64 {
        self.backlog / PER_US
    }

    /// Time that was discarded at the [limit](Pace::limit), us, rounded down.
    pub fn discarded_us(&self) -> u64 {
        self.discarded / PER_US
    }

    /// How long until the next step is due, us; 0 = it is.
    pub fn until_due_us(&self) -> u64 {
        STEP.saturating_sub(self.backlog).div_ceil(PER_US)
    }
}
