//! Progress bars on standard error while a target runs; nothing where that isn't a terminal.

use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};

/// All bars, one below the other.
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// Shows a bar among the others.
pub fn show(bar: ProgressBar) -> ProgressBar {
    BARS.add(bar)
}

/// Prints a line, or several, above all bars.
pub fn say(text: &str) {
    BARS.suspend(|| println!("{text}"));
}

/// The same on standard error, for what is no part of a report.
pub fn note(text: &str) {
    BARS.suspend(|| eprintln!("{text}"));
}

/// Whether a bar over many runs is shown, below which those of single runs would only flicker.
static OVERALL: AtomicBool = AtomicBool::new(false);

/// A bar over many runs, for the rest of the command.
pub fn overall(settings: usize) -> ProgressBar {
    OVERALL.store(true, Ordering::Relaxed);
    let bar = show(ProgressBar::new(settings as u64));
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos} of {len}, {eta} left  {msg}") {
        bar.set_style(style);
    }
    bar
}

/// The bar of one run; gone when dropped.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar of so many steps.
    pub fn new(scene: &str, target: &str, steps: u32) -> Self {
        if OVERALL.load(Ordering::Relaxed) {
            return Self(ProgressBar::hidden());
        }
        let bar = show(ProgressBar::new(steps.into()));
        if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} step {pos} of {len}, {eta} left") {
            bar.set_style(style);
        }
        bar.set_message(format!("{scene} on {target}"));
        Self(bar)
    }

    /// A step is done.
    pub fn reached(&self, step: u32) {
        self.0.set_position(step.into());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
