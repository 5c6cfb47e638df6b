//! What all Espressif boards share: two executors, the link, the machine.

#[cfg(not(feature = "usb"))]
#[path = "esp/uart.rs"]
pub(crate) mod link;
#[cfg(feature = "usb")]
#[path = "esp/usb.rs"]
pub(crate) mod link;
pub(crate) mod machine;

use embassy_executor::{SendSpawner, Spawner};
use esp_hal::interrupt::Priority;
use esp_hal::peripherals::FROM_CPU_INTR1;
use esp_rtos::embassy::{Callbacks, Executor, InterruptExecutor};
use static_cell::StaticCell;

use crate::watchdog;
pub(crate) use link::{Receiver, Transmitter};

// Tells the boot loader and espflash what this image is.
esp_bootloader_esp_idf::esp_app_desc!();

/// Above the link's interrupts, and the timer's; below the watchdog's.
const PHYSICS: Priority = Priority::Priority2;

/// Starts the executor for physics: it interrupts the one that serves the link.
pub(super) fn start_physics(interrupt: FROM_CPU_INTR1<'static>) -> SendSpawner {
    static EXECUTOR: StaticCell<InterruptExecutor<1>> = StaticCell::new();
    EXECUTOR.init(InterruptExecutor::new(interrupt)).start(PHYSICS)
}

/// Runs the link's executor for ever.
pub(super) fn run_link(start: impl FnOnce(Spawner)) -> ! {
    static EXECUTOR: StaticCell<Executor> = StaticCell::new();
    EXECUTOR.init(Executor::new()).run_with_callbacks(start, Watched)
}

/// Tells the watchdog when the link's executor is at work.
struct Watched;

impl Callbacks for Watched {
    fn before_poll(&mut self) {
        watchdog::LINK.begin();
    }

    fn on_idle(&mut self) {
        watchdog::LINK.end();
    }
}
