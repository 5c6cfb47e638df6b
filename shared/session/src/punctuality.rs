//! When steps ran, and when they should have.

use flat_physics::scalar::STEP_HZ;
use flat_wire::message::Frame;

/// A step's time, us, and the sixtieths of a microsecond over it: a step isn't a whole number of them.
const STEP_US: u64 = 1_000_000 / STEP_HZ as u64;
const STEP_REST: u32 = 1_000_000 % STEP_HZ;

/// Compares when the steps of a run took place with when they were due: the n-th, n steps' time after the run began.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Punctuality {
    /// When the next step is due, us, rounded down.
    due_us: u64,
    /// The rest, in 1/[`STEP_HZ`] us.
    due_rest: u32,
    began_us: u64,
    /// The latest step.
    step: Timing,
    /// The worst so far.
    worst: Timing,
    overruns: u32,
}

/// A step's times, us.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Timing {
    /// From when it was due to its beginning.
    pub(crate) late_us: u32,
    /// From its beginning to its end.
    pub(crate) took_us: u32,
}

impl Punctuality {
    /// A run begins.
    pub(crate) fn new(now_us: u64) -> Self {
        let mut punctuality = Self { due_us: now_us, ..Self::default() };
        punctuality.plan();
        punctuality
    }

    /// A step begins.
    pub(crate) fn begin(&mut self, now_us: u64) {
        self.began_us = now_us;
        self.step.late_us = saturated(now_us.saturating_sub(self.due()));
        self.plan();
    }

    /// It has ended.
    pub(crate) fn end(&mut self, now_us: u64) {
        self.step.took_us = saturated(now_us.saturating_sub(self.began_us));
        self.worst.late_us = self.worst.late_us.max(self.step.late_us);
        self.worst.took_us = self.worst.took_us.max(self.step.took_us);
        if now_us > self.due() {
            self.overruns = self.overruns.saturating_add(1);
        }
    }

    /// The largest times so far.
    pub(crate) fn worst(&self) -> Timing {
        self.worst
    }

    /// Steps that ended after the next one was due.
    pub(crate) fn overruns(&self) -> u32 {
        self.overruns
    }

    /// What the host is told of the latest step.
    pub(crate) fn frame(&self, step: u32) -> Frame {
        let Timing { late_us, took_us } = self.step;
        Frame::Timing { step, late_us, took_us, overruns: self.overruns }
    }

    /// The first microsecond at which the next step is due.
    fn due(&self) -> u64 {
        self.due_us + u64::from(self.due_rest > 0)
    }

    /// Moves on to the next step.
    fn plan(&mut self) {
        self.due_us += STEP_US;
        self.due_rest += STEP_REST;
        if self.due_rest >= STEP_HZ {
            (self.due_us, self.due_rest) = (self.due_us + 1, self.due_rest - STEP_HZ);
        }
    }
}

fn saturated(us: u64) -> u32 {
    u32::try_from(us).unwrap_or(u32::MAX)
}
