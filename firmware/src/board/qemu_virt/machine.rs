//! The machine around the program: its one stack, its code, what it remembers over a restart.

use core::ops::Range;

use flat_wire::message::Cause;
use riscv::register::{Permission, Range as Match, pmpaddr0, pmpcfg0};

use super::register::Register;
pub(crate) use super::uart::send_blocking;
use crate::kept::Kept;

unsafe extern "C" {
    static __estack: u32;
    static __sstack: u32;
    static __stext: u32;
    static __etext: u32;
    /// See `memory/qemu_virt.x`.
    static _kept: u32;
}

// SAFETY: the `virt` machine's test device.
const FINISHER: Register<u32> = unsafe { Register::at(0x0010_0000) };
/// Resets the machine; RAM that the image doesn't load stays as it is.
const RESET: u32 = 0x7777;

/// Bytes of the stack that count as its guard: once QEMU 7.2 has reset the machine with the guard's word locked, writes to the
/// rest of its page fail as well.
pub(crate) const GUARD: usize = 4096;

/// Bytes below the stack's guard, for what reports that the stack is full.
pub(crate) const fn reserve() -> usize {
    4096
}

/// From the guard, words that nobody may write to, to the base.
pub(crate) fn stack() -> Range<usize> {
    (&raw const __estack).addr() + reserve()..(&raw const __sstack).addr()
}

/// The guard is in force in interrupts as well.
pub(crate) fn watch_guard() {}

/// Whether there is code at an address.
pub(crate) fn is_code(address: usize) -> bool {
    ((&raw const __stext).addr()..(&raw const __etext).addr()).contains(&address)
}

/// Makes a write to the stack's guard an exception.
pub(super) fn guard_stack() {
    // Wide enough that no frame steps over it without writing to it; a power of two, and the stack's end is aligned to more.
    const WIDTH: usize = 256;
    // SAFETY: entry 0 of the physical memory protection is otherwise unused, and no code writes to those words.
    unsafe {
        pmpaddr0::write(stack().start >> 2 | (WIDTH / 8 - 1));
        pmpcfg0::set_pmp(0, Match::NAPOT, Permission::R, true);
    }
}

/// What a restart leaves alone.
pub(crate) fn kept() -> Kept {
    // SAFETY: the linker script reserves this for that.
    unsafe { Kept::at((&raw const _kept).cast_mut()) }
}

/// Starts the machine anew.
pub(crate) fn restart() -> ! {
    FINISHER.write(RESET);
    loop {
        riscv::asm::wfi();
    }
}

/// Why the machine started, as far as it knows.
pub(crate) fn cause() -> Cause {
    Cause::PowerOn
}
