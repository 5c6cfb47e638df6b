//! A board on a serial port.

use std::time::Duration;

use super::link::{Link, Peer};
use crate::error::Error;

/// Opens a port.
///
/// # Errors
/// If there is no such port, it is in use, or access is denied.
pub fn open(path: &str, baud: u32) -> Result<Link, Error> {
    let failed = |error: &serialport::Error| {
        Error::target(format!("cannot open serial port {path}: {error}"), advice(path, error.kind()))
    };
    let mut port = serialport::new(path, baud).open().map_err(|error| failed(&error))?;
    // Short reads let the reader thread notice that nobody listens any more.
    port.set_timeout(Duration::from_millis(50)).map_err(|error| failed(&error))?;
    let reader = port.try_clone().map_err(|error| failed(&error))?;
    Ok(Link::over_streams(reader, port, Box::new(Port(path.to_owned()))))
}

fn advice(path: &str, kind: serialport::ErrorKind) -> String {
    use std::io::ErrorKind::PermissionDenied;
    if kind == serialport::ErrorKind::Io(PermissionDenied) {
        return format!("join the group that owns {path} (often `sudo usermod -aG dialout $USER`), then log in again");
    }
    let ports: Vec<String> =
        serialport::available_ports().unwrap_or_default().into_iter().map(|port| port.port_name).collect();
    if ports.is_empty() {
        "plug the board in: no serial port is there now".to_owned()
    } else {
        format!("one of the ports that are there: {}", ports.join(", "))
    }
}

struct Port(String);

impl Peer for Port {
    fn obituary(&mut self) -> String {
        format!("serial port {} went away", self.0)
    }
}
