//! Stage times in retired instructions.

use core::arch::asm;

use flat_wire::message::Counter;
use riscv::register::minstret;

/// Instructions between the two readings of a calibration, the second reading included.
const SAMPLE: u64 = 16;
/// Calibrations that must agree.
const SAMPLES: usize = 4;
/// QEMU's largest `-icount shift`.
const MAX_SHIFT: u32 = 10;

/// Reads `minstret`, whose unit is QEMU's choice: with `-icount shift=N` some versions count an instruction as `1 << N`
/// (its nanoseconds), others as 1; without `-icount` it holds ticks of the host, which tell nothing.
pub(crate) struct StageCounter {
    /// Instructions to counts; none = the counts aren't instructions.
    shift: Option<u32>,
}

impl StageCounter {
    /// Measures what the counter counts.
    pub(super) fn calibrate() -> Self {
        let first = sample();
        let steady = (1..SAMPLES).all(|_| sample() == first);
        Self { shift: (0..=MAX_SHIFT).find(|shift| steady && SAMPLE << shift == first) }
    }

    /// The count now; wraps.
    pub(crate) fn count(&self) -> u32 {
        // All 64 bits, so that what is left of them after the shift wraps at 2^32.
        self.shift.map_or(0, |shift| (minstret::read64() >> shift) as u32)
    }

    /// What `count` counts.
    pub(super) fn counter(&self) -> Counter {
        match self.shift {
            Some(_) => Counter::Instructions,
            None => Counter::None,
        }
    }
}

/// Counts between two readings that lie `SAMPLE` instructions apart.
fn sample() -> u64 {
    let (before, after): (u32, u32);
    // SAFETY: reads a counter and does nothing; `.rept` is one less than `SAMPLE`.
    unsafe {
        asm!(
            ".option push",
            ".option norvc",
            "csrr {before}, minstret",
            ".rept 15",
            "nop",
            ".endr",
            "csrr {after}, minstret",
            ".option pop",
            before = out(reg) before,
            after = out(reg) after,
            options(nomem, nostack, preserves_flags),
        );
    }
    u64::from(after.wrapping_sub(before))
}
