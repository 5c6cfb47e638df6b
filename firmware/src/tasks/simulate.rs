//! The simulation: commands in, steps when they are due, frames out.

use core::future::pending;

use embassy_futures::select::{Either, select};
use embassy_time::{Duration, Instant, Timer};
use flat_physics::{Fixed, Storage};
use flat_session::{Identity, Session, Worlds};
#[cfg(feature = "provoke")]
use flat_wire::message::Command;
use static_cell::ConstStaticCell;

use super::arrivals::{ARRIVALS, Arrival};
use super::outbox::{OUTBOX, Outbox};
use crate::board::{self, StageCounter, machine};
use crate::watchdog;

/// What the link gets between two ticks at least: this, and one part in [`LINK_SHARE`] of what the tick took. Only a
/// simulation that can't keep up feels it; without it, the command that stops such a simulation would never be read.
const LINK_TURN: Duration = Duration::from_micros(500);
const LINK_SHARE: u32 = 8;

/// Storage for one number format, in a static: it is far too large for a stack.
type Room<S, const BODIES: usize, const CONTACTS: usize> = ConstStaticCell<Storage<S, BODIES, CONTACTS, TILES>>;
/// Most tiles of a map: 64 x 32.
const TILES: usize = 2048;

static FIXED: Room<Fixed, { board::FIXED.bodies }, { board::FIXED.contacts }> = Room::new(Storage::new());
static F32: Room<f32, { board::F32.bodies }, { board::F32.contacts }> = Room::new(Storage::new());
static F64: Room<f64, { board::F64.bodies }, { board::F64.contacts }> = Room::new(Storage::new());

/// Runs the session. Wakes for a command, or when the microsecond timer says that a step is due; never for a byte.
#[embassy_executor::task]
pub(crate) async fn simulate(identity: Identity, counter: StageCounter) -> ! {
    // `take` can't fail: there is one instance of this task, and it comes by here once.
    let worlds = Worlds { fixed: FIXED.take().world(), f32: F32.take().world(), f64: F64.take().world() };
    let mut session = Session::new(identity, worlds);
    let mut stopwatch = Stopwatch(counter);
    let mut outbox = &OUTBOX;
    let mut earliest = Instant::MIN;
    loop {
        session.demonstrate(Instant::now().as_micros());
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

/// Carries out a command. Not inlined: unlike its caller, it stays in flash.
#[inline(never)]
fn answer(session: &mut Session<'_>, arrival: &Arrival, outbox: &mut &Outbox) {
    let sequence = arrival.sequence;
    session.note_link(arrival.link);
    if let Some(stack) = arrival.stack {
        session.note_stack(stack);
    }
    match &arrival.command {
        #[cfg(feature = "provoke")]
        Some(Command::Provoke(mishap)) => {
            crate::provoke::on_physics(*mishap);
            session.acknowledge(sequence, outbox);
        }
        Some(command) => session.handle(Instant::now().as_micros(), sequence, command, outbox),
        None => session.refuse_unknown(sequence, outbox),
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
async fn due(session: &Session<'_>, earliest: Instant) {
    match session.due_us() {
        Some(due_us) => Timer::at(Instant::from_micros(due_us).max(earliest)).await,
        None => pending().await,
    }
}
