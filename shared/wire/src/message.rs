//! The whole protocol as one table: what a host may ask, what a device answers, what it streams.
//!
//! Messages carry raw numbers and names; what they mean to an engine is the session's business.

use heapless::{String, Vec};
use serde::{Deserialize, Serialize};

/// A scene's name.
pub type Name = String<24>;
/// Text that explains a refusal.
pub type Reason = String<96>;

/// Bytes of log messages in one [`Frame::Log`].
pub const LOG_BYTES: usize = 240;
/// Addresses in a [`Fault`].
pub const BACKTRACE: usize = 24;

/// Stages of one physics step; the length of every per-stage array.
pub const STAGES: usize = 6;
/// Bodies in one [`Frame::Bodies`], as many as [`crate::MAX_FRAME`] holds at their longest.
pub const BODIES_PER_FRAME: usize = 9;
/// Bodies in one [`Frame::Positions`].
pub const POSITIONS_PER_FRAME: usize = 36;
/// Contacts in one [`Frame::Contacts`], as many as [`crate::MAX_FRAME`] holds at their longest.
pub const CONTACTS_PER_FRAME: usize = 8;
/// Contact events in one [`Frame::Events`], as many as [`crate::MAX_FRAME`] holds at their longest.
pub const EVENTS_PER_FRAME: usize = 8;

/// Host to device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Command {
    /// Asks who is there; answered by [`Reply::Hello`] whatever the version.
    Hello {
        /// Version of the table that the host speaks: [`crate::PROTOCOL_VERSION`].
        protocol: u16,
    },
    /// Builds a scene, discarding the present one; answered by [`Reply::Loaded`].
    Load(SceneRequest),
    /// Says what to stream from now on.
    Stream(StreamRequest),
    /// Runs so many more steps, then sends [`Frame::Finished`].
    Run {
        /// Steps to run.
        steps: u32,
    },
    /// Ends a run before its time; [`Frame::Finished`] follows.
    Stop,
    /// Asks for [`Reply::Status`].
    Status,
    /// Sends all bodies and contacts, in full, right after the given stage of the given step.
    Watch(Point),
    /// Fault injection: inverts one bit of one body right after the given stage, once.
    Flip(Flip),
    /// What a player holds down, from the next step on; a scene without a player refuses it.
    Input {
        /// Left, right, jump, down: a bit each, from the lowest.
        buttons: u8,
    },
    /// Makes the device fail, so that what follows can be checked; only test builds obey, and answer by failing.
    Provoke(Mishap),
}

/// A place in a run: after which stage of which step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Point {
    /// Step, counted from 1.
    pub step: u32,
    /// Stage, 0..[`STAGES`], in pipeline order.
    pub stage: u8,
}

/// A bit to invert.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Flip {
    /// When.
    pub point: Point,
    /// Body, by slot.
    pub body: u16,
    /// Bit of the body's horizontal velocity as the engine stores it.
    pub bit: u8,
}

/// A way to fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mishap {
    /// A panic.
    Panic,
    /// An instruction that no processor has.
    IllegalInstruction,
    /// A recursion without end.
    StackOverflow,
    /// The physics task stops coming back.
    PhysicsHangs,
    /// A task that serves the link stops coming back.
    LinkHangs,
    /// Interrupts stay off: only a watchdog in hardware ends that.
    Deaf,
    /// Some 1000 log messages as fast as they can be written; no fault, and answered by [`Reply::Done`].
    LogStorm,
}

/// A scene and the parameters to build it with.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneRequest {
    /// The scene's name.
    pub name: Name,
    /// Body count; none = the scene's default.
    pub bodies: Option<u16>,
    /// Seed of the scene's random numbers; none = the scene's default.
    pub seed: Option<u32>,
    /// Order in which bodies are inserted.
    pub order: Order,
    /// Accuracy level.
    pub level: Level,
    /// Number format.
    pub scalar: ScalarKind,
    /// Passes of the solver over the contacts; none = the level's.
    pub iterations: Option<u8>,
    /// Effects that are on, a bit each as the engine numbers them; none = what the scene calls for.
    pub effects: Option<u16>,
    /// Departures from the scene as it is written.
    pub variant: Variant,
}

/// The same scene, seen otherwise: a result that hangs on one lucky arrangement is none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Variant {
    /// Left and right change places.
    pub mirrored: bool,
    /// x and y change places; gravity then pulls to the right.
    pub transposed: bool,
    /// Shifted by this part of a px, in 1/65 536.
    pub phase: u16,
    /// Shifted by whole px.
    pub shift: [i16; 2],
    /// Strength of gravity, px/s2; none = the scene's.
    pub gravity: Option<i16>,
    /// Space between stacked bodies at the start, px.
    pub gap: u8,
    /// Mixed bodies.
    pub mix: Mix,
}

/// What varies from body to body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mix {
    /// What the scene says.
    #[default]
    None,
    /// Sizes too.
    Sizes,
    /// Masses too.
    Masses,
    /// Circles among boxes, boxes among circles.
    Shapes,
}

/// Insertion order of a scene's bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Order {
    /// As the scene lists them.
    #[default]
    Forward,
    /// Last first.
    Reverse,
    /// A permutation drawn from the seed.
    Shuffled,
}

/// Accuracy level of the solver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Level {
    /// Plain impulses, the cheapest.
    Flat,
    /// Accumulated impulses and a pass from the ground up.
    #[default]
    Grounded,
    /// More passes, and the time of impact for every body.
    Exact,
}

/// Number format of the engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ScalarKind {
    /// Fixed point.
    #[default]
    Fixed,
    /// IEEE 754 binary32.
    F32,
    /// IEEE 754 binary64.
    F64,
}

/// What to stream. [`Frame::Step`] and [`Frame::Finished`] always are.
#[allow(clippy::struct_excessive_bools, reason = "each a wish of its own, on or off")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct StreamRequest {
    /// Level of detail of the state.
    pub detail: Detail,
    /// State and contacts every so many steps; 0 = never.
    pub every: u16,
    /// Also the contacts, whenever state is sent.
    pub contacts: bool,
    /// Also a digest after each stage of every step.
    pub stage_digests: bool,
    /// Also each stage's duration, every step.
    pub stage_times: bool,
    /// [`Frame::Timing`] for every step.
    pub timing: bool,
    /// Also what began, stayed and ended touching, every step.
    pub events: bool,
    /// [`Frame::Measures`] every so many steps; 0 = never.
    pub measures_every: u16,
    /// [`Frame::Statistics`] every so many steps; 0 = never.
    pub statistics_every: u16,
    /// What happens when the link is slower than the stream.
    pub flow: Flow,
}

/// How much of the state is sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Detail {
    /// The digest alone.
    #[default]
    Digest,
    /// Positions to 1/16 px, no velocities: enough to draw.
    Positions,
    /// Every bit of position and velocity.
    Full,
}

/// What gives way when the link is slower than the stream.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Flow {
    /// Physics keeps its time; frames are dropped, state first, and counted.
    #[default]
    Drop,
    /// Physics holds its next step until the step's frames fit: nothing is lost, real time is.
    Hold,
}

/// Device to host.
#[allow(clippy::large_enum_variant, reason = "there is no heap to box the larger ones in")]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Event {
    /// Answer to the command with this sequence number.
    Reply {
        /// Sequence number of the command's frame.
        to: u16,
        /// The answer.
        reply: Reply,
    },
    /// Part of the stream.
    Frame(Frame),
}

/// Answers to commands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Reply {
    /// Who is there.
    Hello(Hello),
    /// The scene stands.
    Loaded(Loaded),
    /// Done, nothing to say.
    Done,
    /// Not done, nothing changed; why.
    Refused(Reason),
    /// The present state of affairs.
    Status(Status),
}

/// Identity and limits of a device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hello {
    /// [`crate::PROTOCOL_VERSION`] of the device.
    pub protocol: u16,
    /// Identifies the sources that the device was built from.
    pub build: String<32>,
    /// Board name.
    pub board: String<16>,
    /// CPU clock in Hz; 0 = unknown.
    pub clock_hz: u32,
    /// What [`Frame::StageTimes`] counts.
    pub counter: Counter,
    /// Capacities, one entry for each number format that the device can run.
    pub capacities: Vec<Capacity, 3>,
}

/// Room for one number format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Capacity {
    /// The number format.
    pub scalar: ScalarKind,
    /// Most bodies.
    pub bodies: u16,
    /// Most contacts.
    pub contacts: u16,
}

/// Unit of stage times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Counter {
    /// The device has none: all zero.
    #[default]
    None,
    /// Retired instructions.
    Instructions,
    /// CPU cycles.
    Cycles,
    /// Nanoseconds.
    Nanoseconds,
}

/// A scene as built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Loaded {
    /// Bodies in the world, static ones included.
    pub bodies: u16,
    /// Digest before the first step.
    pub digest: u64,
}

/// The session's counters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Status {
    /// Steps done since the scene was loaded.
    pub step: u32,
    /// Steps still to run.
    pub remaining: u32,
    /// Time that has passed but isn't simulated yet, in us.
    pub backlog_us: u64,
    /// Frames received intact.
    pub received: u32,
    /// Frames received damaged, and discarded.
    pub damaged: u32,
    /// Detail frames dropped because the link was slow: state, contacts, times.
    pub dropped_detail: u32,
    /// Step and statistics frames dropped because the link was slow.
    pub dropped_steps: u32,
    /// Worst lateness of any step since the run began, us, as in [`Frame::Timing`].
    pub late_us: u32,
    /// Longest step since the run began, us.
    pub took_us: u32,
    /// Steps of the run that ended after the next one was due.
    pub overruns: u32,
    /// The stack that all tasks and interrupts share.
    pub stack: Stack,
}

/// Use of a stack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stack {
    /// Size in bytes; 0 = the device doesn't know.
    pub size: u32,
    /// Most bytes ever in use since the device started.
    pub peak: u32,
}

/// The stream.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Frame {
    /// A step is done.
    Step {
        /// Step, counted from 1.
        step: u32,
        /// Digest of the state after it.
        digest: u64,
    },
    /// Digests after each stage of a step.
    StageDigests {
        /// Step.
        step: u32,
        /// One digest a stage, in pipeline order.
        digests: [u64; STAGES],
    },
    /// Durations of each stage of a step, in the unit of [`Hello::counter`].
    StageTimes {
        /// Step.
        step: u32,
        /// One count a stage, in pipeline order.
        counts: [u32; STAGES],
    },
    /// When a step ran, by the device's microsecond clock.
    Timing {
        /// Step.
        step: u32,
        /// From the moment at which it was due to the moment at which it began, us; `u32::MAX` stands for more.
        late_us: u32,
        /// From its beginning to its end, us, digests and measurements included.
        took_us: u32,
        /// Steps of the run so far that ended after the next one was due.
        overruns: u32,
    },
    /// Some bodies, every bit.
    Bodies {
        /// Where in the run.
        at: Point,
        /// Bodies in the whole state, over all its frames.
        total: u16,
        /// This frame's share, by ascending slot.
        bodies: Vec<BodyState, BODIES_PER_FRAME>,
    },
    /// Some bodies, to 1/16 px.
    Positions {
        /// Step.
        step: u32,
        /// Bodies in the whole state, over all its frames.
        total: u16,
        /// This frame's share, by ascending slot.
        bodies: Vec<BodyPosition, POSITIONS_PER_FRAME>,
    },
    /// Some contacts.
    Contacts {
        /// Where in the run.
        at: Point,
        /// Contacts of the step, over all its frames.
        total: u16,
        /// This frame's share, in solver order.
        contacts: Vec<ContactState, CONTACTS_PER_FRAME>,
    },
    /// What began, stayed and ended touching in a step.
    Events {
        /// Step.
        step: u32,
        /// Events of the step, over all its frames.
        total: u16,
        /// This frame's share, in the engine's order.
        events: Vec<ContactEvent, EVENTS_PER_FRAME>,
    },
    /// Sums over all bodies after a step.
    Measures(Measures),
    /// Counters of the run so far.
    Statistics(Statistics),
    /// The run has ended.
    Finished {
        /// Last step done.
        step: u32,
        /// Digest of the state after it.
        digest: u64,
        /// Detail frames dropped during the run.
        dropped_detail: u32,
        /// Step and statistics frames dropped during the run.
        dropped_steps: u32,
    },
    /// The device has started; its first frame, but for the [`Frame::Fault`] of its former life.
    Started(Cause),
    /// Log messages.
    Log {
        /// Messages lost so far because they came faster than the link took them.
        lost: u32,
        /// The next part of a stream in defmt's encoding, cut anywhere; the ELF that runs is its key.
        bytes: Vec<u8, LOG_BYTES>,
    },
    /// The device's last words: it restarts.
    Fault(Fault),
}

/// Why a device has started.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Cause {
    /// It knows no reason: power came on, or somebody reset it.
    #[default]
    PowerOn,
    /// It restarted itself, after a [`Fault`].
    Fault,
    /// A watchdog in hardware had waited for too long: even interrupts didn't run any more.
    Watchdog,
    /// The supply voltage had dropped.
    Brownout,
    /// The host reset it, through its USB port.
    Host,
}

/// Why a device gave up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fault {
    /// The sort of it.
    pub kind: FaultKind,
    /// Device time, us since it started.
    pub uptime_us: u64,
    /// What was wrong, cut to what fits.
    pub message: String<160>,
    /// Where in the sources, if it knows.
    pub place: Option<Place>,
    /// Addresses in the code, innermost first: where it happened, then return addresses. May hold calls that had ended.
    pub backtrace: Vec<u32, BACKTRACE>,
}

/// Sorts of faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FaultKind {
    /// The program found itself in a state that must not be.
    Panic,
    /// The processor refused an instruction or an address.
    Exception,
    /// The stack was full.
    StackOverflow,
    /// A task didn't come back.
    Watchdog,
}

/// A place in the sources.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Place {
    /// File; of a long path, the end.
    pub file: String<96>,
    /// Line, counted from 1.
    pub line: u32,
}

/// One body's state as raw bits of the number format: fixed point as the integer, floats as IEEE bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BodyState {
    /// Slot.
    pub slot: u16,
    /// Centre.
    pub position: [i64; 2],
    /// Velocity per step.
    pub velocity: [i64; 2],
    /// What rounding the position has carried over to the next step.
    pub remainder: [i16; 2],
}

/// One body's position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BodyPosition {
    /// Slot.
    pub slot: u16,
    /// Centre in 1/16 px.
    pub position: [i32; 2],
}

/// One contact as raw bits of the number format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ContactState {
    /// Slots of the two bodies.
    pub bodies: [u16; 2],
    /// Unit normal, from the first to the second.
    pub normal: [i64; 2],
    /// Overlap along the normal.
    pub penetration: i64,
    /// Change of relative velocity that the solver applied: along the normal, along the tangent.
    pub impulse: [i64; 2],
}

/// Something that began, stayed or ended touching.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ContactEvent {
    /// Which of the three.
    pub phase: Phase,
    /// Slots of the two bodies; the second is `u16::MAX` for a tile.
    pub bodies: [u16; 2],
    /// Column and row of the tile.
    pub tile: Option<[u16; 2]>,
    /// Whether one of the two is a sensor.
    pub sensor: bool,
    /// Unit normal from the first to the second, raw bits of the number format.
    pub normal: [i64; 2],
    /// Change of relative velocity along the normal, raw bits.
    pub impulse: i64,
}

/// Phase of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// New in this step.
    #[default]
    Begin,
    /// As in the step before.
    Stay,
    /// Over since this step.
    End,
}

/// Sums over all rigid bodies, rounded to the unit's 1/65 536.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Measures {
    /// Step.
    pub step: u32,
    /// Kinetic energy, mass x px2/s2.
    pub kinetic: i64,
    /// Potential energy in the world's gravity, mass x px2/s2, 0 at the origin.
    pub potential: i64,
    /// Momentum, mass x px/s.
    pub momentum: [i64; 2],
    /// Deepest overlap of any contact, px.
    pub penetration: i64,
    /// Largest velocity component, px/s.
    pub fastest: i64,
}

/// Counters of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    /// Step.
    pub step: u32,
    /// Contacts of this step.
    pub contacts: u16,
    /// Most contacts of any step so far.
    pub contacts_peak: u16,
    /// Contacts lost to a full pool so far.
    pub contacts_lost: u32,
    /// Bodies in the world.
    pub bodies: u16,
    /// Bodies disabled because they left the coordinate range.
    pub escaped: u16,
    /// Values that were held at the end of their range so far.
    pub saturations: u32,
    /// Time that has passed but isn't simulated yet, in us.
    pub backlog_us: u64,
    /// Detail frames dropped since the scene was loaded.
    pub dropped_detail: u32,
    /// Step and statistics frames dropped since the scene was loaded.
    pub dropped_steps: u32,
}
