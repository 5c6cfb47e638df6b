//! What all Espressif boards share: how they start, two executors, the link, the machine.

#[cfg(not(feature = "usb"))]
#[path = "esp/uart.rs"]
pub(crate) mod link;
#[cfg(feature = "usb")]
#[path = "esp/usb.rs"]
pub(crate) mod link;
pub(crate) mod machine;

use embassy_executor::{SendSpawner, Spawner};
use esp_hal::clock::CpuClock;
use esp_hal::interrupt::Priority;
use esp_hal::peripherals::{FROM_CPU_INTR1, RTC_TIMER, TIMG1};
use esp_rtos::embassy::{Callbacks, Executor, InterruptExecutor};
use flat_session::Identity;
use flat_wire::message::Counter;
use static_cell::StaticCell;

use super::this::{NAME, StageCounter};
use crate::{Parts, stack, watchdog};
pub(crate) use link::{Receiver, Transmitter};

// Tells the boot loader and espflash what this image is.
esp_bootloader_esp_idf::esp_app_desc!();

/// Above the link's interrupts, and the timer's; below the watchdog's.
const PHYSICS: Priority = Priority::Priority2;

/// A chip that has started, up to its tasks.
pub(super) struct Booted {
    pub(super) parts: Parts,
    physics: FROM_CPU_INTR1<'static>,
    watchdog: (TIMG1<'static>, RTC_TIMER<'static>),
}

/// Starts the chip at full speed, its clock, its counter and its link.
pub(super) fn boot() -> Booted {
    stack::paint();
    let clock = CpuClock::max();
    let chip = esp_hal::init(esp_hal::Config::default().with_cpu_clock(clock));
    // The timer is also embassy's time driver, in microseconds.
    let timer = cfg_select! {
        feature = "esp32c3" => esp_hal::timer::systimer::SystemTimer::new(chip.SYSTIMER).alarm0,
        _ => esp_hal::timer::timg::TimerGroup::new(chip.TIMG0).timer0,
    };
    esp_rtos::start(timer, chip.FROM_CPU_INTR0);
    let (receiver, transmitter) = cfg_select! {
        feature = "usb" => link::open(chip.USB_DEVICE),
        feature = "esp32c3" => link::open(chip.UART0, chip.GPIO20, chip.GPIO21),
        _ => link::open(chip.UART0, chip.GPIO3, chip.GPIO1),
    };
    let clock_hz = clock as u32 * 1_000_000;
    let identity = Identity { board: NAME, build: crate::BUILD, clock_hz, counter: Counter::Cycles };
    let parts = Parts { identity, counter: StageCounter::start(), receiver, transmitter };
    Booted { parts, physics: chip.FROM_CPU_INTR1, watchdog: (chip.TIMG1, chip.RTC_TIMER) }
}

#[cfg_attr(not(feature = "tests"), esp_hal::main)]
fn main() -> ! {
    let Booted { parts, physics, watchdog: (timer, rtc) } = boot();
    machine::start_watchdog(timer, rtc);
    let physics = start_physics(physics);
    run_link(|link| crate::start(parts, physics, link))
}

/// Starts the executor for physics: it interrupts the one that serves the link.
fn start_physics(interrupt: FROM_CPU_INTR1<'static>) -> SendSpawner {
    static EXECUTOR: StaticCell<InterruptExecutor<1>> = StaticCell::new();
    EXECUTOR.init(InterruptExecutor::new(interrupt)).start(PHYSICS)
}

/// Runs the link's executor for ever.
fn run_link(start: impl FnOnce(Spawner)) -> ! {
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
