//! Demos, for as long as there is no host.

use embassy_time::Instant;
use flat_session::Demo;

use super::answer::Session;

/// Begins the next demo if nothing runs, and logs what the last one came to: whoever listens on the line can compare it with
/// other boards. Not inlined: unlike its caller, it stays in flash.
#[inline(never)]
pub(super) fn show(session: &mut Session) {
    if let Some(Demo { scene, steps, digest, late_us, took_us }) = session.demonstrate(Instant::now().as_micros()) {
        defmt::info!(
            "demo {=str} ended after {=u32} steps with digest {=u64:016x}: {=u32} us late at worst, {=u32} us at longest",
            scene,
            steps,
            digest,
            late_us,
            took_us
        );
    }
}
