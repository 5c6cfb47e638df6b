//! What a build leaves under a name that it shares with other builds: kept under one of its own.
//!
//! Cargo knows one place for a package's program, whatever its features, so that of two commands that build at once, one may find
//! the other's program there. Cargo's own lock ends before the program is picked up; this one doesn't.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;
use std::thread;

use crate::error::Error;
use crate::interrupt;
use crate::report::progress;

/// The turn to build in a target directory; it ends when dropped.
#[derive(Debug)]
pub struct Turn {
    /// Locked, where the file system knows locks.
    _file: File,
}

impl Turn {
    /// Waits for whoever builds there now, in this process or another.
    ///
    /// # Errors
    /// If the directory can't be written to, or on Ctrl-C.
    pub fn wait(directory: &Path) -> Result<Self, Error> {
        let path = directory.join("turn.lock");
        let unusable = |error: io::Error| {
            Error::target(format!("cannot lock {}: {error}", path.display()), "check its permissions")
        };
        fs::create_dir_all(directory).map_err(unusable)?;
        let file = File::options().create(true).append(true).open(&path).map_err(unusable)?;
        let mut is_first = true;
        loop {
            match file.try_lock() {
                Ok(()) => return Ok(Self { _file: file }),
                Err(TryLockError::WouldBlock) => {}
                // Some network file systems: cargo, too, then does without.
                Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {
                    return Ok(Self { _file: file });
                }
                Err(TryLockError::Error(error)) => return Err(unusable(error)),
            }
            if is_first {
                progress::note(&format!("waiting for another build in {}", directory.display()));
                is_first = false;
            }
            interrupt::check()?;
            thread::sleep(interrupt::POLL);
        }
    }

    /// Keeps what was built in this turn, and ends it.
    ///
    /// # Errors
    /// If there is nothing, or the other place can't be written to.
    pub fn keep(self, built: &Path, to: &Path) -> Result<(), Error> {
        let partial = to.with_extension("partial");
        // The rename replaces the file in one go, under an emulator that may still be reading the old one.
        let kept = fs::create_dir_all(to.with_file_name(""))
            .and_then(|()| fs::copy(built, &partial))
            .and_then(|_| fs::rename(&partial, to));
        drop(self);
        kept.map_err(|error| Error::target(format!("cannot copy {} to {}: {error}", built.display(), to.display()), ""))
    }
}

#[cfg(test)]
mod tests {
    use std::env;
    use std::process;
    use std::sync::Barrier;
    use std::time::Duration;

    use super::*;

    /// As a build does: over some time, and under a name that says nothing of what was built.
    fn build(directory: &Path, kind: &str, started: &Barrier) {
        started.wait();
        let turn = Turn::wait(directory).unwrap();
        let program = directory.join("program");
        fs::write(&program, kind).unwrap();
        thread::sleep(Duration::from_millis(20));
        turn.keep(&program, &directory.join("kept").join(kind)).unwrap();
    }

    #[test]
    fn builds_at_the_same_time_each_keep_their_own_program() {
        const KINDS: [&str; 4] = ["product", "provoke", "bare", "tests"];
        let directory = env::temp_dir().join(format!("flat-turns-{}", process::id()));
        let started = Barrier::new(KINDS.len());
        thread::scope(|scope| {
            for kind in KINDS {
                scope.spawn(|| build(&directory, kind, &started));
            }
        });
        for kind in KINDS {
            assert_eq!(fs::read_to_string(directory.join("kept").join(kind)).unwrap(), kind);
        }
        fs::remove_dir_all(&directory).unwrap();
    }
}
