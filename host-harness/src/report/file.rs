//! A report's file, open from the start, so that a bad path is found before a long run.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::error::Error;

/// The file of one option.
#[derive(Debug)]
pub struct Output {
    option: &'static str,
    path: PathBuf,
    file: File,
}

impl Output {
    /// Creates the file, if the option was given.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn create(option: &'static str, path: Option<&Path>) -> Result<Option<Self>, Error> {
        let open = |path: &Path| {
            let file = File::create(path).map_err(|error| failed(option, path, &error))?;
            Ok(Self { option, path: path.to_owned(), file })
        };
        path.map(open).transpose()
    }

    /// Writes a text.
    ///
    /// # Errors
    /// If the disk is full, for instance.
    pub fn write(mut self, text: &str) -> Result<(), Error> {
        self.file.write_all(text.as_bytes()).map_err(|error| failed(self.option, &self.path, &error))
    }

    /// Writes a value as JSON.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub fn write_json(self, value: &impl Serialize) -> Result<(), Error> {
        match serde_json::to_string_pretty(value) {
            Ok(text) => self.write(&format!("{text}\n")),
            Err(error) => Err(failed(self.option, &self.path, &error.into())),
        }
    }
}

fn failed(option: &str, path: &Path, error: &std::io::Error) -> Error {
    Error::usage(format!("{option} {}: {error}", path.display()), "a path in a directory that you may write to")
}
