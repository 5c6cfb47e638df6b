//! The boards. Each starts itself, calls [`crate::start`], and says here:
//!
//! | Name              | Is                                                            |
//! |-------------------|---------------------------------------------------------------|
//! | `Receiver`        | serial in, `embedded_io_async::Read`                          |
//! | `Transmitter`     | serial out, `embedded_io_async::Write`                        |
//! | `StageCounter`    | cycles or instructions                                        |
//! | `OUTBOX_BYTES`    | bytes of frames that may wait for the link                    |
//! | `ROOM`            | room for bodies and contacts in each number format            |
//! | `machine`         | the stack, the code, restart, sending without interrupts      |
//! | `backtrace`       | the calls that led to here                                    |
//! | `boot`            | all of that but the tasks, for tests                          |
//!
//! Time comes from the board's embassy time driver, in microseconds.

#[cfg(feature = "_esp")]
mod esp;
#[cfg(feature = "esp32")]
mod esp32;
#[cfg(feature = "esp32c3")]
mod esp32c3;
#[cfg(feature = "qemu_virt")]
mod qemu_virt;
#[cfg(target_arch = "riscv32")]
mod riscv;

#[cfg(feature = "esp32")]
use esp32 as this;
#[cfg(feature = "esp32c3")]
use esp32c3 as this;
#[cfg(feature = "qemu_virt")]
use qemu_virt as this;

#[cfg(feature = "_esp")]
pub(crate) use esp::{Receiver, Transmitter, machine};
#[cfg(all(feature = "provoke", feature = "esp32"))]
pub(crate) use esp32::illegal_instruction;
#[cfg(feature = "esp32")]
pub(crate) use esp32::{backtrace, trail_of_interrupted};
#[cfg(feature = "qemu_virt")]
pub(crate) use qemu_virt::{Receiver, Transmitter, machine};
#[cfg(all(feature = "provoke", target_arch = "riscv32"))]
pub(crate) use riscv::illegal_instruction;
#[cfg(target_arch = "riscv32")]
pub(crate) use riscv::{backtrace, trail_of_interrupted};
#[cfg(feature = "physics")]
pub(crate) use this::ROOM;
pub(crate) use this::{OUTBOX_BYTES, StageCounter};

/// A device that has started, up to its tasks, for the tests.
#[cfg(feature = "tests")]
pub(crate) fn boot() -> crate::Parts {
    cfg_select! {
        feature = "_esp" => esp::boot().parts,
        _ => qemu_virt::boot(),
    }
}

/// Room for worlds, by number format.
pub(crate) struct Room {
    pub(crate) fixed: Capacity,
    pub(crate) f32: Capacity,
    /// To compare with: chips do without.
    #[cfg(feature = "qemu_virt")]
    pub(crate) f64: Capacity,
}

/// Room for one world.
#[derive(Clone, Copy)]
pub(crate) struct Capacity {
    /// Most bodies.
    pub(crate) bodies: usize,
    /// Most contacts.
    pub(crate) contacts: usize,
}
