//! A progress bar on standard error while a target runs; nothing where that isn't a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// The bar of one run; gone when dropped.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar of so many steps.
    pub fn new(scene: &str, target: &str, steps: u32) -> Self {
        let bar = ProgressBar::new(steps.into());
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
