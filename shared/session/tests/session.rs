//! The device program, driven by a clock and a line made of integers.

use flat_physics::{Fixed, Storage};
use flat_session::{Class, Identity, LinkCounters, Ring, Session, Sink, Stopwatch, Worlds};
use flat_wire::message::{
    Command, Counter, Detail, Event, Flip, Flow, Frame, Level, Mishap, Order, Point, Reply, ScalarKind, SceneRequest,
    Stack, Status, StreamRequest, Variant,
};
use flat_wire::{Decoder, PROTOCOL_VERSION};

/// A clock that advances with every reading, by the same time, and a counter that does so by 7, from its third reading on
/// by 10: the first two tell what a reading takes.
struct Readings {
    now_us: u64,
    tick_us: u64,
    count: u32,
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
struct Device {
    session: Session<'static>,
    ring: Box<Ring<8192>>,
    decoder: Decoder,
    now_us: u64,
    count: u32,
    sequence: u16,
    events: Vec<Event>,
}

impl Device {
    fn new() -> Self {
        let fixed = Box::leak(Box::new(Storage::<Fixed, 128, 1024>::new()));
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
    fn drain(&mut self, most: usize) {
        let mut bytes = vec![0; most];
        let count = self.ring.read(&mut bytes);
        for &byte in &bytes[..count] {
            if let Some(packet) = self.decoder.push::<Event>(byte) {
                self.events.push(packet.expect("nothing damages this line").message);
            }
        }
    }

    fn ask(&mut self, command: &Command) -> Reply {
        self.sequence += 1;
        self.session.handle(self.now_us, self.sequence, command, &mut *self.ring);
        self.drain(usize::from(u16::MAX));
        match self.events.pop() {
            Some(Event::Reply { to, reply }) if to == self.sequence => reply,
            other => panic!("{command:?} was answered by {other:?}"),
        }
    }

    fn refusal(&mut self, command: &Command) -> String {
        match self.ask(command) {
            Reply::Refused(reason) => reason.to_string(),
            other => panic!("was not refused but {other:?}"),
        }
    }

    fn load(&mut self, name: &str, bodies: u16) -> Reply {
        self.ask(&Command::Load(scene(name, bodies)))
    }

    fn start(&mut self, name: &str, bodies: u16, stream: StreamRequest, steps: u32) {
        assert!(matches!(self.load(name, bodies), Reply::Loaded(_)));
        assert_eq!(self.ask(&Command::Stream(stream)), Reply::Done);
        assert_eq!(self.ask(&Command::Run { steps }), Reply::Done);
    }

    fn tick(&mut self) {
        self.tick_at(0);
    }

    /// Ticks with a clock that advances by so much between two readings.
    fn tick_at(&mut self, tick_us: u64) {
        let mut readings = Readings { now_us: self.now_us, tick_us, count: self.count };
        self.session.tick(&mut readings, &mut *self.ring);
        (self.now_us, self.count) = (readings.now_us, readings.count);
    }

    fn status(&mut self) -> Status {
        match self.ask(&Command::Status) {
            Reply::Status(status) => status,
            other => panic!("the status is {other:?}"),
        }
    }

    /// Lets the device run until it has nothing to do; the line takes `rate` bytes after each tick.
    fn run(&mut self, rate: usize) {
        while let Some(due) = self.session.due_us() {
            self.now_us = due.max(self.now_us);
            self.tick();
            self.drain(rate);
        }
        self.drain(usize::from(u16::MAX));
    }

    fn frames(&self) -> impl Iterator<Item = &Frame> {
        self.events.iter().filter_map(|event| match event {
            Event::Frame(frame) => Some(frame),
            Event::Reply { .. } => None,
        })
    }

    fn steps(&self) -> Vec<(u32, u64)> {
        self.frames()
            .filter_map(|frame| match frame {
                Frame::Step { step, digest } => Some((*step, *digest)),
                _ => None,
            })
            .collect()
    }

    /// The end of the run: step, digest, details and steps dropped.
    fn finish(&self) -> (u32, u64, u32, u32) {
        match self.frames().last() {
            Some(&Frame::Finished { step, digest, dropped_detail, dropped_steps }) => {
                (step, digest, dropped_detail, dropped_steps)
            }
            other => panic!("the last frame is {other:?}"),
        }
    }
}

fn scene(name: &str, bodies: u16) -> SceneRequest {
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

const FAST: usize = 8192;

fn everything(flow: Flow) -> StreamRequest {
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
fn undisturbed(bodies: u16, steps: u32) -> u64 {
    let mut device = Device::new();
    device.start("ball_pit", bodies, StreamRequest::default(), steps);
    device.run(FAST);
    device.finish().1
}

#[test]
fn hello_tells_protocol_identity_and_the_room_of_each_number_format_that_has_any() {
    let Reply::Hello(hello) = Device::new().ask(&Command::Hello { protocol: 99 }) else { panic!() };
    assert_eq!((hello.protocol, &*hello.board, &*hello.build), (PROTOCOL_VERSION, "test", "b"));
    let room: Vec<_> = hello.capacities.iter().map(|c| (c.scalar, c.bodies, c.contacts)).collect();
    assert_eq!(room, [(ScalarKind::Fixed, 128, 1024), (ScalarKind::F32, 32, 256)]);
}

#[test]
fn what_cannot_be_done_is_refused_with_the_reason() {
    let mut device = Device::new();
    let at = |step, stage| Point { step, stage };
    assert_eq!(device.refusal(&Command::Run { steps: 1 }), "no scene is loaded");
    let provoked = device.refusal(&Command::Provoke(Mishap::Panic));
    assert_eq!(provoked, "this build doesn't fail on request; a test build does");
    assert_eq!(device.refusal(&Command::Watch(at(1, 0))), "no scene is loaded");
    assert_eq!(device.refusal(&Command::Load(scene("attic", 1))), "there is no scene named \"attic\"");
    assert_eq!(device.refusal(&Command::Load(scene("drop", 0))), "drop: bodies is 0, must be 1..=200");
    let too_many = device.refusal(&Command::Load(scene("ball_pit", 200)));
    assert_eq!(too_many, "ball_pit: needs 204 bodies and 1416 contacts, there is room for 128 and 1024");

    device.start("ball_pit", 10, StreamRequest::default(), 5);
    assert_eq!(device.refusal(&Command::Run { steps: 1 }), "a run is under way, 5 steps remain");
    device.run(FAST);
    assert_eq!(device.refusal(&Command::Run { steps: 0 }), "steps is 0, must be 1..=4294967290");
    assert_eq!(device.refusal(&Command::Run { steps: u32::MAX }), "steps is 4294967295, must be 1..=4294967290");
    assert_eq!(device.refusal(&Command::Watch(at(5, 5))), "step 5 stage 5 has passed");
    assert_eq!(device.refusal(&Command::Watch(at(6, 6))), "stage is 6, must be 0..=5");
    let flip = |body, bit| Command::Flip(Flip { point: at(6, 0), body, bit });
    assert_eq!(device.refusal(&flip(14, 0)), "there is no body in slot 14");
    assert_eq!(device.refusal(&flip(0, 32)), "bit is 32, must be 0..=31");
}

#[test]
fn a_frame_that_this_table_does_not_know_is_answered() {
    let mut device = Device::new();
    device.session.refuse_unknown(42, &mut *device.ring);
    device.drain(FAST);
    let Some(Event::Reply { to: 42, reply: Reply::Refused(reason) }) = device.events.pop() else { panic!() };
    assert_eq!(&*reason, "unknown command; this device speaks protocol 1");
}

#[test]
fn the_clock_alone_paces_the_steps() {
    let mut device = Device::new();
    device.start("drop", 1, StreamRequest::default(), 1000);
    for _ in 0..1_000 {
        device.now_us += 1_000;
        device.tick();
        device.drain(FAST);
    }
    assert_eq!(device.steps().len(), 60);
    // A second passes unnoticed: it is caught up with, four steps at a time, and nothing is lost.
    device.now_us += 1_000_000;
    for expected in [64, 68, 72] {
        device.tick();
        device.drain(FAST);
        assert_eq!(device.steps().len(), expected);
    }
    let status = device.status();
    assert_eq!((status.step, status.remaining, status.backlog_us), (72, 928, 800_000));
    // The first of the last four, the 69th, was due at 69/60 s and ran at 2 s.
    assert_eq!((status.late_us, status.overruns), (983_333, 12));
}

#[test]
fn how_time_passes_changes_no_digest() {
    let reference = undisturbed(20, 120);
    for chunk_us in [1_000, 16_000, 33_000, 2_000_000] {
        let mut device = Device::new();
        device.start("ball_pit", 20, StreamRequest::default(), 120);
        while device.session.due_us().is_some() {
            device.now_us += chunk_us;
            device.tick();
            device.drain(FAST);
        }
        assert_eq!(device.finish(), (120, reference, 0, 0), "{chunk_us} us");
    }
}

#[test]
fn a_slow_line_drops_details_first_and_delays_no_step() {
    let mut device = Device::new();
    device.start("ball_pit", 50, everything(Flow::Drop), 120);
    let begun = device.now_us;
    device.run(100); // 6 kB/s: enough for the steps alone
    assert_eq!(device.now_us - begun, 2_000_000, "the last step was late");
    let (step, digest, details, steps) = device.finish();
    assert_eq!((step, digest, steps), (120, undisturbed(50, 120), 0));
    assert!(details > 1000, "{details} details dropped");
    assert_eq!(device.steps().len(), 120);
    assert_eq!(device.decoder.counters().missing, details);
}

#[test]
fn a_stuck_line_loses_steps_but_never_the_end_of_the_run() {
    let mut device = Device::new();
    device.start("ball_pit", 50, everything(Flow::Drop), 600);
    device.run(0);
    let (step, digest, details, steps) = device.finish();
    assert_eq!((step, digest), (600, undisturbed(50, 600)));
    assert!(details > 0 && steps > 0);
    // Each step has its Step and its Statistics frame.
    let statistics = device.frames().filter(|frame| matches!(frame, Frame::Statistics(_))).count();
    assert_eq!(device.steps().len() + statistics + steps as usize, 1200);
    assert_eq!(device.decoder.counters().missing, details + steps);
}

#[test]
fn a_host_that_wants_everything_gets_everything_however_slow_the_line() {
    let mut device = Device::new();
    device.start("ball_pit", 50, everything(Flow::Hold), 40);
    device.run(300);
    assert_eq!(device.finish(), (40, undisturbed(50, 40), 0, 0));
    assert_eq!(device.decoder.counters().missing, 0);
    assert_eq!(device.steps().iter().map(|(step, _)| *step).collect::<Vec<_>>(), (1..=40).collect::<Vec<_>>());

    let (mut bodies, mut last_slot, mut contacts) = (0, None, (0, 0));
    for frame in device.frames() {
        match frame {
            Frame::Step { step, digest } => assert_eq!(device.steps()[*step as usize - 1].1, *digest),
            Frame::StageDigests { step, digests } => assert_eq!(digests[5], device.steps()[*step as usize - 1].1),
            Frame::StageTimes { counts, .. } => assert_eq!(*counts, [3; 6], "without the 7 of the reading itself"),
            Frame::Bodies { total, bodies: some, at } => {
                assert_eq!((*total, at.stage), (54, 5));
                for body in some {
                    assert!(last_slot < Some(body.slot));
                    last_slot = Some(body.slot).filter(|&slot| slot < 53);
                }
                bodies += some.len();
            }
            Frame::Contacts { total, contacts: some, .. } => {
                contacts = (contacts.0 + some.len(), contacts.1.max(*total));
            }
            Frame::Statistics(statistics) => {
                assert_eq!((statistics.bodies, statistics.contacts_lost, statistics.escaped), (54, 0, 0));
                assert!(statistics.contacts_peak >= statistics.contacts);
            }
            Frame::Timing { late_us, took_us, .. } => assert_eq!((*late_us, *took_us), (0, 0)),
            _ => {}
        }
    }
    assert_eq!(bodies, 40 * 54);
    assert!(contacts.0 > usize::from(contacts.1), "{contacts:?}");
}

#[test]
fn positions_come_in_sixteenths_every_so_many_steps() {
    let mut device = Device::new();
    let stream = StreamRequest { detail: Detail::Positions, every: 3, ..StreamRequest::default() };
    device.start("drop", 40, stream, 10);
    device.run(FAST);
    let mut seen = Vec::new();
    for frame in device.frames() {
        if let Frame::Positions { step, total, bodies } = frame {
            assert_eq!(*total, 41);
            seen.extend(bodies.iter().map(|body| (*step, body.slot)));
            // Bodies start at y = -106 and have fallen less than 4 px after 9 steps.
            assert!(bodies.iter().all(|body| body.slot == 0 || (-106 * 16..-102 * 16).contains(&body.position[1])));
        }
    }
    let expected: Vec<_> = [3, 6, 9].into_iter().flat_map(|step| (0..41).map(move |slot| (step, slot))).collect();
    assert_eq!(seen, expected);
}

#[test]
fn a_run_can_be_stopped_and_continued() {
    let mut device = Device::new();
    device.start("ball_pit", 20, StreamRequest::default(), 1_000_000);
    for _ in 0..50 {
        device.now_us += 16_667;
        device.tick();
    }
    assert_eq!(device.ask(&Command::Stop), Reply::Done);
    device.run(FAST);
    assert_eq!(device.finish().0, 50);
    assert_eq!(device.ask(&Command::Stop), Reply::Done);
    assert_eq!(device.ask(&Command::Run { steps: 70 }), Reply::Done);
    device.run(FAST);
    assert_eq!(device.finish(), (120, undisturbed(20, 120), 0, 0));
}

#[test]
fn a_flipped_bit_changes_the_digest_from_its_stage_on() {
    let trace = |flip: Option<Flip>| {
        let mut device = Device::new();
        assert!(matches!(device.load("ball_pit", 20), Reply::Loaded(_)));
        let stream = StreamRequest { stage_digests: true, flow: Flow::Hold, ..StreamRequest::default() };
        device.ask(&Command::Stream(stream));
        if let Some(flip) = flip {
            assert_eq!(device.ask(&Command::Flip(flip)), Reply::Done);
        }
        device.ask(&Command::Run { steps: 10 });
        device.run(FAST);
        let digests = device.frames().filter_map(|frame| match frame {
            Frame::StageDigests { digests, .. } => Some(*digests),
            _ => None,
        });
        digests.flatten().collect::<Vec<_>>()
    };
    let flip = Flip { point: Point { step: 4, stage: 2 }, body: 9, bit: 0 };
    let (good, bad) = (trace(None), trace(Some(flip)));
    let first = good.iter().zip(&bad).position(|(a, b)| a != b);
    assert_eq!(first, Some(3 * 6 + 2));
}

#[test]
fn a_watched_point_shows_all_bodies_and_contacts_in_the_middle_of_a_step() {
    let mut device = Device::new();
    assert!(matches!(device.load("ball_pit", 50), Reply::Loaded(_)));
    device.ask(&Command::Stream(StreamRequest { flow: Flow::Hold, ..StreamRequest::default() }));
    for (steps, point) in [(30, Point { step: 20, stage: 0 }), (30, Point { step: 40, stage: 5 })] {
        assert_eq!(device.ask(&Command::Watch(point)), Reply::Done);
        device.ask(&Command::Run { steps });
        device.events.clear();
        device.run(100);
        let (mut slots, mut contacts) = (Vec::new(), Vec::new());
        for frame in device.frames() {
            match frame {
                Frame::Bodies { at, bodies, .. } if *at == point => slots.extend(bodies.iter().map(|body| body.slot)),
                Frame::Contacts { at, total, contacts: some } if *at == point => contacts.push((*total, some.len())),
                Frame::Bodies { at, .. } | Frame::Contacts { at, .. } => panic!("{at:?}"),
                _ => {}
            }
        }
        assert_eq!(slots, (0..54).collect::<Vec<_>>());
        let total = contacts.first().expect("balls touch").0;
        assert_eq!(contacts.iter().map(|(_, some)| some).sum::<usize>(), usize::from(total));
    }
}

#[test]
fn loading_ends_a_run_and_forgets_what_was_counted() {
    let mut device = Device::new();
    device.start("ball_pit", 50, everything(Flow::Drop), 100);
    for _ in 0..50 {
        device.now_us += 16_667;
        device.tick();
    }
    assert!(matches!(device.load("drop", 1), Reply::Loaded(_)));
    device.session.note_link(LinkCounters { received: 5, damaged: 2 });
    device.session.note_stack(Stack { size: 100, peak: 60 });
    let status = device.status();
    let stack = Stack { size: 100, peak: 60 };
    assert_eq!(status, Status { received: 5, damaged: 2, stack, ..Status::default() });
    assert_eq!(device.session.due_us(), None);
}

#[test]
fn a_sink_that_takes_nothing_harms_nobody() {
    struct Closed;
    impl Sink for Closed {
        fn sequence(&self) -> u16 {
            0
        }

        fn skip(&mut self) {}

        fn push(&mut self, _class: Class, _frame: &[u8]) -> bool {
            false
        }
    }
    let mut device = Device::new();
    device.start("drop", 1, everything(Flow::Drop), 10);
    for _ in 0..30 {
        device.now_us += 16_667;
        device.session.tick(&mut Readings { now_us: device.now_us, tick_us: 0, count: 0 }, &mut Closed);
        device.session.handle(device.now_us, 1, &Command::Status, &mut Closed);
    }
    // Then the line works again, and the end of the run arrives.
    device.run(FAST);
    assert_eq!(device.finish().0, 10);
}

#[test]
fn lateness_counts_from_when_a_step_was_due_and_duration_from_its_beginning() {
    let mut device = Device::new();
    let stream = StreamRequest { timing: true, ..StreamRequest::default() };
    device.start("drop", 1, stream, 4);
    let begun = device.now_us;
    // The n-th step is due at n/60 s, rounded up to a whole microsecond.
    for (now_us, tick_us) in [(16_667, 10), (33_340, 5), (50_000, 17_000)] {
        device.now_us = begun + now_us;
        device.tick_at(tick_us);
    }
    device.run(FAST);
    let timings: Vec<_> = device
        .frames()
        .filter_map(|frame| match *frame {
            Frame::Timing { step, late_us, took_us, overruns } => Some((step, late_us, took_us, overruns)),
            _ => None,
        })
        .collect();
    // A tick reads the clock when it starts, when a step begins, and when it ends; the third step ends when the fourth
    // has long been due, and the fourth when the fifth has.
    assert_eq!(timings, [(1, 10, 10, 0), (2, 11, 5, 0), (3, 17_000, 17_000, 1), (4, 34_333, 0, 2)]);
    let status = device.status();
    assert_eq!((status.late_us, status.took_us, status.overruns), (34_333, 17_000, 2));
}

#[test]
fn a_device_without_a_host_runs_one_scene_after_the_other_in_silence() {
    let mut device = Device::new();
    let mut scenes = 0;
    while scenes < 3 {
        if device.session.due_us().is_none() {
            device.session.demonstrate(device.now_us);
            scenes += 1;
        }
        device.now_us = device.session.due_us().expect("a demo runs").max(device.now_us);
        device.tick();
    }
    assert!(device.ring.is_empty());
}

#[test]
fn a_host_finds_a_device_that_has_done_nothing_yet() {
    let mut device = Device::new();
    device.session.demonstrate(device.now_us);
    device.now_us += 100_000;
    device.tick();
    assert_eq!(device.status(), Status::default());
    device.session.demonstrate(device.now_us);
    assert_eq!(device.session.due_us(), None, "a demo began although there is a host");
    assert_eq!(device.refusal(&Command::Run { steps: 1 }), "no scene is loaded");
}

#[test]
fn a_scene_is_varied_and_directed_as_it_would_be_without_a_session() {
    let churn = flat_scenes::find("churn").unwrap();
    let variant = flat_scenes::Variant { mirrored: true, phase: 7, ..flat_scenes::Variant::NONE };
    let parameters = churn.vary(churn.defaults, variant).unwrap();
    let mut storage = Box::new(Storage::<Fixed, 128, 1024>::new());
    let mut world = storage.world();
    churn.build(&parameters, flat_physics::Level::Grounded, &mut world).unwrap();
    for step in 1..=50 {
        churn.direct(&parameters, flat_scenes::Cue { step, buttons: 0 }, &mut world).unwrap();
        flat_physics::step(&mut world, churn.effects);
    }

    let mut device = Device::new();
    let variant = Variant { mirrored: true, phase: 7, ..Variant::default() };
    let request = SceneRequest { bodies: None, level: Level::Grounded, variant, ..scene("churn", 0) };
    assert!(matches!(device.ask(&Command::Load(request.clone())), Reply::Loaded(_)));
    assert_eq!(device.ask(&Command::Run { steps: 50 }), Reply::Done);
    device.run(FAST);
    assert_eq!(device.finish().1, flat_physics::digest(&world));

    assert_eq!(device.refusal(&Command::Input { buttons: 1 }), "churn has no player");
    let gapped = SceneRequest { variant: Variant { gap: 3, ..Variant::default() }, ..request };
    assert_eq!(device.refusal(&Command::Load(gapped)), "churn: there is no room for a gap");
}
