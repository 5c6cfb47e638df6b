//! What a host may ask.

use serde::{Deserialize, Serialize};

use super::Name;

/// Host to device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Command {
    /// Asks who is there; answered by [`Reply::Hello`](super::Reply::Hello) whatever the version.
    Hello {
        /// Version of the table that the host speaks: [`crate::PROTOCOL_VERSION`].
        protocol: u16,
    },
    /// Builds a scene, discarding the present one; answered by [`Reply::Loaded`](super::Reply::Loaded).
    Load(SceneRequest),
    /// Says what to stream from now on.
    Stream(StreamRequest),
    /// Runs so many more steps, then sends [`Frame::Finished`](super::Frame::Finished).
    Run {
        /// Steps to run.
        steps: u32,
    },
    /// Ends a run before its time; [`Frame::Finished`](super::Frame::Finished) follows.
    Stop,
    /// Asks for [`Reply::Status`](super::Reply::Status).
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
    /// Stage, 0..[`STAGES`](super::STAGES), in pipeline order.
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
    /// Some 1000 log messages as fast as they can be written; no fault, and answered by [`Reply::Done`](super::Reply::Done).
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
    /// More passes, and the time of impact for whoever is fast.
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

/// What to stream. [`Frame::Step`](super::Frame::Step) and [`Frame::Finished`](super::Frame::Finished) always are.
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
    /// [`Frame::Timing`](super::Frame::Timing) for every step.
    pub timing: bool,
    /// Also what began, stayed and ended touching, every step.
    pub events: bool,
    /// [`Frame::Measures`](super::Frame::Measures) every so many steps; 0 = never.
    pub measures_every: u16,
    /// [`Frame::Statistics`](super::Frame::Statistics) every so many steps; 0 = never.
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
