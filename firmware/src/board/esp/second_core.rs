//! The executor for physics on the ESP32's other core, which the link's interrupts don't share.

use embassy_executor::SendSpawner;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use esp_hal::peripherals::{CPU_CTRL, FROM_CPU_INTR1, FROM_CPU_INTR2};
use esp_hal::system::Stack;
use esp_rtos::embassy::InterruptExecutor;
use static_cell::{ConstStaticCell, StaticCell};

use super::PHYSICS;

/// Its stack, beside the one that `stack` measures. Loading a scene took 7.6 KB on an ESP32-C3.
static STACK: ConstStaticCell<Stack<{ 12 * 1024 }>> = ConstStaticCell::new(Stack::new());

/// What the other core and the executor there take.
pub(super) struct Interrupts {
    pub(super) core: CPU_CTRL<'static>,
    pub(super) scheduler: FROM_CPU_INTR1<'static>,
    pub(super) physics: FROM_CPU_INTR2<'static>,
}

/// Starts the other core, and the executor there: an interrupt belongs to the core that enables it.
pub(super) fn start(interrupts: Interrupts) -> SendSpawner {
    static EXECUTOR: StaticCell<InterruptExecutor<2>> = StaticCell::new();
    static STARTED: Signal<CriticalSectionRawMutex, SendSpawner> = Signal::new();
    let Interrupts { core, scheduler, physics } = interrupts;
    let executor = EXECUTOR.init(InterruptExecutor::new(physics));
    esp_rtos::start_second_core(core, scheduler, STACK.take(), move || STARTED.signal(executor.start(PHYSICS)));
    loop {
        if let Some(spawner) = STARTED.try_take() {
            return spawner;
        }
    }
}
