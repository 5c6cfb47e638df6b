//! A device behind a TCP socket: a serial server, or an emulator's `-serial tcp:`.

use std::io::ErrorKind;
use std::net::{Shutdown, TcpStream, ToSocketAddrs};
use std::time::Duration;

use super::link::{Link, Peer};
use crate::error::Error;

/// Connects to `HOST:PORT`.
///
/// # Errors
/// If the address doesn't resolve or nobody answers in time.
pub fn open(address: &str, patience: Duration) -> Result<Link, Error> {
    let failed = |error: &std::io::Error| {
        let waited = match error.kind() {
            ErrorKind::TimedOut => format!(" (waited {} s)", patience.as_secs_f32()),
            _ => String::new(),
        };
        Error::target(
            format!("cannot connect to {address}: {error}{waited}"),
            "start the device or emulator first, and check host and port",
        )
    };
    let addresses = address.to_socket_addrs().map_err(|error| failed(&error))?;
    let mut last = std::io::Error::other("the name has no address");
    for candidate in addresses {
        match TcpStream::connect_timeout(&candidate, patience) {
            Ok(stream) => return over(stream, address).map_err(|error| failed(&error)),
            Err(error) => last = error,
        }
    }
    Err(failed(&last))
}

fn over(stream: TcpStream, address: &str) -> std::io::Result<Link> {
    // Commands are small and waited for: don't let them sit in the send buffer.
    stream.set_nodelay(true)?;
    let peer = Connection { address: address.to_owned(), stream: stream.try_clone()? };
    Ok(Link::over_streams(stream.try_clone()?, stream, Box::new(peer)))
}

struct Connection {
    address: String,
    stream: TcpStream,
}

impl Peer for Connection {
    fn obituary(&mut self) -> String {
        format!("{} closed the connection", self.address)
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        // Wakes the reader thread; fails only if the connection is closed already.
        let _ = self.stream.shutdown(Shutdown::Both);
    }
}
