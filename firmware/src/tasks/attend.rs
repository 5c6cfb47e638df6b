//! What is left of the simulation without physics: commands in, replies out.

use flat_session::Identity;

use super::answer::{Session, answer};
use super::arrivals::ARRIVALS;
use super::outbox::OUTBOX;
use crate::board::machine;
use crate::watchdog;

/// Answers the host.
#[embassy_executor::task]
pub(crate) async fn attend(identity: Identity) -> ! {
    let mut session = Session::new(identity);
    let mut outbox = &OUTBOX;
    loop {
        watchdog::PHYSICS.end();
        let arrival = ARRIVALS.receive().await;
        watchdog::PHYSICS.begin();
        machine::watch_guard();
        answer(&mut session, &arrival, &mut outbox);
    }
}
