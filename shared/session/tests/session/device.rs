//! A device with a clock and a line made of integers.

use flat_physics::{Fixed, Storage};
use flat_session::{Identity, Ring, Session, Stopwatch, Worlds};
use flat_wire::Decoder;
use flat_wire::message::{
    Command, Counter, Detail, Event, Flow, Frame, Level, Order, Reply, ScalarKind, SceneRequest, Status, StreamRequest,
    Variant,
};

/// by 10: the first two tell what a reading takes.
pub(crate) struct Readings {
    pub(crate) now_us: u64,
    pub(crate) tick_us: u64,
    pub(crate) count: u32,
}

impl Stopwatch for Readings {
    fn now_us(&mut self) -> u64 {
        let now_us = self.now_us;
        self.now_us += self.tick_us;
        now_us
    }

    fn count(&mut self) -> u32 {
        self.count += if self.count < 14 { 7 } else { 10 };
        self.count
    }
}

/// A device with a clock that the test sets and a line that the test reads.
pub(crate) struct Device {
    pub(crate) session: Session<'static>,
    pub(crate) ring: Box<Ring<8192>>,
    pub(crate) decoder: Decoder,
    pub(crate) now_us: u64,
    pub(crate) count: u32,
    pub(crate) sequence: u16,
    pub(crate) events: Vec<Event>,
}

impl Device {
    pub(crate) fn new() -> Self {
        let fixed = Box::leak(Box::new(Storage::<Fixed, 128, 1024, 2048>::new()));
        let f32 = Box::leak(Box::new(Storage::<f32, 32, 256>::new()));
        let f64 = Box::leak(Box::new(Storage::<f64, 0, 0>::new()));
        let identity = Identity { board: "test", build: "b", clock_hz: 1, counter: Counter::Instructions };
        let worlds = Worlds { fixed: fixed.world(), f32: f32.world(), f64: f64.world() };
        Self {
            session: Session::new(identity, worlds),
            ring: Box::new(Ring::new()),
            decoder: Decoder::new(),
            now_us: 1_000_000,
            count: 0,
            sequence: 100,
            events: Vec::new(),
        }
    }

    /// Takes up to so many bytes off the line.
    pub(crate) fn drain(&mut self, most: usize) {
        let mut bytes = vec![0; most];
        let count = self.ring.read(&mut bytes);
        for &byte in &bytes[..count] {
            if let Some(packet) = self.decoder.push::<Event>(byte) {
                self.events.push(packet.expect("nothing damages this line").message);
            }
        }
    }

    pub(crate) fn ask(&mut self, command: &Command) -> Reply {
        self.sequence += 1;
        self.session.handle(self.now_us, self.sequence, command, &mut *self.ring);
        self.drain(usize::from(u16::MAX));
        match self.events.pop() {
            Some(Event::Reply { to, reply }) if to == self.sequence => reply,
            other => panic!("{command:?} was answered by {other:?}"),
        }
    }

    pub(crate) fn refusal(&mut self, command: &Command) -> String {
        match self.ask(command) {
            Reply::Refused(reason) => reason.to_string(),
            other => panic!("was not refused but {other:?}"),
        }
    }

    pub(crate) fn load(&mut self, name: &str, bodies: u16) -> Reply {
        self.ask(&Command::Load(scene(name, bodies)))
    }

    pub(crate) fn start(&mut self, name: &str, bodies: u16, stream: StreamRequest, steps: u32) {
        assert!(matches!(self.load(name, bodies), Reply::Loaded(_)));
        assert_eq!(self.ask(&Command::Stream(stream)), Reply::Done);
        assert_eq!(self.ask(&Command::Run { steps }), Reply::Done);
    }

    pub(crate) fn tick(&mut self) {
        self.tick_at(0);
    }

    /// Ticks with a clock that advances by so much between two readings.
    pub(crate) fn tick_at(&mut self, tick_us: u64) {
        let mut readings = Readings { now_us: self.now_us, tick_us, count: self.count };
        self.session.tick(&mut readings, &mut *self.ring);
        (self.now_us, self.count) = (readings.now_us, readings.count);
    }

    pub(crate) fn status(&mut self) -> Status {
        match self.ask(&Command::Status) {
            Reply::Status(status) => status,
            other => panic!("the status is {other:?}"),
        }
    }

    /// Lets the device run until it has nothing to do; the line takes `rate` bytes after each tick.
    pub(crate) fn run(&mut self, rate: usize) {
        while let Some(due) = self.session.due_us() {
            self.now_us = due.max(self.now_us);
            self.tick();
            self.drain(rate);
        }
        self.drain(usize::from(u16::MAX));
    }

    pub(crate) fn frames(&self) -> impl Iterator<Item = &Frame> {
        self.events.iter().filter_map(|event| match event {
            Event::Frame(frame) => Some(frame),
            Event::Reply { .. } => None,
        })
    }

    pub(crate) fn steps(&self) -> Vec<(u32, u64)> {
        self.frames()
            .filter_map(|frame| match frame {
                Frame::Step { step, digest } => Some((*step, *digest)),
                _ => None,
            })
            .collect()
    }

    /// The end of the run: step, digest, details and steps dropped.
    pub(crate) fn finish(&self) -> (u32, u64, u32, u32) {
        match self.frames().last() {
            Some(&Frame::Finished { step, digest, dropped_detail, dropped_steps }) => {
                (step, digest, dropped_detail, dropped_steps)
            }
            other => panic!("the last frame is {other:?}"),
        }
    }
}

pub(crate) fn scene(name: &str, bodies: u16) -> SceneRequest {
    SceneRequest {
        name: name.try_into().unwrap(),
        bodies: Some(bodies),
        seed: None,
        order: Order::Forward,
        level: Level::Flat,
        scalar: ScalarKind::Fixed,
        iterations: None,
        effects: None,
        variant: Variant::default(),
    }
}

pub(crate) const FAST: usize = 8192;

pub(crate) fn everything(flow: Flow) -> StreamRequest {
    StreamRequest {
        detail: Detail::Full,
        every: 1,
        contacts: true,
        stage_digests: true,
        stage_times: true,
        timing: true,
        events: false,
        measures_every: 0,
        statistics_every: 1,
        flow,
    }
}

/// Digest after so many steps of a pit that nothing disturbs.
pub(crate) fn undisturbed(bodies: u16, steps: u32) -> u64 {
    let mut device = Device::new();
    device.start("ball_pit", bodies, StreamRequest::default(), steps);
    device.run(FAST);
    device.finish().1
}
