//! ESP32-C3: rv32imc at 160 MHz, no floating-point unit. Frames on UART0, GPIO20 in and GPIO21 out, or on the chip's own USB.

use core::arch::asm;

use super::esp::machine;
use super::{Capacity, Room};

pub(crate) const NAME: &str = "esp32c3";

// What 313 KiB of RAM hold beside the code that runs from it and a stack, of which 8 KiB were ever used; binary32 has the 64 KiB that
// the boot loader leaves.
pub(crate) const OUTBOX_BYTES: usize = 12 * 1024;
pub(crate) const ROOM: Room =
    Room { fixed: Capacity { bodies: 1024, contacts: 2560 }, f32: Capacity { bodies: 256, contacts: 1280 } };

/// Times stages in CPU cycles, by the chip's performance counter; wraps after 26.8 s.
pub(crate) struct StageCounter(());

impl StageCounter {
    pub(crate) fn start() -> Self {
        // SAFETY: mpcer = 1 selects cycles and mpcmr = 1 enables the counter; nothing else uses it.
        unsafe { asm!("csrwi 0x7e0, 1", "csrwi 0x7e1, 1", options(nomem, nostack)) };
        Self(())
    }

    /// The count now; wraps.
    #[allow(clippy::unused_self, reason = "the same on every board")]
    pub(crate) fn count(&self) -> u32 {
        let cycles;
        // SAFETY: reads mpccr and does nothing.
        unsafe { asm!("csrr {}, 0x7e2", out(reg) cycles, options(nomem, nostack)) };
        cycles
    }
}

unsafe extern "C" {
    /// See `memory/esp.x`.
    static _flash_code_start: u32;
    static _flash_code_end: u32;
    static _trap_section_origin: u32;
    static _rwtext_end: u32;
    static _stack_end_cpu0: u32;
}

/// Bytes below the stack's guard, for what reports that the stack is full.
pub(crate) fn reserve() -> usize {
    machine::stack().start - (&raw const _stack_end_cpu0).addr()
}

/// Watches the stack's guard in this interrupt handler too: entering one switches that off.
pub(crate) fn watch_guard() {
    // SAFETY: sets tcontrol.mte, which lets esp-hal's watchpoint on the guard raise an exception in machine mode.
    unsafe { asm!("csrsi 0x7a5, 1 << 3", options(nomem, nostack)) };
}

/// Whether there is code at an address, in flash or in RAM.
pub(crate) fn is_code(address: usize) -> bool {
    let flash = (&raw const _flash_code_start).addr()..(&raw const _flash_code_end).addr();
    let ram = (&raw const _trap_section_origin).addr()..(&raw const _rwtext_end).addr();
    flash.contains(&address) || ram.contains(&address)
}
