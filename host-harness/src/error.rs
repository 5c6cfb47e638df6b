//! What can end `rig` early, and the exit code that says so to scripts.

use std::fmt;
use std::process::ExitCode;

/// A checked promise or a comparison failed.
pub const CHECK_FAILED: u8 = 1;

/// Why `rig` gives up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The command line asks for something that doesn't exist.
    Usage,
    /// There is no target, it went away, or it stayed silent past a deadline.
    Target,
    /// The target and this `rig` speak different protocols.
    Protocol,
    /// The target understood and said no.
    Refused,
    /// Somebody pressed Ctrl-C.
    Interrupted,
}

/// An error with the way out of it.
#[derive(Clone, Debug)]
pub struct Error {
    kind: Kind,
    what: String,
    next: String,
}

impl Error {
    /// An error of a kind: what happened, and what to do next (empty: nothing to add).
    pub fn new(kind: Kind, what: impl Into<String>, next: impl Into<String>) -> Self {
        Self { kind, what: what.into(), next: next.into() }
    }

    /// A usage error.
    pub fn usage(what: impl Into<String>, next: impl Into<String>) -> Self {
        Self::new(Kind::Usage, what, next)
    }

    /// No target, or no longer.
    pub fn target(what: impl Into<String>, next: impl Into<String>) -> Self {
        Self::new(Kind::Target, what, next)
    }

    /// Its kind.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// What happened, without the way out.
    pub fn what(&self) -> &str {
        &self.what
    }

    /// The exit code for scripts.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self.kind {
            Kind::Refused => CHECK_FAILED,
            Kind::Usage => 2,
            Kind::Target => 3,
            Kind::Protocol => 4,
            Kind::Interrupted => 130,
        })
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)?;
        if !self.next.is_empty() {
            write!(f, "\n  try: {}", self.next)?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}
