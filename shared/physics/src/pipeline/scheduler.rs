//! From passing time to steps: exact sixtieths of a second, nothing discarded.

use crate::scalar::STEP_HZ;

/// One step in units of 1/60 us: 60 of them make a second's worth exactly, where a step of 16 667 us would drift by 20 ppm.
const STEP: u64 = 1_000_000;
const PER_US: u64 = STEP_HZ as u64;

/// How many steps may be run at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pace {
    /// Steps per update when all is well. Default 1; desktops may use 2.
    pub normal: u8,
    /// Steps per update when more than 2.5 steps behind. Default 4.
    pub catch_up: u8,
}

impl Pace {
    /// 1 step, 4 when behind.
    pub const DEFAULT: Self = Self { normal: 1, catch_up: 4 };
}

impl Default for Pace {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Accumulates time and pays it out in steps.
#[derive(Clone, Debug, Default)]
pub struct Scheduler {
    pace: Pace,
    /// Time not yet simulated, in 1/60 us.
    backlog: u64,
}

impl Scheduler {
    /// A scheduler with nothing due.
    pub const fn new(pace: Pace) -> Self {
        Self { pace, backlog: 0 }
    }

    /// Notes that time has passed.
    pub fn elapse(&mut self, us: u64) {
        self.backlog = self.backlog.saturating_add(us.saturating_mul(PER_US));
    }

    /// Steps to run now; their time is taken off the backlog.
    pub fn take(&mut self) -> u8 {
        let limit = if self.backlog > STEP * 5 / 2 { self.pace.catch_up } else { self.pace.normal };
        let steps = (self.backlog / STEP).min(u64::from(limit));
        self.backlog -= steps * STEP;
        steps as u8
    }

    /// Time that has passed but isn't simulated yet, us, rounded down.
    pub fn backlog_us(&self) -> u64 {
        self.backlog / PER_US
    }

    /// How long until the next step is due, us; 0 = it is.
    pub fn until_due_us(&self) -> u64 {
        STEP.saturating_sub(self.backlog).div_ceil(PER_US)
    }
}
