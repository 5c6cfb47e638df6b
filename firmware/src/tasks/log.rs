//! Log messages to frames.

use embassy_time::{Duration, Timer};
use flat_session::Class;
use flat_wire::MAX_FRAME;
use flat_wire::message::Event;

use super::outbox::OUTBOX;
use crate::logger;

/// When to look again where the outbox is full. Messages wait in the logger meanwhile, or are lost and counted.
const FULL: Duration = Duration::from_millis(20);

/// Hands log messages on, as details: they give way first.
#[embassy_executor::task]
pub(crate) async fn log() -> ! {
    let mut buffer = [0; MAX_FRAME];
    loop {
        let frame = Event::Frame(logger::next().await);
        while !OUTBOX.offer(Class::Detail, &frame, &mut buffer) {
            Timer::after(FULL).await;
        }
    }
}
