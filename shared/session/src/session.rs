//! The session: which scene runs, how far it is, what the host was promised.

use flat_physics::{Effects, Level, Pace, Scheduler, Stage};
use flat_scenes::{Buttons, Cue, Memory, Mix, Parameters, Scene, Variant};
use flat_wire::PROTOCOL_VERSION;
use flat_wire::message::{
    self, Command, Detail, Event, Flip, Frame, Loaded, Order, Point, Reply, STAGES, ScalarKind, SceneRequest, Stack,
    Status, StreamRequest,
};

use crate::any_world::{AnyWorld, Worlds, reason};
use crate::cut::cut;
use crate::demo::Demo;
use crate::identity::{Identity, Stopwatch};
use crate::link::LinkCounters;
use crate::punctuality::{Punctuality, Timing};
use crate::sink::{Class, Sender, Sink};
use crate::stream::{Dropped, Emission, Record};

/// How long to wait for the line before looking again, us.
const HELD_US: u64 = 500;

/// The device program.
#[derive(Debug)]
pub struct Session<'a> {
    identity: Identity,
    worlds: Worlds<'a>,
    scene: Option<Loadout>,
    run: Option<Run>,
    stream: StreamRequest,
    watch: Option<Point>,
    flip: Option<Flip>,
    sender: Sender,
    dropped: Dropped,
    link: LinkCounters,
    stack: Stack,
    /// Of the run under way, else of the last one.
    punctuality: Punctuality,
    /// Whether a host has ever asked anything; until then there are demos.
    hosted: bool,
    /// Number of the next demo.
    demo: usize,
}

/// The scene that is loaded.
#[derive(Clone, Copy, Debug)]
struct Loadout {
    scene: &'static Scene,
    parameters: Parameters,
    scalar: ScalarKind,
    effects: Effects,
    /// Steps done.
    step: u32,
    /// What the player holds down; none = nobody plays.
    buttons: Option<Buttons>,
    memory: Memory,
}

/// A run under way.
#[derive(Debug)]
struct Run {
    remaining: u32,
    scheduler: Scheduler,
    /// Device time up to which the scheduler knows, us.
    known_us: u64,
    /// Steps that are due and not yet done.
    owed: u8,
    /// Next stage of the step under way.
    stage: usize,
    /// Counts between two readings of the stopwatch with nothing in between, once measured.
    reading: Option<u32>,
    record: Record,
    /// Frames that must go out before the run goes on.
    emission: Option<Emission>,
    /// Whether the line was too slow for them.
    held: bool,
    /// Frames that had been dropped when the run began.
    dropped_before: Dropped,
}

impl<'a> Session<'a> {
    /// A session without a scene.
    pub fn new(identity: Identity, worlds: Worlds<'a>) -> Self {
        Self {
            identity,
            worlds,
            scene: None,
            run: None,
            stream: StreamRequest::default(),
            watch: None,
            flip: None,
            sender: Sender::new(),
            dropped: Dropped::default(),
            link: LinkCounters::default(),
            stack: Stack::default(),
            punctuality: Punctuality::default(),
            hosted: false,
            demo: 0,
        }
    }

    /// Runs the next scene of the catalogue, at its defaults and without frames, if none runs and no host has ever spoken.
    /// Returns what the last one came to.
    pub fn demonstrate(&mut self, now_us: u64) -> Option<Demo> {
        if self.hosted || self.run.is_some() {
            return None;
        }
        let ended = self.ended_demo();
        // A scene that there is no room for is passed over.
        for _ in flat_scenes::SCENES {
            let scene = &flat_scenes::SCENES[self.demo % flat_scenes::SCENES.len()];
            self.demo += 1;
            let request = SceneRequest { name: cut(format_args!("{}", scene.name)), ..SceneRequest::default() };
            if self.load(&request).and_then(|_| self.start(scene.steps, now_us)).is_ok() {
                break;
            }
        }
        ended
    }

    fn ended_demo(&self) -> Option<Demo> {
        let Loadout { scene, scalar, step, .. } = self.scene?;
        let digest = self.worlds.of(scalar)?.digest();
        let Timing { late_us, took_us } = self.punctuality.worst();
        Some(Demo { scene: scene.name, steps: step, digest, late_us, took_us })
    }

    /// Ends the demos: the host finds a device that has done nothing yet.
    fn welcome(&mut self) {
        if !self.hosted {
            (self.hosted, self.scene, self.run, self.punctuality) = (true, None, None, Punctuality::default());
        }
    }

    /// Carries out one command at device time `now_us` and answers it.
    pub fn handle(&mut self, now_us: u64, sequence: u16, command: &Command, sink: &mut dyn Sink) {
        self.welcome();
        let reply = match command {
            Command::Hello { .. } => Ok(Reply::Hello(self.identity.hello(self.worlds.capacities()))),
            Command::Load(request) => self.load(request).map(Reply::Loaded),
            Command::Stream(request) => {
                self.stream = *request;
                Ok(Reply::Done)
            }
            Command::Run { steps } => self.start(*steps, now_us),
            Command::Stop => {
                if let Some(run) = &mut self.run {
                    // A step under way is finished first.
                    run.remaining = run.remaining.min(u32::from(run.stage > 0));
                }
                Ok(Reply::Done)
            }
            Command::Status => Ok(Reply::Status(self.status())),
            Command::Watch(point) => self.check_ahead(*point).map(|()| {
                self.watch = Some(*point);
                Reply::Done
            }),
            Command::Input { buttons } => self.input(*buttons).map(|()| Reply::Done),
            Command::Flip(flip) => self.check_flip(flip).map(|()| {
                self.flip = Some(*flip);
                Reply::Done
            }),
            Command::Provoke(_) => Err(reason(format_args!("this build doesn't fail on request; a test build does"))),
        };
        self.reply(sequence, reply.unwrap_or_else(Reply::Refused), sink);
    }

    /// Answers a frame that arrived intact but isn't in this device's table of commands.
    pub fn refuse_unknown(&mut self, sequence: u16, sink: &mut dyn Sink) {
        self.welcome();
        let text = reason(format_args!("unknown command; this device speaks protocol {PROTOCOL_VERSION}"));
        self.reply(sequence, Reply::Refused(text), sink);
    }

    /// Answers a command that was carried out elsewhere.
    pub fn acknowledge(&mut self, sequence: u16, sink: &mut dyn Sink) {
        self.reply(sequence, Reply::Done, sink);
    }

    /// Takes note of the receiver's counters, for [`Status`].
    pub fn note_link(&mut self, counters: LinkCounters) {
        self.link = counters;
    }

    /// Takes note of how deep the stack was, for [`Status`].
    pub fn note_stack(&mut self, stack: Stack) {
        self.stack = stack;
    }

    /// Runs the steps that are due by the stopwatch's time and sends what the host wants of them.
    #[inline(never)] // so that firmware can place it, by its name, in memory without wait states
    pub fn tick(&mut self, stopwatch: &mut dyn Stopwatch, sink: &mut dyn Sink) {
        let Some(run) = &mut self.run else {
            return;
        };
        let now_us = stopwatch.now_us();
        run.scheduler.elapse(now_us.saturating_sub(run.known_us));
        run.known_us = run.known_us.max(now_us);
        if run.owed == 0 {
            run.owed = run.scheduler.take();
        }
        while self.advance(stopwatch, sink) {}
    }

    /// When [`tick`](Self::tick) next has something to do, device us; none = only after a command.
    pub fn due_us(&self) -> Option<u64> {
        let run = self.run.as_ref()?;
        let wait = match run {
            Run { held: true, .. } => HELD_US,
            Run { remaining: 0, .. } => 0,
            Run { scheduler, .. } => scheduler.until_due_us(),
        };
        Some(run.known_us + wait)
    }

    /// One move: send what waits, run a stage, or end the run. False when nothing is left to do for now.
    fn advance(&mut self, stopwatch: &mut dyn Stopwatch, sink: &mut dyn Sink) -> bool {
        let (Some(run), Some(scene)) = (&mut self.run, &mut self.scene) else {
            return false;
        };
        let Some(world) = self.worlds.of_mut(scene.scalar) else {
            return false; // a scene is only loaded into a world that is there
        };
        if let Some(emission) = &mut run.emission {
            run.held = !emission.send(world, &run.record, &mut self.dropped, &mut self.sender, sink);
            if run.held {
                return false;
            }
            run.emission = None;
        }
        if run.remaining == 0 {
            run.held = self.hosted && !finish(scene.step, run, self.dropped, &mut self.sender, sink);
            if !run.held {
                self.run = None;
            }
            return false;
        }
        if run.owed == 0 {
            return false;
        }

        let (step, stage) = (scene.step + 1, Stage::ALL[run.stage]);
        if run.stage == 0 {
            self.punctuality.begin(stopwatch.now_us());
        }
        if run.stage == 0 {
            let cue = Cue { step, buttons: scene.buttons };
            if !world.direct(scene.scene, &scene.parameters, cue, &mut scene.memory) {
                // The host is promised a number of steps: an early end tells it that the scene has come to grief.
                run.remaining = 1;
            }
        }
        // What reading the counter takes is no part of a stage.
        let reading = *run.reading.get_or_insert_with(|| {
            let before = stopwatch.count();
            stopwatch.count().wrapping_sub(before)
        });
        let start = stopwatch.count();
        // Telling events changes nothing but what is told.
        let told = if self.stream.events { Effects::EVENTS } else { Effects::NONE };
        world.run(stage, scene.effects | told);
        run.record.counts[run.stage] = stopwatch.count().wrapping_sub(start).saturating_sub(reading);
        let here = Point { step, stage: run.stage as u8 };
        if let Some(flip) = self.flip.take_if(|flip| flip.point == here) {
            world.flip(flip.body, flip.bit);
        }
        let ends_step = run.stage + 1 == STAGES;
        if ends_step || self.stream.stage_digests {
            run.record.digests[run.stage] = world.digest();
        }
        let watched = self.watch.take_if(|point| *point == here).is_some();
        if ends_step {
            (run.stage, run.owed, run.remaining) = (0, run.owed - 1, run.remaining - 1);
            scene.step = step;
            self.punctuality.end(stopwatch.now_us());
            run.record.punctuality = self.punctuality;
            run.record.backlog_us = run.scheduler.backlog_us();
            let request = if watched { everything(self.stream) } else { self.stream };
            run.emission = self.hosted.then(|| Emission::of_step(step, request));
        } else {
            run.stage += 1;
            if watched {
                run.emission = Some(Emission::of_point(here, everything(self.stream)));
            }
        }
        true
    }

    fn load(&mut self, request: &SceneRequest) -> Result<Loaded, message::Reason> {
        let scene = flat_scenes::find(&request.name)
            .ok_or_else(|| reason(format_args!("there is no scene named {:?}", request.name.as_str())))?;
        let order = match request.order {
            Order::Forward => flat_scenes::Order::Forward,
            Order::Reverse => flat_scenes::Order::Reverse,
            Order::Shuffled => flat_scenes::Order::Shuffled,
        };
        let level = match request.level {
            message::Level::Flat => Level::Flat,
            message::Level::Grounded => Level::Grounded,
            message::Level::Exact => Level::Exact,
        };
        let parameters = scene
            .parameters(request.bodies, request.seed, order)
            .and_then(|parameters| scene.vary(parameters, variant(&request.variant)))
            .map_err(|error| reason(format_args!("{error}")))?;
        let missing = || reason(format_args!("this device does without that number format"));
        let world = self.worlds.of_mut(request.scalar).ok_or_else(missing)?;
        let effects = match request.effects {
            None => scene.effects,
            Some(bits) => {
                Effects::from_bits(bits).ok_or_else(|| reason(format_args!("effects {bits:#x} hold an unknown bit")))?
            }
        };
        world.load(scene, &parameters, level, request.iterations)?;
        let loaded = Loaded { bodies: world.statistics().bodies, digest: world.digest() };
        let (scalar, memory) = (request.scalar, Memory::default());
        self.scene = Some(Loadout { scene, parameters, scalar, effects, step: 0, buttons: None, memory });
        (self.run, self.watch, self.flip) = (None, None, None);
        (self.dropped, self.punctuality) = (Dropped::default(), Punctuality::default());
        Ok(loaded)
    }

    fn input(&mut self, buttons: u8) -> Result<(), message::Reason> {
        match &mut self.scene {
            Some(scene) if scene.scene.demo.is_some() => {
                let known = Buttons::from_bits(buttons);
                let held = known.ok_or_else(|| reason(format_args!("buttons {buttons:#x} hold an unknown bit")))?;
                scene.buttons = Some(held);
                Ok(())
            }
            Some(scene) => Err(reason(format_args!("{} has no player", scene.scene.name))),
            None => Err(reason(format_args!("no scene is loaded"))),
        }
    }

    fn start(&mut self, steps: u32, now_us: u64) -> Result<Reply, message::Reason> {
        let scene = self.scene.ok_or_else(|| reason(format_args!("no scene is loaded")))?;
        if let Some(run) = &self.run {
            return Err(reason(format_args!("a run is under way, {} steps remain", run.remaining)));
        }
        if steps == 0 || scene.step.checked_add(steps).is_none() {
            return Err(reason(format_args!("steps is {steps}, must be 1..={}", u32::MAX - scene.step)));
        }
        self.punctuality = Punctuality::new(now_us);
        self.run = Some(Run {
            remaining: steps,
            scheduler: Scheduler::new(Pace::DEFAULT),
            known_us: now_us,
            owed: 0,
            stage: 0,
            reading: None,
            record: Record::new(self.worlds.of(scene.scalar).map_or(0, AnyWorld::digest)),
            emission: None,
            held: false,
            dropped_before: self.dropped,
        });
        Ok(Reply::Done)
    }

    fn status(&self) -> Status {
        let worst = self.punctuality.worst();
        Status {
            step: self.scene.map_or(0, |scene| scene.step),
            remaining: self.run.as_ref().map_or(0, |run| run.remaining),
            backlog_us: self.run.as_ref().map_or(0, |run| run.scheduler.backlog_us()),
            received: self.link.received,
            damaged: self.link.damaged,
            dropped_detail: self.dropped.detail,
            dropped_steps: self.dropped.steps,
            late_us: worst.late_us,
            took_us: worst.took_us,
            overruns: self.punctuality.overruns(),
            stack: self.stack,
        }
    }

    /// Whether a point is a stage that is still to come.
    fn check_ahead(&self, point: Point) -> Result<(), message::Reason> {
        let scene = self.scene.ok_or_else(|| reason(format_args!("no scene is loaded")))?;
        let last = STAGES - 1;
        if usize::from(point.stage) > last {
            return Err(reason(format_args!("stage is {}, must be 0..={last}", point.stage)));
        }
        let next_stage = self.run.as_ref().map_or(0, |run| run.stage);
        if point.step <= scene.step || (point.step == scene.step + 1 && usize::from(point.stage) < next_stage) {
            return Err(reason(format_args!("step {} stage {} has passed", point.step, point.stage)));
        }
        Ok(())
    }

    fn check_flip(&self, flip: &Flip) -> Result<(), message::Reason> {
        self.check_ahead(flip.point)?;
        let scalar = self.scene.map_or(ScalarKind::Fixed, |scene| scene.scalar);
        let bits = if scalar == ScalarKind::F64 { 64 } else { 32 };
        if flip.bit >= bits {
            return Err(reason(format_args!("bit is {}, must be 0..={}", flip.bit, bits - 1)));
        }
        if !self.worlds.of(scalar).is_some_and(|world| world.holds(flip.body)) {
            return Err(reason(format_args!("there is no body in slot {}", flip.body)));
        }
        Ok(())
    }

    fn reply(&mut self, to: u16, reply: Reply, sink: &mut dyn Sink) {
        if !self.sender.offer(Class::Reply, &Event::Reply { to, reply }, sink) {
            // The host asked faster than it reads; it will ask again.
            sink.skip();
            self.dropped.steps = self.dropped.steps.saturating_add(1);
        }
    }
}

fn variant(variant: &message::Variant) -> Variant {
    let message::Variant { mirrored, transposed, phase, shift, gravity, gap, mix } = *variant;
    let mix = match mix {
        message::Mix::None => Mix::None,
        message::Mix::Sizes => Mix::Sizes,
        message::Mix::Masses => Mix::Masses,
        message::Mix::Shapes => Mix::Shapes,
    };
    Variant { mirrored, transposed, phase, shift, gravity, gap, mix }
}

/// Sends the end of a run; false if there was no room yet.
fn finish(step: u32, run: &Run, dropped: Dropped, sender: &mut Sender, sink: &mut dyn Sink) -> bool {
    let before = run.dropped_before;
    let frame = Frame::Finished {
        step,
        digest: run.record.digest(),
        dropped_detail: dropped.detail - before.detail,
        dropped_steps: dropped.steps - before.steps,
    };
    sender.offer(Class::Reply, &Event::Frame(frame), sink)
}

/// The host's wishes with all bodies and contacts on top.
fn everything(request: StreamRequest) -> StreamRequest {
    StreamRequest { detail: Detail::Full, every: 1, contacts: true, ..request }
}
