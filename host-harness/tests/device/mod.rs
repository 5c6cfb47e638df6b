//! A device for tests: the real session behind a TCP socket, and a line that does to its frames what lines do.

use std::io::{ErrorKind, Read, Write};
use std::net::TcpListener;
use std::thread;
use std::time::{Duration, Instant};

use flat_physics::{Fixed, Storage};
use flat_session::{Identity, Ring, Session, Stopwatch, Worlds};
use flat_wire::message::{self, Cause, Command, Counter, Event, FaultKind, Frame, Hello, Place, Reply};
use flat_wire::{Decoder, MAX_FRAME, PROTOCOL_VERSION};

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// Nothing.
    None,
    /// Nothing is ever said.
    Silence,
    /// Only bytes that are no frames.
    Garbage,
    /// Bytes that are no frames, without end.
    Flood,
    /// Bytes that are no frames before each one that is.
    Noise,
    /// Hello says the next version of the protocol.
    NextProtocol,
    /// Frames are intact, but none is in this version's table.
    ForeignTable,
    /// The frame of this step is lost.
    Lost(u32),
    /// The digest of this step is wrong, the first time.
    Slip(u32),
    /// The device hangs after this step.
    Hang(u32),
    /// The connection closes after this step.
    Death(u32),
    /// Opening the line resets the board: for a while it hears nothing, and its boot loader speaks at another speed.
    Boot,
    /// A boot loader that finds no program, in plain text.
    Unprogrammed,
    /// The device panics after this step and starts anew.
    Panic(u32),
    /// The device starts anew after this step without a word about why.
    Brownout(u32),
    /// It says hello, but first what its former life ended in.
    FormerLife,
    /// It logs something after this step, whatever that means.
    Logs(u32),
}

/// Starts a device that serves one connection; returns its target for the command line.
pub(crate) fn start(fault: Fault) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = listener.local_addr().expect("the port just bound");
    thread::spawn(move || {
        let (stream, _) = listener.accept().expect("rig connects");
        stream.set_nodelay(true).expect("an open socket");
        serve(stream, fault);
    });
    format!("tcp:{address}")
}

/// Runs the session on a virtual clock until the other side closes the line.
pub(crate) fn serve(mut wire: impl Read + Write, fault: Fault) {
    match fault {
        Fault::Flood => {
            while wire.write_all(&[0x55; 4096]).is_ok() {}
            return;
        }
        Fault::Boot => boot(&mut wire),
        Fault::Unprogrammed => {
            // Until rig has heard enough.
            while wire
                .write_all(b"rst:0x1 (POWERON),boot:0xc (SPI_FAST_FLASH_BOOT)\r\ninvalid header: 0xffffffff\r\n")
                .is_ok()
            {
                thread::sleep(Duration::from_millis(20));
            }
            return;
        }
        _ => {}
    }
    let mut fixed = Box::new(Storage::<Fixed, 64, 256>::new());
    let mut f32 = Box::new(Storage::<f32, 64, 256>::new());
    let mut f64 = Box::new(Storage::<f64, 64, 256>::new());
    let worlds = Worlds { fixed: fixed.world(), f32: f32.world(), f64: f64.world() };
    let identity = Identity { board: "test", build: "of the test", clock_hz: 1_000_000, counter: Counter::None };
    let mut session = Session::new(identity, worlds);
    let mut ring = Box::new(Ring::<65_536>::new());
    let mut decoder = Decoder::new();
    let mut line = Line { wire, fault, decoder: Decoder::new(), sequence: 0, open: true, hung: false };
    if fault == Fault::FormerLife {
        line.transmit(last_words());
        line.transmit(Event::Frame(Frame::Started(Cause::Fault)));
    }
    let mut now_us = 0;
    while line.open {
        if let Some(due) = session.due_us() {
            now_us = due.max(now_us);
            session.tick(&mut Clock(now_us), ring.as_mut());
        } else {
            for byte in line.receive() {
                if let Some(Ok(packet)) = decoder.push::<Command>(byte) {
                    session.handle(now_us, packet.sequence, &packet.message, ring.as_mut());
                }
            }
        }
        let mut bytes = [0; 4096];
        while !ring.is_empty() {
            let count = ring.read(&mut bytes);
            line.send(&bytes[..count]);
        }
    }
}

/// A boot loader's 700 ms: noise without a frame in it comes out, and what comes in is lost.
fn boot(wire: &mut (impl Read + Write)) {
    let until = Instant::now() + Duration::from_millis(700);
    let noise: Vec<u8> = (0..400_u32).map(|index| (index.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    wire.write_all(&noise).expect("rig listens");
    let mut lost = [0; 1024];
    while let Some(left) = until.checked_duration_since(Instant::now()).filter(|left| !left.is_zero()) {
        thread::sleep(left.min(Duration::from_millis(100)));
        // Rig says hello every 300 ms.
        let _ = wire.read(&mut lost).expect("rig still asks");
    }
    // Firmware begins with a delimiter.
    wire.write_all(&[0]).expect("rig still listens");
}

/// What a device that panicked says last.
fn last_words() -> Event {
    let place = Some(Place { file: "firmware/src/tasks/simulate.rs".try_into().expect("short"), line: 42 });
    let backtrace = [0x4038_1234, 0x4201_5678].into_iter().collect();
    let message = "index 7 is out of bounds".try_into().expect("short");
    Event::Frame(Frame::Fault(message::Fault {
        kind: FaultKind::Panic,
        uptime_us: 1_500_000,
        message,
        place,
        backtrace,
    }))
}

/// The virtual clock, us.
struct Clock(u64);

impl Stopwatch for Clock {
    fn now_us(&mut self) -> u64 {
        self.0
    }

    fn count(&mut self) -> u32 {
        0
    }
}

/// The line with its fault.
struct Line<T> {
    wire: T,
    fault: Fault,
    decoder: Decoder,
    sequence: u16,
    open: bool,
    hung: bool,
}

impl<T: Read + Write> Line<T> {
    fn receive(&mut self) -> Vec<u8> {
        let mut buffer = [0; 1024];
        match self.wire.read(&mut buffer) {
            Ok(0) => self.open = false,
            Ok(count) => return buffer[..count].to_vec(),
            Err(error) if error.kind() == ErrorKind::TimedOut => thread::sleep(Duration::from_millis(1)),
            Err(_) => self.open = false,
        }
        Vec::new()
    }

    /// Takes the session's bytes apart into events, which is where faults are put in.
    fn send(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            if let Some(packet) = self.decoder.push::<Event>(byte) {
                self.transmit(packet.expect("the session's frames are intact").message);
            }
        }
    }

    fn transmit(&mut self, mut event: Event) {
        if self.fault == Fault::NextProtocol
            && let Event::Reply { reply: Reply::Hello(Hello { protocol, .. }), .. } = &mut event
        {
            *protocol = PROTOCOL_VERSION + 1;
        }
        let step = if let Event::Frame(Frame::Step { step, .. }) = &event { Some(*step) } else { None };
        if let (Fault::Slip(slip), Event::Frame(Frame::Step { step, digest })) = (self.fault, &mut event)
            && *step == slip
        {
            *digest ^= 1;
            self.fault = Fault::None;
        }
        let sequence = self.sequence;
        self.sequence = sequence.wrapping_add(1);
        let mut frame = [0; MAX_FRAME];
        let frame = match self.fault {
            Fault::ForeignTable => flat_wire::encode(sequence, &u64::MAX, &mut frame),
            _ => flat_wire::encode(sequence, &event, &mut frame),
        };
        let frame = frame.expect("every event fits a frame");
        let sent = match self.fault {
            _ if self.hung => Ok(()),
            Fault::Silence => Ok(()),
            Fault::Lost(lost) if step == Some(lost) => Ok(()),
            Fault::Garbage => self.wire.write_all(b"Guru Meditation Error\0"),
            Fault::Noise => self.wire.write_all(b"\x03noise\0").and_then(|()| self.wire.write_all(frame)),
            _ => self.wire.write_all(frame),
        };
        self.hung |= matches!(self.fault, Fault::Hang(last) if step == Some(last));
        // Rig may have closed the line, having heard enough.
        self.open &= sent.is_ok() && !matches!(self.fault, Fault::Death(last) if step == Some(last));
        let said = match self.fault {
            Fault::Panic(last) if step == Some(last) => last_words(),
            Fault::Brownout(last) if step == Some(last) => Event::Frame(Frame::Started(Cause::Brownout)),
            Fault::Logs(after) if step == Some(after) => {
                let bytes = b"\x01\x2a\x7a\0".iter().copied().collect();
                Event::Frame(Frame::Log { lost: 3, bytes })
            }
            _ => return,
        };
        self.fault = Fault::None;
        self.transmit(said);
    }
}
