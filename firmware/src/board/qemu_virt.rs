//! QEMU's `virt` machine with an rv32imc core: the board that anybody has, and that CI runs.
//!
//! ```text
//! qemu-system-riscv32 -M virt -cpu lowrisc-ibex -m 16M -smp 1 -bios none -display none -monitor none \
//!   -serial stdio -icount shift=3,sleep=off -kernel flat-firmware
//! ```

mod clock;
mod failure;
mod register;
mod stopwatch;
mod uart;

use embassy_executor::Executor;
use flat_session::Identity;
use static_cell::StaticCell;

use super::Capacity;
pub(crate) use stopwatch::Stopwatch;
pub(crate) use uart::{Receiver, Transmitter};

pub(crate) const OUTBOX_BYTES: usize = 64 * 1024;
pub(crate) const FIXED: Capacity = Capacity { bodies: 1024, contacts: 8192 };
pub(crate) const F32: Capacity = FIXED;
pub(crate) const F64: Capacity = FIXED;

#[riscv_rt::entry]
fn main() -> ! {
    static EXECUTOR: StaticCell<Executor> = StaticCell::new();

    let stopwatch = Stopwatch::calibrate();
    let (receiver, transmitter) = uart::open();
    // SAFETY: all handlers are in place and no critical section is open.
    unsafe { riscv::interrupt::enable() };

    EXECUTOR.init(Executor::new()).run(|spawner| {
        let identity = Identity {
            board: "qemu_virt",
            build: crate::BUILD,
            // Whatever `-icount` says.
            clock_hz: 0,
            counter: stopwatch.counter(),
        };
        let parts = crate::Parts { identity, stopwatch, receiver, transmitter };
        // One executor: a step ends before the link goes on, and the link's turns are a few us each.
        crate::start(parts, spawner.make_send(), spawner);
    })
}
