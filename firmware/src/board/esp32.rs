//! ESP32: Xtensa LX6 at 240 MHz, one of the two cores used. Frames on UART0, GPIO3 in and GPIO1 out.

use esp_backtrace::Backtrace;
use flat_wire::message::BACKTRACE;
use heapless::Vec;

use super::{Capacity, Room};

pub(crate) const NAME: &str = "esp32";

// Less than on the ESP32-C3: 192 KiB of data memory are in one piece.
pub(crate) const OUTBOX_BYTES: usize = 8 * 1024;
pub(crate) const ROOM: Room =
    Room { fixed: Capacity { bodies: 512, contacts: 1536 }, f32: Capacity { bodies: 128, contacts: 768 } };

/// Times stages in CPU cycles; wraps after 17.9 s.
pub(crate) struct StageCounter(());

impl StageCounter {
    /// It counts from reset.
    pub(crate) fn start() -> Self {
        Self(())
    }

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
