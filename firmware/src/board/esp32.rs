//! ESP32: Xtensa LX6 at 240 MHz, one of the two cores used. Frames on UART0, GPIO3 in and GPIO1 out.

use embassy_executor::Spawner;
use esp_hal::clock::CpuClock;
use esp_hal::timer::timg::TimerGroup;
use flat_session::Identity;
use flat_wire::message::Counter;

use super::{Capacity, esp};

// Less than on the ESP32-C3: 192 KiB of data memory are in one piece.
pub(crate) const OUTBOX_BYTES: usize = 8 * 1024;
pub(crate) const FIXED: Capacity = Capacity { bodies: 512, contacts: 1536 };
pub(crate) const F32: Capacity = Capacity { bodies: 128, contacts: 768 };
pub(crate) const F64: Capacity = Capacity { bodies: 8, contacts: 24 };

#[esp_rtos::main]
async fn main(link: Spawner) {
    let clock = CpuClock::max();
    let chip = esp_hal::init(esp_hal::Config::default().with_cpu_clock(clock));
    // The timer is also embassy's time driver, in microseconds.
    esp_rtos::start(TimerGroup::new(chip.TIMG0).timer0, chip.FROM_CPU_INTR0);
    let (receiver, transmitter) = esp::open(chip.UART0, chip.GPIO3, chip.GPIO1);
    let identity =
        Identity { board: "esp32", build: crate::BUILD, clock_hz: clock as u32 * 1_000_000, counter: Counter::Cycles };
    let parts = crate::Parts { identity, stopwatch: Stopwatch, receiver, transmitter };
    crate::start(parts, esp::physics_executor(chip.FROM_CPU_INTR1), link);
}

/// Times stages in CPU cycles; wraps after 17.9 s.
pub(crate) struct Stopwatch;

impl flat_session::Stopwatch for Stopwatch {
    fn count(&mut self) -> u32 {
        xtensa_lx::timer::get_cycle_count()
    }
}
