//! A board on a serial port.

use std::time::Duration;

use serialport::SerialPort;

use super::link::{Link, Peer};
use super::ports;
use super::reset::{self, Reset};
use crate::error::Error;

/// Opens a port, that of the one board there is if none is named.
///
/// # Errors
/// If there is no such port, it is in use, or access is denied.
pub fn open(path: Option<&str>, baud: u32, reset: Reset) -> Result<Link, Error> {
    let path = if let Some(path) = path {
        path.to_owned()
    } else {
        let (path, description) = ports::find()?;
        eprintln!("port {description}");
        path
    };
    let failed = |error: &serialport::Error| {
        Error::target(format!("cannot open serial port {path}: {error}"), advice(&path, error.kind()))
    };
    let mut port = serialport::new(&path, baud).open().map_err(|error| failed(&error))?;
    // Short reads let the reader thread notice that nobody listens any more.
    port.set_timeout(Duration::from_millis(50)).map_err(|error| failed(&error))?;
    let reader = port.try_clone().map_err(|error| failed(&error))?;
    let mut lines = port.try_clone().map_err(|error| failed(&error))?;
    match reset {
        Reset::Never => {}
        Reset::IfSilent => reset::release(&mut *lines),
        Reset::Always if reset::pulse(&mut *lines) => {}
        Reset::Always => {
            return Err(Error::target(
                format!("serial port {path} has no control lines to reset a board with"),
                "press the board's reset button, and leave --reset out",
            ));
        }
    }
    Ok(Link::over_streams(reader, port, Box::new(Port { path, lines, may_reset: reset == Reset::IfSilent })))
}

fn advice(path: &str, kind: serialport::ErrorKind) -> String {
    use std::io::ErrorKind::PermissionDenied;
    if kind == serialport::ErrorKind::Io(PermissionDenied) {
        return format!("join the group that owns {path} (often `sudo usermod -aG dialout $USER`), then log in again");
    }
    let there = ports::names();
    if there.is_empty() {
        "plug the board in: no serial port is there now".to_owned()
    } else {
        format!("end whatever else has it open, or take another of the ports that are there: {there}")
    }
}

struct Port {
    path: String,
    lines: Box<dyn SerialPort>,
    may_reset: bool,
}

impl Peer for Port {
    fn obituary(&mut self) -> String {
        format!("serial port {} went away", self.path)
    }

    fn reset(&mut self) -> bool {
        // Once: a board that two resets don't help isn't helped by a third.
        std::mem::take(&mut self.may_reset) && reset::pulse(&mut *self.lines)
    }
}
