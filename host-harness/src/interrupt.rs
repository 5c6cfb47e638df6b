//! Ctrl-C: every wait in `rig` looks here, so that an interrupt unwinds and every child dies with its guard.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::error::{Error, Kind};

/// Longest time a wait may go without looking here.
pub const POLL: Duration = Duration::from_millis(50);

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Catches SIGINT, SIGTERM and SIGHUP from now on.
///
/// # Errors
/// If the system refuses to install the handler.
pub fn install() -> Result<(), Error> {
    ctrlc::set_handler(|| REQUESTED.store(true, Ordering::Relaxed))
        .map_err(|error| Error::target(format!("cannot catch Ctrl-C: {error}"), ""))
}

/// Ends the caller if an interrupt came.
///
/// # Errors
/// [`Kind::Interrupted`] once one came.
pub fn check() -> Result<(), Error> {
    if REQUESTED.load(Ordering::Relaxed) {
        return Err(Error::new(Kind::Interrupted, "interrupted", ""));
    }
    Ok(())
}
