//! What all Espressif boards share: how they start, two executors, the link, the machine.

#[cfg(not(feature = "usb"))]
#[path = "esp/uart.rs"]
pub(crate) mod link;
#[cfg(feature = "usb")]
#[path = "esp/usb.rs"]
pub(crate) mod link;
pub(crate) mod machine;
#[cfg_attr(not(feature = "second-core"), path = "esp/one_core.rs")]
#[cfg_attr(feature = "second-core", path = "esp/second_core.rs")]
mod physics;

use embassy_executor::Spawner;
use esp_hal::clock::CpuClock;
use esp_hal::interrupt::Priority;
use esp_hal::peripherals::{RTC_TIMER, TIMG1};
use esp_rtos::embassy::{Callbacks, Executor};
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
    physics: physics::Interrupts,
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
    let physics = cfg_select! {
        feature = "second-core" => physics::Interrupts {
            core: chip.CPU_CTRL,
            scheduler: chip.FROM_CPU_INTR1,
            physics: chip.FROM_CPU_INTR2,
        },
        _ => chip.FROM_CPU_INTR1,
    };
    Booted { parts, physics, watchdog: (chip.TIMG1, chip.RTC_TIMER) }
}

#[cfg_attr(not(feature = "tests"), esp_hal::main)]
fn main() -> ! {
    let Booted { parts, physics, watchdog: (timer, rtc) } = boot();
    machine::start_watchdog(timer, rtc);
    let physics = physics::start(physics);
    run_link(|link| crate::start(parts, physics, link))
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
