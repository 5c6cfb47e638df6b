//! The simulation: commands in, steps when they are due, frames out.

use core::future::pending;
use core::mem::MaybeUninit;

use embassy_futures::select::{Either, select};
use embassy_time::{Duration, Instant, Timer};
use flat_physics::{Fixed, Storage};
use flat_session::{Identity, Worlds};
use static_cell::ConstStaticCell;

use super::answer::{Session, answer};
use super::arrivals::ARRIVALS;
use super::outbox::OUTBOX;
use super::show::show;
use crate::board::{ROOM, StageCounter, machine};
use crate::watchdog;

/// What the link gets between two ticks at least: this, and one part in [`LINK_SHARE`] of what the tick took. Only a
/// simulation that can't keep up feels it; without it, the command that stops such a simulation would never be read.
const LINK_TURN: Duration = Duration::from_micros(500);
const LINK_SHARE: u32 = 8;

/// Storage for one number format, in a static: it is far too large for a stack.
type World<S, const BODIES: usize, const CONTACTS: usize> = ConstStaticCell<Storage<S, BODIES, CONTACTS, TILES>>;
/// Most tiles of a map: 64 x 32.
const TILES: usize = 2048;

static FIXED: World<Fixed, { ROOM.fixed.bodies }, { ROOM.fixed.contacts }> = World::new(Storage::new());
#[cfg(feature = "qemu_virt")]
static F64: World<f64, { ROOM.f64.bodies }, { ROOM.f64.contacts }> = World::new(Storage::new());

/// The storage for binary32, in memory that chips need for their boot loader until they run, and that nobody clears.
///
/// Called once.
fn f32_storage() -> &'static mut Storage<f32, { ROOM.f32.bodies }, { ROOM.f32.contacts }, TILES> {
    type Room = MaybeUninit<Storage<f32, { ROOM.f32.bodies }, { ROOM.f32.contacts }, TILES>>;
    #[cfg_attr(feature = "_esp", esp_hal::ram(reclaimed))]
    static mut F32: Room = Room::uninit();
    // SAFETY: the only reference to this static, made once.
    unsafe { (&raw mut F32).as_mut_unchecked() }.write(Storage::new())
}

/// Runs the session. Wakes for a command, or when the microsecond timer says that a step is due; never for a byte.
#[embassy_executor::task]
pub(crate) async fn simulate(identity: Identity, counter: StageCounter) -> ! {
    // `take` can't fail: there is one instance of this task, and it comes by here once.
    let worlds = Worlds {
        fixed: FIXED.take().world(),
        f32: f32_storage().world(),
        #[cfg(feature = "qemu_virt")]
        f64: F64.take().world(),
    };
    let mut session = Session::new(identity, worlds);
    let mut stopwatch = Stopwatch(counter);
    let mut outbox = &OUTBOX;
    let mut earliest = Instant::MIN;
    loop {
        show(&mut session);
        watchdog::PHYSICS.end();
        // In this order: a flood of commands doesn't hold up a step that is due.
        let next = select(due(&session, earliest), ARRIVALS.receive()).await;
        watchdog::PHYSICS.begin();
        machine::watch_guard();
        match next {
            Either::First(()) => {
                let start = Instant::now();
                session.tick(&mut stopwatch, &mut outbox);
                earliest = Instant::now() + start.elapsed() / LINK_SHARE + LINK_TURN;
            }
            Either::Second(arrival) => answer(&mut session, &arrival, &mut outbox),
        }
    }
}

/// The board's clock and its counter of cycles or instructions.
struct Stopwatch(StageCounter);

impl flat_session::Stopwatch for Stopwatch {
    fn now_us(&mut self) -> u64 {
        Instant::now().as_micros()
    }

    fn count(&mut self) -> u32 {
        self.0.count()
    }
}

/// Waits until the session's next tick, for ever where it has none, and not less than till `earliest`.
async fn due(session: &Session, earliest: Instant) {
    match session.due_us() {
        Some(due_us) => Timer::at(Instant::from_micros(due_us).max(earliest)).await,
        None => pending().await,
    }
}
