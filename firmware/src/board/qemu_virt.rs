//! QEMU's `virt` machine with an rv32imc core: the board that anybody has, and that CI runs.
//!
//! ```text
//! qemu-system-riscv32 -M virt -cpu lowrisc-ibex -m 16M -smp 1 -bios none -display none -monitor none \
//!   -serial stdio -icount shift=3,sleep=off -kernel flat-firmware
//! ```

mod clock;
mod executor;
pub(crate) mod machine;
mod register;
mod stage_counter;
mod uart;

use flat_session::Identity;

use super::{Capacity, Room};
use crate::{Parts, stack};
pub(crate) use stage_counter::StageCounter;
pub(crate) use uart::{Receiver, Transmitter};

pub(crate) const OUTBOX_BYTES: usize = 64 * 1024;
pub(crate) const ROOM: Room = {
    let each = Capacity { bodies: 1024, contacts: 8192 };
    Room { fixed: each, f32: each, f64: each }
};

/// Starts the machine, its counter and its link; its clock runs by itself.
pub(super) fn boot() -> Parts {
    stack::paint();
    machine::guard_stack();
    let counter = StageCounter::calibrate();
    let (receiver, transmitter) = uart::open();
    // The clock is whatever `-icount` says.
    let identity = Identity { board: "qemu_virt", build: crate::BUILD, clock_hz: 0, counter: counter.counter() };
    Parts { identity, counter, receiver, transmitter }
}

#[cfg_attr(not(feature = "tests"), riscv_rt::entry)]
fn main() -> ! {
    let parts = boot();
    let physics = executor::start_physics();
    // SAFETY: all handlers are in place and no critical section is open.
    unsafe { riscv::interrupt::enable() };
    executor::run_link(|link| crate::start(parts, physics, link))
}
