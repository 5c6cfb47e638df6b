//! Where scenes run: what may be asked for on the command line, and how a link to it is opened.

pub mod child;
pub mod esp_qemu;
pub mod exec;
pub mod link;
pub mod mock;
pub mod ports;
pub mod qemu;
pub mod reset;
pub mod serial;
pub mod tcp;

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::Duration;

use crate::error::Error;
use crate::firmware::image::{self, Board};
use link::Link;
use reset::Reset;

/// A target by its name on the command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// The device program inside rig, on a virtual clock.
    Mock,
    /// The `qemu_virt` firmware in QEMU.
    Qemu,
    /// The `esp32c3` firmware in Espressif's QEMU.
    EspQemu,
    /// A board on a serial port.
    Serial {
        /// The port; none = that of the one board there is.
        path: Option<String>,
        /// Its speed.
        baud: u32,
    },
    /// A device behind a TCP socket, `HOST:PORT`.
    Tcp(String),
    /// A program that speaks over its standard input and output.
    Exec(String),
}

/// What opening a target may need beyond its name.
#[derive(Clone, Debug)]
pub struct Means {
    /// QEMU image to run, none = build one; for others the image that they run, none = the one that rig built last.
    pub elf: Option<PathBuf>,
    /// How fast QEMU's processor is.
    pub speed: qemu::Speed,
    /// Longest wait for a connection.
    pub patience: Duration,
    /// Whether to reset a board on a serial port.
    pub reset: Reset,
}

impl Target {
    /// Opens a link.
    ///
    /// # Errors
    /// If there is nobody at the other end; each target says what to do about it.
    pub fn open(&self, means: &Means) -> Result<Link, Error> {
        let link = match self {
            Self::Mock => return mock::open(),
            Self::Qemu => {
                let elf = means.elf.clone().map_or_else(|| image::build(Board::QemuVirt), Ok)?;
                return Ok(qemu::open(&elf, means.speed)?.with_image(Some(elf)));
            }
            Self::EspQemu => {
                esp_qemu::probe()?;
                let elf = means.elf.clone().map_or_else(|| image::build(Board::Esp32c3), Ok)?;
                return Ok(esp_qemu::open(&elf)?.with_image(Some(elf)));
            }
            Self::Serial { path, baud } => serial::open(path.as_deref(), *baud, means.reset)?,
            Self::Tcp(address) => tcp::open(address, means.patience)?,
            Self::Exec(command) => exec::open(command)?,
        };
        Ok(link.with_image(means.elf.clone()))
    }
}

impl Target {
    /// Whether it may be a board. What is behind a socket or a program is taken for an emulation.
    pub fn is_board(&self) -> bool {
        matches!(self, Self::Serial { .. })
    }

    /// What reports call it: its name, but of a command only the program.
    pub fn label(&self) -> String {
        let Self::Exec(command) = self else { return self.to_string() };
        let program = shell_words::split(command).ok().and_then(|words| words.into_iter().next()).unwrap_or_default();
        let name = Path::new(&program).file_name().map(|name| name.to_string_lossy().into_owned());
        format!("exec:{}", name.unwrap_or(program))
    }
}

/// As on the command line.
impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mock => f.write_str("mock"),
            Self::Qemu => f.write_str("qemu"),
            Self::EspQemu => f.write_str("esp-qemu"),
            Self::Serial { path: None, baud: flat_wire::BAUD } => f.write_str("serial"),
            Self::Serial { path, baud } => {
                write!(f, "serial:{}", path.as_deref().unwrap_or_default())?;
                if *baud == flat_wire::BAUD { Ok(()) } else { write!(f, "@{baud}") }
            }
            Self::Tcp(address) => write!(f, "tcp:{address}"),
            Self::Exec(command) => write!(f, "exec:{command}"),
        }
    }
}

/// One `--target` value: targets with commas between them. `exec:` takes the rest of its value, commas included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TargetList(pub Vec<Target>);

impl FromStr for TargetList {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut targets = Vec::new();
        let mut rest = Some(text);
        while let Some(list) = rest {
            let (word, after) = match list.split_once(',') {
                Some((word, after)) if !list.starts_with("exec:") => (word, Some(after)),
                _ => (list, None),
            };
            targets.push(parse(word)?);
            rest = after;
        }
        Ok(Self(targets))
    }
}

fn parse(word: &str) -> Result<Target, String> {
    let (kind, argument) = word.split_once(':').unwrap_or((word, ""));
    match (kind, argument) {
        ("mock", "") => Ok(Target::Mock),
        ("qemu", "") => Ok(Target::Qemu),
        ("esp-qemu", "") => Ok(Target::EspQemu),
        ("serial", port) => {
            let (path, baud) = match port.rsplit_once('@') {
                Some((path, baud)) => {
                    (path, baud.parse().map_err(|_| format!("serial: `{baud}` isn't a speed in baud"))?)
                }
                None => (port, flat_wire::BAUD),
            };
            Ok(Target::Serial { path: Some(path.into()).filter(|path: &String| !path.is_empty()), baud })
        }
        ("tcp", address) => match address.rsplit_once(':') {
            Some((host, port)) if !host.is_empty() && port.parse::<u16>().is_ok() => Ok(Target::Tcp(address.into())),
            _ => Err("tcp: needs a host and a port, as in tcp:localhost:5555".into()),
        },
        ("exec", "") => Err("exec: needs a command, as in 'exec:emulator --image app.elf'".into()),
        ("exec", command) => Ok(Target::Exec(command.into())),
        _ => {
            Err(format!("`{word}` is none of mock, qemu, esp-qemu, serial[:PATH[@BAUD]], tcp:HOST:PORT, exec:COMMAND"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_split_at_commas_and_exec_keeps_its_own() {
        let list: TargetList = "mock,tcp:[::1]:9,exec:emulate --cpu a,b".parse().unwrap();
        assert_eq!(list.0, [Target::Mock, Target::Tcp("[::1]:9".into()), Target::Exec("emulate --cpu a,b".into())]);
    }

    #[test]
    fn a_target_reads_back_what_it_prints() {
        for text in [
            "mock",
            "qemu",
            "esp-qemu",
            "serial",
            "serial:@115200",
            "serial:/dev/ttyACM0",
            "serial:COM3@115200",
            "tcp:localhost:5555",
            "exec:a 'b c'",
        ] {
            let TargetList(targets) = text.parse().unwrap();
            assert_eq!(targets.iter().map(ToString::to_string).collect::<Vec<_>>(), [text]);
        }
    }

    #[test]
    fn a_port_without_a_speed_has_the_speed_that_the_firmware_sets() {
        let TargetList(targets) = "serial:/dev/ttyUSB0".parse().unwrap();
        assert_eq!(targets, [Target::Serial { path: Some("/dev/ttyUSB0".into()), baud: flat_wire::BAUD }]);
    }

    #[test]
    fn what_is_no_target_is_refused() {
        for text in
            ["", "mock,", "mock:1", "board", "serial:p@fast", "serial@9600", "tcp:5555", "tcp:host:70000", "exec:"]
        {
            assert!(text.parse::<TargetList>().is_err(), "{text}");
        }
    }
}
