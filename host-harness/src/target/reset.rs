//! Resets a board through the serial port's two control lines.
//!
//! Espressif's boards wire them to the chip with two transistors, and its USB-Serial-JTAG acts as if they were there:
//!
//! | DTR | RTS | the chip                                    |
//! |-----|-----|---------------------------------------------|
//! | off | off | runs                                        |
//! | on  | on  | runs                                        |
//! | off | on  | is held in reset                            |
//! | on  | off | runs; would wait for a download after reset |
//!
//! "Boot Mode Selection" in esptool's documentation.

use std::thread;
use std::time::Duration;

use clap::Args;
use serialport::SerialPort;

/// Whether a board is reset when rig opens its port.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reset {
    /// Only if it doesn't answer.
    #[default]
    IfSilent,
    /// Always.
    Always,
    /// Never; the lines stay as the system sets them.
    Never,
}

/// `--reset` and `--no-reset`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Args)]
pub struct ResetArgs {
    /// Resets the board on a serial port first [default: only if it doesn't answer]
    #[arg(long, conflicts_with = "no_reset")]
    reset: bool,

    /// Never resets a board, and leaves the port's control lines as the system sets them
    #[arg(long)]
    no_reset: bool,
}

impl ResetArgs {
    /// What they ask for.
    pub fn choice(self) -> Reset {
        match (self.reset, self.no_reset) {
            (true, _) => Reset::Always,
            (_, true) => Reset::Never,
            _ => Reset::IfSilent,
        }
    }

    /// The option that asks for it, if it takes one.
    pub fn option(self) -> Option<&'static str> {
        match self.choice() {
            Reset::Always => Some("--reset"),
            Reset::Never => Some("--no-reset"),
            Reset::IfSilent => None,
        }
    }
}

/// How long the chip is held in reset.
const HELD: Duration = Duration::from_millis(100);

/// The two lines; each function says whether the port has the line.
pub trait Lines {
    /// Sets DTR.
    fn dtr(&mut self, on: bool) -> bool;
    /// Sets RTS.
    fn rts(&mut self, on: bool) -> bool;
}

impl Lines for dyn SerialPort {
    fn dtr(&mut self, on: bool) -> bool {
        self.write_data_terminal_ready(on).is_ok()
    }

    fn rts(&mut self, on: bool) -> bool {
        self.write_request_to_send(on).is_ok()
    }
}

/// Takes both lines back, which Linux switches on when it opens a port, in the order that doesn't reset the board.
pub fn release(lines: &mut (impl Lines + ?Sized)) {
    // A port without lines has none to take back.
    let _ = lines.rts(false) && lines.dtr(false);
}

/// Resets the board; false if the port has no lines for that.
pub fn pulse(lines: &mut (impl Lines + ?Sized)) -> bool {
    release(lines);
    if !lines.rts(true) {
        return false;
    }
    thread::sleep(HELD);
    lines.rts(false)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chip behind the two transistors.
    #[derive(Debug)]
    struct Chip {
        dtr: bool,
        rts: bool,
        resets: u32,
        downloads: u32,
    }

    impl Chip {
        fn on_a_port_with(dtr: bool, rts: bool) -> Self {
            Self { dtr, rts, resets: 0, downloads: 0 }
        }

        fn set(&mut self, dtr: bool, rts: bool) -> bool {
            let was_held = self.rts && !self.dtr;
            (self.dtr, self.rts) = (dtr, rts);
            let is_held = rts && !dtr;
            self.resets += u32::from(is_held && !was_held);
            self.downloads += u32::from(was_held && !is_held && dtr && !rts);
            true
        }

        fn runs(&self) -> bool {
            !self.rts && !self.dtr
        }
    }

    impl Lines for Chip {
        fn dtr(&mut self, on: bool) -> bool {
            self.set(on, self.rts)
        }

        fn rts(&mut self, on: bool) -> bool {
            self.set(self.dtr, on)
        }
    }

    #[test]
    fn taking_the_lines_back_resets_nothing() {
        for (dtr, rts) in [(true, true), (true, false), (false, false)] {
            let mut chip = Chip::on_a_port_with(dtr, rts);
            release(&mut chip);
            assert!(chip.runs() && chip.resets == 0, "{dtr} {rts}: {chip:?}");
        }
    }

    #[test]
    fn a_pulse_resets_once_and_the_board_starts_its_program() {
        for (dtr, rts) in [(true, true), (true, false), (false, false)] {
            let mut chip = Chip::on_a_port_with(dtr, rts);
            assert!(pulse(&mut chip));
            assert!(chip.runs() && chip.resets == 1 && chip.downloads == 0, "{dtr} {rts}: {chip:?}");
        }
    }
}
