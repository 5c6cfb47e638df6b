//! ESP32: Xtensa LX6 at 240 MHz, one of the two cores used. Frames on UART0, GPIO3 in and GPIO1 out.

use esp_backtrace::Backtrace;
use esp_hal::clock::CpuClock;
use esp_hal::timer::timg::TimerGroup;
use flat_session::Identity;
use flat_wire::message::{BACKTRACE, Counter};
use heapless::Vec;

use super::Capacity;
use super::esp::{self, link, machine};
use crate::stack;

// Less than on the ESP32-C3: 192 KiB of data memory are in one piece.
pub(crate) const OUTBOX_BYTES: usize = 8 * 1024;
pub(crate) const FIXED: Capacity = Capacity { bodies: 512, contacts: 1536 };
pub(crate) const F32: Capacity = Capacity { bodies: 128, contacts: 768 };
pub(crate) const F64: Capacity = Capacity { bodies: 8, contacts: 24 };

#[esp_hal::main]
fn main() -> ! {
    stack::paint();
    let clock = CpuClock::max();
    let chip = esp_hal::init(esp_hal::Config::default().with_cpu_clock(clock));
    // The timer is also embassy's time driver, in microseconds.
    esp_rtos::start(TimerGroup::new(chip.TIMG0).timer0, chip.FROM_CPU_INTR0);
    machine::start_watchdog(chip.TIMG1, chip.RTC_TIMER);
    let (receiver, transmitter) = link::open(chip.UART0, chip.GPIO3, chip.GPIO1);
    let identity =
        Identity { board: "esp32", build: crate::BUILD, clock_hz: clock as u32 * 1_000_000, counter: Counter::Cycles };
    let physics = esp::start_physics(chip.FROM_CPU_INTR1);
    let parts = crate::Parts { identity, counter: StageCounter, receiver, transmitter };
    esp::run_link(|link| crate::start(parts, physics, link))
}

/// Times stages in CPU cycles; wraps after 17.9 s.
pub(crate) struct StageCounter;

impl StageCounter {
    /// The count now; wraps.
    #[allow(clippy::unused_self, reason = "the same on every board")]
    pub(crate) fn count(&self) -> u32 {
        xtensa_lx::timer::get_cycle_count()
    }
}

/// The calls that led to the caller. Exceptions are panics of esp-hal's here, so that this is all there is.
pub(crate) fn backtrace() -> Vec<u32, BACKTRACE> {
    Backtrace::capture().frames().iter().take(BACKTRACE).map(|frame| frame.program_counter() as u32).collect()
}

/// The calls that led to an interrupt handler, after its own.
pub(crate) fn trail_of_interrupted() -> Vec<u32, BACKTRACE> {
    backtrace()
}

/// esp-hal's watchpoint on the stack's guard holds in interrupts as well.
pub(crate) fn watch_guard() {}

/// Runs into an instruction that no processor has.
#[cfg(feature = "provoke")]
pub(crate) fn illegal_instruction() -> ! {
    // SAFETY: ends in esp-hal's exception handler, which doesn't return.
    unsafe { core::arch::asm!("ill", options(noreturn)) }
}
