//! The machine around the program: its one stack, its code, its watchdogs, what it remembers over a restart.

use core::cell::RefCell;
use core::ops::Range;

use critical_section::Mutex;
use esp_hal::Blocking;
use esp_hal::interrupt::{InterruptHandler, Priority};
use esp_hal::peripherals::{RTC_TIMER, TIMG1};
use esp_hal::rtc_cntl::{Rtc, Rwdt, RwdtStage, SocResetReason};
use esp_hal::time::Duration;
use esp_hal::timer::PeriodicTimer;
use esp_hal::timer::timg::TimerGroup;
use flat_wire::message::Cause;

pub(crate) use super::super::this::watch_guard;
#[cfg(feature = "esp32c3")]
pub(crate) use super::super::this::{is_code, reserve};
pub(crate) use super::link::send_blocking;
use crate::kept::{self, Kept};
use crate::{board, fault, watchdog};

unsafe extern "C" {
    static __stack_chk_guard: u32;
    static _stack_start_cpu0: u32;
}

/// After this long without the timer's interrupt, the watchdog in hardware resets the chip.
const DEAF: Duration = Duration::from_secs(4);

/// Bytes of the guard.
pub(crate) const GUARD: usize = 4;

/// From the guard, a word that nobody may write to and esp-hal watches, to the base. Tasks, interrupts and idling share it.
pub(crate) fn stack() -> Range<usize> {
    (&raw const __stack_chk_guard).addr()..(&raw const _stack_start_cpu0).addr()
}

/// What the timer's interrupt handler needs.
struct Watch {
    timer: PeriodicTimer<'static, Blocking>,
    hardware: Rwdt,
}

static WATCH: Mutex<RefCell<Option<Watch>>> = Mutex::new(RefCell::new(None));

/// Starts the timer that looks for work that doesn't end, above all other interrupts, and the watchdog in hardware that it
/// feeds.
pub(crate) fn start_watchdog(timer: TIMG1<'static>, rtc: RTC_TIMER<'static>) {
    let mut timer = PeriodicTimer::new(TimerGroup::new(timer).timer0);
    let mut hardware = Rtc::new(rtc).rwdt;
    hardware.set_timeout(RwdtStage::Stage0, DEAF);
    hardware.enable();
    timer.set_interrupt_handler(InterruptHandler::new(on_timer, Priority::max()));
    timer.listen();
    let period = Duration::from_micros(watchdog::PERIOD.as_micros());
    timer.start(period).expect("half a second is within the timer's range");
    critical_section::with(|cs| WATCH.replace(cs, Some(Watch { timer, hardware })));
}

extern "C" fn on_timer() {
    if let Some(work) = watchdog::overdue() {
        fault::hangs(work, board::trail_of_interrupted());
    }
    critical_section::with(|cs| {
        if let Some(watch) = WATCH.borrow_ref_mut(cs).as_mut() {
            watch.timer.clear_interrupt();
            watch.hardware.feed();
        }
    });
}

/// RTC memory: it keeps its content over every reset but power-on, which clears it.
#[esp_hal::ram(unstable(rtc_fast, persistent))]
static mut KEPT: [u32; kept::WORDS] = [0; kept::WORDS];

/// What a restart leaves alone.
pub(crate) fn kept() -> Kept {
    // SAFETY: a static that nothing else names.
    unsafe { Kept::at((&raw mut KEPT).cast()) }
}

/// Starts the chip anew.
pub(crate) fn restart() -> ! {
    esp_hal::system::software_reset()
}

/// Why the chip started, as far as it knows.
pub(crate) fn cause() -> Cause {
    use SocResetReason as Reset;
    match esp_hal::system::reset_reason() {
        Some(Reset::CoreRtcWdt | Reset::SysRtcWdt | Reset::Cpu0RtcWdt) => Cause::Watchdog,
        Some(Reset::SysBrownOut) => Cause::Brownout,
        #[cfg(feature = "esp32c3")]
        Some(Reset::CoreUsbUart | Reset::CoreUsbJtag) => Cause::Host,
        _ => Cause::PowerOn,
    }
}
