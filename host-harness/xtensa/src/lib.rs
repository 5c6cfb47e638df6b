//! The device program on an Xtensa core: frames on the simulator's standard input and output, time as fast as steps take.
//!
//! The ESP32's core is such a one, with register windows and floating point on top; what stands here computes with the
//! instructions that both have. `cargo verify --only scenes-xtensa` builds and runs it.
#![no_std]
#![deny(clippy::undocumented_unsafe_blocks)]

mod simulator;

use flat_physics::{Fixed, Storage};
use flat_session::{Identity, Ring, Session, Stopwatch, Worlds};
use flat_wire::message::{Command, Counter};
use flat_wire::{Decoder, FrameError};

/// As on QEMU's board.
const BODIES: usize = 1024;
const CONTACTS: usize = 8192;
const TILES: usize = 2048;

/// Identifies the sources: `FLAT_BUILD` where the build sets it, else the version.
const BUILD: &str = match option_env!("FLAT_BUILD") {
    Some(build) => build,
    None => env!("CARGO_PKG_VERSION"),
};

/// Serves a host until it closes the line. While a run is under way, commands wait for its end.
// SAFETY: the only symbol of that name; `start.S` calls it, once.
#[unsafe(no_mangle)]
extern "C" fn run() -> ! {
    // The stack has room for all of it.
    let mut fixed = Storage::<Fixed, BODIES, CONTACTS, TILES>::new();
    let mut f32 = Storage::<f32, BODIES, CONTACTS, TILES>::new();
    let mut ring = Ring::<65_536>::new();
    let identity = Identity { board: "xtensa", build: BUILD, clock_hz: 0, counter: Counter::None };
    let mut session = Session::new(identity, Worlds { fixed: fixed.world(), f32: f32.world() });
    let mut decoder = Decoder::new();
    let mut buffer = [0; 4096];
    let mut now_us = 0;
    loop {
        if let Some(due_us) = session.due_us() {
            now_us = due_us.max(now_us);
            session.tick(&mut Clock(now_us), &mut ring);
        } else {
            for &byte in simulator::read(&mut buffer) {
                match decoder.push::<Command>(byte) {
                    Some(Ok(packet)) => session.handle(now_us, packet.sequence, &packet.message, &mut ring),
                    Some(Err(FrameError::Malformed { sequence })) => session.refuse_unknown(sequence, &mut ring),
                    // The host asks again where a frame is damaged.
                    Some(Err(_)) | None => {}
                }
            }
        }
        while !ring.is_empty() {
            let count = ring.read(&mut buffer);
            simulator::write(&buffer[..count]);
        }
    }
}

/// Stands still during a tick.
struct Clock(u64);

impl Stopwatch for Clock {
    fn now_us(&mut self) -> u64 {
        self.0
    }

    fn count(&mut self) -> u32 {
        0
    }
}
