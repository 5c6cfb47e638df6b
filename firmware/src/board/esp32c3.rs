//! ESP32-C3: rv32imc at 160 MHz, no floating-point unit. Frames on UART0, GPIO20 in and GPIO21 out.

use core::arch::asm;

use embassy_executor::Spawner;
use esp_hal::clock::CpuClock;
use esp_hal::timer::systimer::SystemTimer;
use flat_session::Identity;
use flat_wire::message::Counter;

use super::{Capacity, esp};

// What 313 KiB of RAM hold beside the code that runs from it and a stack of 16 KiB, of which 4 were ever used.
pub(crate) const OUTBOX_BYTES: usize = 12 * 1024;
pub(crate) const FIXED: Capacity = Capacity { bodies: 1024, contacts: 3072 };
pub(crate) const F32: Capacity = Capacity { bodies: 128, contacts: 768 };
pub(crate) const F64: Capacity = Capacity { bodies: 8, contacts: 24 };

#[esp_rtos::main]
async fn main(link: Spawner) {
    let clock = CpuClock::max();
    let chip = esp_hal::init(esp_hal::Config::default().with_cpu_clock(clock));
    // The alarm is also embassy's time driver, in microseconds.
    esp_rtos::start(SystemTimer::new(chip.SYSTIMER).alarm0, chip.FROM_CPU_INTR0);
    let (receiver, transmitter) = esp::open(chip.UART0, chip.GPIO20, chip.GPIO21);
    let identity = Identity {
        board: "esp32c3",
        build: crate::BUILD,
        clock_hz: clock as u32 * 1_000_000,
        counter: Counter::Cycles,
    };
    let parts = crate::Parts { identity, stopwatch: Stopwatch::start(), receiver, transmitter };
    crate::start(parts, esp::physics_executor(chip.FROM_CPU_INTR1), link);
}

/// Times stages in CPU cycles, by the chip's performance counter; wraps after 26.8 s.
pub(crate) struct Stopwatch(());

impl Stopwatch {
    fn start() -> Self {
        // SAFETY: mpcer = 1 selects cycles and mpcmr = 1 enables the counter; nothing else uses it.
        unsafe { asm!("csrwi 0x7e0, 1", "csrwi 0x7e1, 1", options(nomem, nostack)) };
        Self(())
    }
}

impl flat_session::Stopwatch for Stopwatch {
    fn count(&mut self) -> u32 {
        let cycles;
        // SAFETY: reads mpccr and does nothing.
        unsafe { asm!("csrr {}, 0x7e2", out(reg) cycles, options(nomem, nostack)) };
        cycles
    }
}
