//! Whoever reads standard output may stop reading, as `head` does.

use std::panic::{self, PanicHookInfo};

/// From now on `rig` ends without a word when nobody reads its output any more: what it started still ends with it, as the stack
/// unwinds.
pub fn may_leave() {
    let report = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if !has_left(info) {
            report(info);
        }
    }));
}

/// Whether a `print!` failed since nobody reads: the standard library panics then, and says so.
fn has_left(info: &PanicHookInfo<'_>) -> bool {
    let message = info.payload_as_str().unwrap_or_default();
    message.starts_with("failed printing to stdout") && message.contains("Broken pipe")
}
