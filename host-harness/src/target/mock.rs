//! The mock: the device program that the boards run, in a thread of rig, on a virtual clock.

use std::sync::OnceLock;
use std::sync::mpsc::{self, Receiver, SyncSender, TryRecvError};
use std::thread;

use flat_physics::{Fixed, Storage};
use flat_session::{Identity, Ring, Session, Stopwatch, Worlds};
use flat_wire::Decoder;
use flat_wire::message::{Command, Counter};

use super::link::{Link, Peer};
use crate::error::Error;
use crate::firmware::workspace;

/// Most bodies of any number format: room for every built-in scene at its largest.
const BODIES: usize = 4096;
/// Most contacts.
const CONTACTS: usize = 20_480;
/// Most tiles of a map.
const TILES: usize = 4096;
/// Room for the frames of one step in full detail.
const RING: usize = 512 * 1024;
/// The worlds and the ring live on the thread's stack.
const STACK: usize = 16 << 20;
/// Chunks that the mock may be ahead of its reader.
const AHEAD: usize = 64;

/// Starts a mock of its own.
///
/// # Errors
/// If the system has no thread to spare.
pub fn open() -> Result<Link, Error> {
    let (outgoing, commands) = mpsc::channel();
    let (frames, incoming) = mpsc::sync_channel(AHEAD);
    thread::Builder::new()
        .name("mock".into())
        .stack_size(STACK)
        .spawn(move || device(&commands, &frames))
        .map_err(|error| Error::target(format!("cannot start the mock: {error}"), ""))?;
    Ok(Link::over_channels(outgoing, incoming, Box::new(Mock)))
}

struct Mock;

impl Peer for Mock {
    fn obituary(&mut self) -> String {
        "the mock panicked; its message is above".into()
    }
}

/// The virtual clock, us. It stands still during a step; instructions and cycles are only counted where there is a chip.
struct Clock(u64);

impl Stopwatch for Clock {
    fn now_us(&mut self) -> u64 {
        self.0
    }

    fn count(&mut self) -> u32 {
        0
    }
}

/// A device's main loop: commands in, the steps that are due, frames out.
fn device(commands: &Receiver<Vec<u8>>, frames: &SyncSender<Vec<u8>>) {
    let mut fixed = Storage::<Fixed, BODIES, CONTACTS, TILES>::new();
    let mut f32 = Storage::<f32, BODIES, CONTACTS, TILES>::new();
    let mut f64 = Storage::<f64, BODIES, CONTACTS, TILES>::new();
    let worlds = Worlds { fixed: fixed.world(), f32: f32.world(), f64: f64.world() };
    let identity = Identity { board: "mock", build: build_id(), clock_hz: 0, counter: Counter::None };
    let mut session = Session::new(identity, worlds);
    let mut ring = Ring::<RING>::new();
    let mut decoder = Decoder::new();
    let mut now_us = 0;
    loop {
        // Time stands still until something is due: the clock is virtual.
        let received = match session.due_us() {
            Some(_) => commands.try_recv(),
            None => commands.recv().map_err(|_| TryRecvError::Disconnected),
        };
        match received {
            Ok(bytes) => {
                for byte in bytes {
                    if let Some(Ok(packet)) = decoder.push::<Command>(byte) {
                        session.handle(now_us, packet.sequence, &packet.message, &mut ring);
                    }
                }
            }
            Err(TryRecvError::Disconnected) => return,
            Err(TryRecvError::Empty) => {
                now_us = session.due_us().map_or(now_us, |due| due.max(now_us));
                session.tick(&mut Clock(now_us), &mut ring);
            }
        }
        if !hand_over(&mut ring, frames) {
            return;
        }
    }
}

/// Empties the ring; false if nobody reads any more.
fn hand_over(ring: &mut Ring<RING>, frames: &SyncSender<Vec<u8>>) -> bool {
    while !ring.is_empty() {
        let mut chunk = vec![0; 16 * 1024];
        let count = ring.read(&mut chunk);
        chunk.truncate(count);
        if frames.send(chunk).is_err() {
            return false;
        }
    }
    true
}

/// The sources that rig was built from; a mock of unknown sources still runs.
fn build_id() -> &'static str {
    static BUILD: OnceLock<String> = OnceLock::new();
    BUILD.get_or_init(|| workspace::build_id().unwrap_or_default())
}
