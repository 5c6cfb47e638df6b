//! What is shown on standard error while a device doesn't answer yet; nothing where that isn't a terminal.

use std::time::Duration;

use flat_wire::Counters;
use indicatif::{ProgressBar, ProgressStyle};

use super::progress;

/// The line about one wait; gone when dropped.
#[derive(Debug)]
pub struct Wait {
    bar: ProgressBar,
    target: String,
}

impl Wait {
    /// For the answer to the first question; shown once [`Self::show`] is called.
    pub fn for_hello(target: &str) -> Self {
        let bar = progress::show(ProgressBar::new_spinner());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed:.dim}") {
            bar.set_style(style);
        }
        Self { bar, target: target.to_owned() }
    }

    /// Shows what has come so far.
    pub fn show(&self, counters: Counters, bytes: usize) {
        self.bar.enable_steady_tick(Duration::from_millis(120));
        let heard = match counters.received {
            0 if bytes == 0 => "nothing yet".to_owned(),
            0 => format!("{bytes} bytes, no frame yet"),
            frames => format!("{frames} frames"),
        };
        self.bar.set_message(format!("waiting for {} to say hello: {heard},", self.target));
    }
}

impl Drop for Wait {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
