//! The last words of a device that failed, and its new start.
//!
//! 1. The reason becomes one frame: kind, message, place, and the calls that led there.
//! 2. It is kept in memory that a restart leaves alone, then sent by polling the port. If that worked it is forgotten.
//! 3. The device restarts. What was kept is the first thing that it sends.

use core::fmt;
use core::panic::PanicInfo;

use embassy_time::Instant;
use flat_session::{cut, encode};
use flat_wire::MAX_FRAME;
use flat_wire::message::{BACKTRACE, Cause, Event, Fault, FaultKind, Frame, Place};
use heapless::{String, Vec};
use static_cell::ConstStaticCell;

use crate::board::{self, machine};
use crate::tasks::OUTBOX;
use crate::watchdog::Work;

/// The mark of a device that has failed, and whose last words wait for the link; of one that has sent them.
const UNSENT: u32 = 0xFA17_F1A7;
const SENT: u32 = 0xFA17_5E27;
/// Any other mark is chance, or this.
const NONE: u32 = 0;

/// The frame delimiter: ends what the fault has cut off.
const DELIMITER: [u8; 1] = [0];

/// The frame is made here: the stack may be the very thing that is full. Taken once; a second fault, while the first is
/// reported, only restarts.
static BUFFER: ConstStaticCell<[u8; MAX_FRAME]> = ConstStaticCell::new([0; MAX_FRAME]);

#[cfg_attr(not(feature = "tests"), panic_handler)]
fn on_panic(info: &PanicInfo<'_>) -> ! {
    let place = info.location().map(|location| Place { file: tail(location.file()), line: location.line() });
    report(FaultKind::Panic, format_args!("{}", info.message()), place, board::backtrace())
}

/// Work has been under way for too long.
pub(crate) fn hangs(work: &Work, trail: Vec<u32, BACKTRACE>) -> ! {
    report(FaultKind::Watchdog, format_args!("{} hangs", work.name), None, trail)
}

/// Says why, and restarts.
pub(crate) fn report(
    kind: FaultKind,
    message: fmt::Arguments<'_>,
    place: Option<Place>,
    backtrace: Vec<u32, BACKTRACE>,
) -> ! {
    // SAFETY: never released: nothing else shall run again.
    let _ = unsafe { critical_section::acquire() };
    if let Some(buffer) = BUFFER.try_take() {
        let fault = Fault { kind, uptime_us: Instant::now().as_micros(), message: cut(message), place, backtrace };
        // Every fault fits a frame, which flat-wire's tests prove.
        if let Ok(frame) = encode(OUTBOX.next_sequence(), &Event::Frame(Frame::Fault(fault)), buffer) {
            keep(frame);
            if machine::send_blocking(&DELIMITER) && machine::send_blocking(frame) {
                machine::kept().set(0, SENT);
            }
        }
    }
    machine::restart()
}

/// Why the device has started.
pub(crate) fn cause() -> Cause {
    match machine::kept().get(0) {
        UNSENT | SENT => Cause::Fault,
        _ => machine::cause(),
    }
}

/// The last words of the device's former life, if it couldn't send them; and the end of its memory of it.
pub(crate) fn last_words(buffer: &mut [u8; MAX_FRAME]) -> &[u8] {
    let kept = machine::kept();
    let length = if kept.get(0) == UNSENT { (kept.get(1) as usize).min(MAX_FRAME) } else { 0 };
    for (index, bytes) in buffer[..length].chunks_mut(4).enumerate() {
        bytes.copy_from_slice(&kept.get(2 + index).to_le_bytes()[..bytes.len()]);
    }
    kept.set(0, NONE);
    &buffer[..length]
}

/// Keeps a frame over the restart.
pub(crate) fn keep(frame: &[u8]) {
    let kept = machine::kept();
    for (index, bytes) in frame.chunks(4).enumerate() {
        let mut word = [0; 4];
        word[..bytes.len()].copy_from_slice(bytes);
        kept.set(2 + index, u32::from_le_bytes(word));
    }
    kept.set(1, frame.len() as u32);
    kept.set(0, UNSENT);
}

/// As much of the end of a path as fits: it says more than the beginning.
fn tail<const N: usize>(path: &str) -> String<N> {
    let start = path.ceil_char_boundary(path.len().saturating_sub(N));
    cut(format_args!("{}", &path[start..]))
}
