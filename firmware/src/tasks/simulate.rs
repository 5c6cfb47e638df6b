//! The simulation: commands in, steps when they are due, frames out.

use core::future::pending;

use embassy_futures::select::{Either, select};
use embassy_time::{Duration, Instant, Timer};
use flat_physics::{Fixed, Storage};
use flat_session::{Identity, Session, Worlds};
use static_cell::ConstStaticCell;

use super::arrivals::{ARRIVALS, Arrival};
use super::outbox::OUTBOX;
use crate::board::{self, Stopwatch};

/// What the link gets between two ticks at least: this, and one part in [`LINK_SHARE`] of what the tick took. Only a
/// simulation that can't keep up feels it; without it, the command that stops such a simulation would never be read.
const LINK_TURN: Duration = Duration::from_micros(500);
const LINK_SHARE: u32 = 8;

/// Storage for one number format, in a static: it is far too large for a stack.
type Room<S, const BODIES: usize, const CONTACTS: usize> = ConstStaticCell<Storage<S, BODIES, CONTACTS>>;

static FIXED: Room<Fixed, { board::FIXED.bodies }, { board::FIXED.contacts }> = Room::new(Storage::new());
static F32: Room<f32, { board::F32.bodies }, { board::F32.contacts }> = Room::new(Storage::new());
static F64: Room<f64, { board::F64.bodies }, { board::F64.contacts }> = Room::new(Storage::new());

/// Runs the session. Wakes for a command, or when the microsecond timer says that a step is due; never for a byte.
#[embassy_executor::task]
pub(crate) async fn simulate(identity: Identity, mut stopwatch: Stopwatch) -> ! {
    // `take` can't fail: there is one instance of this task, and it comes by here once.
    let worlds = Worlds { fixed: FIXED.take().world(), f32: F32.take().world(), f64: F64.take().world() };
    let mut session = Session::new(identity, worlds);
    let mut outbox = &OUTBOX;
    let mut earliest = Instant::MIN;
    loop {
        // In this order: a flood of commands doesn't hold up a step that is due.
        match select(due(&session, earliest), ARRIVALS.receive()).await {
            Either::First(()) => {
                let start = Instant::now();
                session.tick(start.as_micros(), &mut stopwatch, &mut outbox);
                earliest = Instant::now() + start.elapsed() / LINK_SHARE + LINK_TURN;
            }
            Either::Second(Arrival { sequence, command, link }) => {
                session.note_link(link);
                match command {
                    Some(command) => session.handle(Instant::now().as_micros(), sequence, &command, &mut outbox),
                    None => session.refuse_unknown(sequence, &mut outbox),
                }
            }
        }
    }
}

/// Waits until the session's next tick, for ever where it has none, and not less than till `earliest`.
async fn due(session: &Session<'_>, earliest: Instant) {
    match session.due_us() {
        Some(due_us) => Timer::at(Instant::from_micros(due_us).max(earliest)).await,
        None => pending().await,
    }
}
