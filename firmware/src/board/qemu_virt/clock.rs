//! Time driver on the CLINT: one counter, one comparator.

use core::cell::RefCell;
use core::task::Waker;

use critical_section::{CriticalSection, Mutex};
use embassy_time_driver::Driver;
use embassy_time_queue_utils::Queue;
use riscv::interrupt::Interrupt;
use riscv::register::mie;

use super::register::Register;
use crate::{board, fault, watchdog};

/// Counts of `mtime` in a microsecond: it runs at 10 MHz.
const COUNTS_PER_US: u64 = 10;

// SAFETY: the `virt` machine's CLINT, hart 0; 64-bit registers as two words each, low word first.
const MTIMECMP: [Register<u32>; 2] = unsafe { [Register::at(0x0200_4000), Register::at(0x0200_4004)] };
// SAFETY: as above.
const MTIME: [Register<u32>; 2] = unsafe { [Register::at(0x0200_BFF8), Register::at(0x0200_BFFC)] };

struct Clock {
    queue: Mutex<RefCell<Queue>>,
}

embassy_time_driver::time_driver_impl!(static CLOCK: Clock = Clock { queue: Mutex::new(RefCell::new(Queue::new())) });

impl Driver for Clock {
    fn now(&self) -> u64 {
        now_us()
    }

    fn schedule_wake(&self, at: u64, waker: &Waker) {
        critical_section::with(|cs| {
            if self.queue.borrow_ref_mut(cs).schedule_wake(at, waker) {
                self.rearm(cs);
            }
        });
    }
}

impl Clock {
    /// Wakes what is due and sets the comparator to what comes next.
    fn rearm(&self, cs: CriticalSection<'_>) {
        let now_us = now_us();
        let due_us = self.queue.borrow_ref_mut(cs).next_expiration(now_us);
        let watch_us = if watchdog::is_needed() { now_us + watchdog::PERIOD.as_micros() } else { u64::MAX };
        match due_us.min(watch_us) {
            // Masked, not set to the end of time: an idle QEMU with `-icount sleep=off` goes to the next alarm at once.
            u64::MAX => mie_timer(false),
            at_us => {
                set_alarm(at_us.saturating_mul(COUNTS_PER_US));
                mie_timer(true);
            }
        }
    }
}

#[riscv_rt::core_interrupt(Interrupt::MachineTimer)]
fn on_alarm() {
    if let Some(work) = watchdog::overdue() {
        fault::hangs(work, board::trail_of_interrupted());
    }
    critical_section::with(|cs| CLOCK.rearm(cs));
}

/// Lets the watchdog look after work that begins now.
pub(super) fn watch() {
    critical_section::with(|cs| CLOCK.rearm(cs));
}

fn now_us() -> u64 {
    counts() / COUNTS_PER_US
}

/// The counter, read until no carry went from the low to the high word in between.
fn counts() -> u64 {
    loop {
        let high = MTIME[1].read();
        let low = MTIME[0].read();
        if MTIME[1].read() == high {
            return u64::from(high) << 32 | u64::from(low);
        }
    }
}

/// Sets the comparator, never to the past: only a write to the future takes back what QEMU made of a half-written value.
fn set_alarm(at: u64) {
    let at = at.max(counts() + COUNTS_PER_US);
    MTIMECMP[1].write(u32::MAX);
    MTIMECMP[0].write(at as u32);
    MTIMECMP[1].write((at >> 32) as u32);
}

/// Lets the comparator interrupt, or not.
fn mie_timer(on: bool) {
    if on {
        // SAFETY: `on_alarm` is linked in.
        unsafe { mie::set_mtimer() };
    } else {
        // SAFETY: nobody waits for an alarm.
        unsafe { mie::clear_mtimer() };
    }
}
