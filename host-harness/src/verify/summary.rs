//! What `rig verify` prints.

use std::time::Duration;

use console::style;

use super::step::{Step, Verdict};
use crate::report::progress;

/// A step that was gone through.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub(super) step: &'static str,
    pub(super) verdict: Verdict,
    pub(super) duration: Duration,
}

impl Line {
    fn status(&self) -> console::StyledObject<&'static str> {
        match self.verdict {
            Verdict::Passed(_) => style("PASS   ").green(),
            Verdict::Failed(_) => style("FAIL   ").red().bold(),
            Verdict::Skipped(_) => style("SKIPPED").yellow().bold(),
        }
    }

    fn text(&self) -> &str {
        match &self.verdict {
            Verdict::Passed(text) | Verdict::Failed(text) | Verdict::Skipped(text) => text,
        }
    }
}

/// The steps' names and titles.
pub(super) fn list(steps: &[Step]) {
    for step in steps {
        println!("{:<20} {}", step.name, step.title);
    }
}

/// Says which step comes now.
pub(super) fn announce(number: usize, count: usize, step: &Step) {
    let place = style(format!("[{number}/{count}]")).dim();
    progress::say(&format!("{place} {}: {}", style(step.name).bold(), step.title));
}

/// Says what came of a step, in full and in one piece: another may be under way.
pub(super) fn report(line: &Line) {
    let mut text = line.text().lines();
    let (status, seconds) = (line.status(), line.duration.as_secs_f64());
    let mut said = format!("  {status} {:<20} {seconds:>6.1} s  {}", line.step, text.next().unwrap_or_default());
    for more in text {
        said = said + "\n  " + more;
    }
    if matches!(line.verdict, Verdict::Failed(_)) {
        said = said + "\n  rerun: " + &rerun(line.step);
    }
    progress::say(&said);
}

/// One line for each step, then the counts.
pub(super) fn table(lines: &[Line]) {
    println!();
    for line in lines {
        let text = line.text().lines().next().unwrap_or_default();
        println!("{} {:<20} {:>6.1} s  {text}", line.status(), line.step, line.duration.as_secs_f64());
    }
    let failed: Vec<_> = lines.iter().filter(|line| matches!(line.verdict, Verdict::Failed(_))).collect();
    let skipped = lines.iter().filter(|line| matches!(line.verdict, Verdict::Skipped(_))).count();
    println!();
    for line in &failed {
        println!("rerun: {}", rerun(line.step));
    }
    println!("{} passed, {} failed, {skipped} skipped", lines.len() - failed.len() - skipped, failed.len());
}

fn rerun(step: &str) -> String {
    format!("cargo verify --only {step}")
}
