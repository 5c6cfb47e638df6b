//! The report as a file, for scripts and for comparing runs.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::Serialize;

use super::{Identity, Verdict, seconds};
use crate::error::Error;

/// Everything that was found.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    /// Whether every check held and nothing went wrong.
    pub passed: bool,
    /// What went wrong besides checks.
    pub error: Option<String>,
    /// The targets that said hello.
    pub targets: &'a [Identity],
    /// One for each scenario and target.
    pub verdicts: &'a [Verdict],
    /// Wall time of the whole run.
    #[serde(serialize_with = "seconds", rename = "duration_s")]
    pub duration: Duration,
}

/// The file, open from the start, so that a bad path is found before a long run.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    file: File,
}

impl Output {
    /// Creates the file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn create(path: &Path) -> Result<Self, Error> {
        let file = File::create(path).map_err(|error| failed(path, &error))?;
        Ok(Self { path: path.to_owned(), file })
    }

    /// Writes the report.
    ///
    /// # Errors
    /// If the disk is full, for instance.
    pub fn write(self, report: &Report<'_>) -> Result<(), Error> {
        let mut to = BufWriter::new(self.file);
        serde_json::to_writer_pretty(&mut to, report)
            .map_err(std::io::Error::from)
            .and_then(|()| writeln!(to))
            .and_then(|()| to.flush())
            .map_err(|error| failed(&self.path, &error))
    }
}

fn failed(path: &Path, error: &std::io::Error) -> Error {
    Error::usage(format!("--json {}: {error}", path.display()), "a path in a directory that you may write to")
}
