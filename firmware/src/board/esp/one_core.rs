//! The executor for physics on the core that serves the link, too.

use embassy_executor::SendSpawner;
use esp_hal::peripherals::FROM_CPU_INTR1;
use esp_rtos::embassy::InterruptExecutor;
use static_cell::StaticCell;

use super::PHYSICS;

/// What the executor takes.
pub(super) type Interrupts = FROM_CPU_INTR1<'static>;

/// Starts the executor: it interrupts the one that serves the link.
pub(super) fn start(interrupts: Interrupts) -> SendSpawner {
    static EXECUTOR: StaticCell<InterruptExecutor<1>> = StaticCell::new();
    EXECUTOR.init(InterruptExecutor::new(interrupts)).start(PHYSICS)
}
