//! What a device streams.

use heapless::{String, Vec};
use serde::{Deserialize, Serialize};

use super::{
    BACKTRACE, BODIES_PER_FRAME, CONTACTS_PER_FRAME, EVENTS_PER_FRAME, LOG_BYTES, POSITIONS_PER_FRAME, Point, STAGES,
};

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
    /// Durations of each stage of a step, in the unit of [`Hello::counter`](super::Hello::counter).
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
