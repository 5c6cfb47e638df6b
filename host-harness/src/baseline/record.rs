//! The committed figures: a line each, and what separates two records.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write};

use flat_physics::Stage;

use crate::error::Error;

/// Growth that fails, as a part of what was.
const TOLERANCE: f64 = 0.01;

/// Figures by name; each names what it counts, as in `ball_pit/100/grounded/detect`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Record {
    /// The compiler that made the images; another one's images aren't comparable.
    pub compiler: String,
    /// Instructions a step, or bytes.
    pub figures: BTreeMap<String, u64>,
}

/// What became of a figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// Which.
    pub name: String,
    /// In the record.
    pub before: Option<u64>,
    /// Now.
    pub now: Option<u64>,
}

impl Record {
    /// The text of a record's file.
    pub fn text(&self) -> String {
        let mut text = format!(
            "# Instructions of a step on rv32imc (mean of the run's second half, and its worst step), and bytes of code.\n\
             # `cargo rig baseline --update` writes this file; a figure that grows by more than 1 % fails `cargo verify`.\n\
             compiler,{}\n",
            self.compiler
        );
        for (name, figure) in &self.figures {
            let _ = writeln!(text, "{name},{figure}");
        }
        text
    }

    /// Reads a record's file.
    ///
    /// # Errors
    /// If a line isn't a name and a number; the error names the line.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let mut record = Self::default();
        for (number, line) in (1..).zip(text.lines()).filter(|(_, line)| !line.starts_with('#') && !line.is_empty()) {
            match line.rsplit_once(',') {
                Some(("compiler", release)) => release.clone_into(&mut record.compiler),
                Some((name, figure)) if figure.parse::<u64>().is_ok() => {
                    record.figures.insert(name.to_owned(), figure.parse().unwrap_or_default());
                }
                _ => {
                    let what = format!("line {number} of the baseline is no `name,number`: {line}");
                    return Err(Error::usage(what, "cargo rig baseline --update"));
                }
            }
        }
        Ok(record)
    }

    /// Everything that differs from this record now, in the order of the names.
    pub fn changes(&self, now: &Self) -> Vec<Change> {
        let names: BTreeSet<_> = self.figures.keys().chain(now.figures.keys()).collect();
        names
            .into_iter()
            .map(|name| Change {
                name: name.clone(),
                before: self.figures.get(name).copied(),
                now: now.figures.get(name).copied(),
            })
            .filter(|change| change.before != change.now)
            .collect()
    }
}

impl Change {
    /// What was measured: the name without its last part.
    pub fn subject(&self) -> &str {
        self.name.rsplit_once('/').map_or("", |(subject, _)| subject)
    }

    /// Growth as a part of what was; none if one of the two is missing.
    pub fn growth(&self) -> Option<f64> {
        let (before, now) = (self.before? as f64, self.now? as f64);
        Some((now - before) / before.max(1.0))
    }

    /// Whether it fails: a whole that grows beyond the tolerance, or a figure that isn't on both sides. A stage alone may
    /// grow, as long as the step doesn't.
    pub fn fails(&self) -> bool {
        let whole = !Stage::ALL.iter().any(|stage| self.name.ends_with(&format!("/{stage}")));
        match self.growth() {
            None => true,
            Some(growth) => whole && growth > TOLERANCE,
        }
    }
}

/// `ball_pit/100/grounded/detect   1 000 -> 1 020   +2.0 %`
impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let figure = |figure: Option<u64>| figure.map_or_else(|| "none".to_owned(), |figure| figure.to_string());
        write!(f, "{:44} {:>9} -> {:>9}", self.name, figure(self.before), figure(self.now))?;
        match self.growth() {
            Some(growth) => write!(f, "  {:+.1} %", 100.0 * growth),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(figures: &[(&str, u64)]) -> Record {
        let figures = figures.iter().map(|(name, figure)| ((*name).to_owned(), *figure)).collect();
        Record { compiler: "1.96.0".into(), figures }
    }

    #[test]
    fn a_record_reads_back_what_it_writes() {
        let record = record(&[("pit/100/flat/detect", 7), ("text/qemu_virt", 123_456)]);
        assert_eq!(Record::parse(&record.text()).unwrap(), record);
    }

    #[test]
    fn a_damaged_line_is_named() {
        let error = Record::parse("compiler,1.96.0\npit/100,many\n").unwrap_err();
        assert!(error.what().contains("line 2"), "{error}");
    }

    #[test]
    fn growth_beyond_one_percent_fails_and_less_does_not() {
        let before = record(&[("pit/100/flat/mean", 1000), ("pit/100/flat/detect", 100), ("text/qemu_virt", 1000)]);
        let fails = |figures: &[(&str, u64)]| {
            let changes = before.changes(&record(figures));
            changes.into_iter().filter(Change::fails).map(|change| change.name).collect::<Vec<_>>()
        };
        let same = [("pit/100/flat/mean", 1010), ("pit/100/flat/detect", 150), ("text/qemu_virt", 900)];
        assert!(fails(&same).is_empty(), "a stage may grow if the step doesn't");
        assert_eq!(fails(&[("pit/100/flat/mean", 1011), same[1], same[2]]), ["pit/100/flat/mean"]);
        assert_eq!(fails(&[same[0], same[1]]), ["text/qemu_virt"], "what is no longer measured proves nothing");
    }
}
