//! Commands to replies.

use embassy_time::Instant;
#[cfg(feature = "provoke")]
use flat_wire::message::Command;

use super::arrivals::Arrival;
use super::outbox::Outbox;

/// The device program.
#[cfg(feature = "physics")]
pub(super) type Session = flat_session::Session<'static>;
#[cfg(not(feature = "physics"))]
pub(super) type Session = flat_session::bare::Session;

/// Carries out a command. Not inlined: unlike its caller, it stays in flash.
#[inline(never)]
pub(super) fn answer(session: &mut Session, arrival: &Arrival, outbox: &mut &Outbox) {
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
