//! Two executors on one hart, as on the chips: the link's in thread mode, physics in an interrupt that the CLINT raises
//! on request.
//!
//! ```text
//!  level      what runs                 is woken by                      is interrupted by
//!  thread     receive, transmit, logs   the end of `wfi`                 all below
//!  software   simulate                  MSIP, which the pender writes    the timer, for the watchdog
//!  timer      the time driver           mtimecmp                         nothing
//!  external   the serial port           the PLIC, between two steps      nothing
//! ```

use core::ptr;
use core::sync::atomic::{AtomicBool, AtomicPtr, Ordering};

use embassy_executor::{SendSpawner, Spawner, raw};
use riscv::interrupt::Interrupt;
use riscv::register::mie;
use static_cell::StaticCell;

use super::clock;
use super::register::Register;
use crate::watchdog;

// SAFETY: the `virt` machine's CLINT: bit 0 interrupts hart 0.
const MSIP: Register<u32> = unsafe { Register::at(0x0200_0000) };

/// What the pender is told about the executor that has work.
const LINK: usize = 0;
const PHYSICS: usize = 1;

/// Whether the link's executor has work.
static LINK_HAS_WORK: AtomicBool = AtomicBool::new(false);
/// The executor for physics, once it is there.
static PHYSICS_EXECUTOR: AtomicPtr<raw::Executor> = AtomicPtr::new(ptr::null_mut());

/// Called by embassy when an executor that was idle has work.
#[unsafe(export_name = "__pender")]
fn pend(context: *mut ()) {
    match context.addr() {
        PHYSICS => MSIP.write(1),
        _ => LINK_HAS_WORK.store(true, Ordering::SeqCst),
    }
}

/// Starts the executor for physics: it interrupts the link's.
pub(super) fn start_physics() -> SendSpawner {
    static EXECUTOR: StaticCell<raw::Executor> = StaticCell::new();
    let executor = EXECUTOR.init(raw::Executor::new(ptr::without_provenance_mut(PHYSICS)));
    PHYSICS_EXECUTOR.store(executor, Ordering::SeqCst);
    // SAFETY: `on_request` is linked in, and finds its executor.
    unsafe { mie::set_msoft() };
    let executor: &'static raw::Executor = executor;
    executor.spawner().make_send()
}

#[riscv_rt::core_interrupt(Interrupt::MachineSoft)]
fn on_request() {
    MSIP.write(0);
    // SAFETY: it is null or comes from a `StaticCell`, and is only ever shared.
    let Some(executor) = (unsafe { PHYSICS_EXECUTOR.load(Ordering::SeqCst).as_ref() }) else {
        return;
    };
    // SAFETY: masking sources that can wait is always allowed.
    unsafe {
        mie::clear_mext();
        mie::clear_msoft();
    }
    clock::watch();
    // Of the sources, the timer is left: it may interrupt, its handler ends before this one goes on.
    // SAFETY: no critical section is open in a handler's first lines; the executor is polled nowhere else.
    unsafe { riscv::interrupt::nested(|| executor.poll()) };
    // SAFETY: as they were: this handler runs only after both were set.
    unsafe {
        mie::set_mext();
        mie::set_msoft();
    }
}

/// Runs the link's executor for ever.
pub(super) fn run_link(start: impl FnOnce(Spawner)) -> ! {
    static EXECUTOR: StaticCell<raw::Executor> = StaticCell::new();
    let executor: &'static raw::Executor = EXECUTOR.init(raw::Executor::new(ptr::without_provenance_mut(LINK)));
    start(executor.spawner());
    loop {
        watchdog::LINK.begin();
        clock::watch();
        // SAFETY: on this executor, `poll` is called here alone.
        unsafe { executor.poll() };
        watchdog::LINK.end();
        critical_section::with(|_| {
            if LINK_HAS_WORK.load(Ordering::SeqCst) {
                LINK_HAS_WORK.store(false, Ordering::SeqCst);
            } else {
                riscv::asm::wfi();
            }
        });
    }
}
