//! One message of each kind, with values from three sources: small and distinct, longest, random.

use flat_wire::message::*;
use proptest::prelude::*;

pub(crate) const ORDERS: &[Order] = &[Order::Forward, Order::Reverse, Order::Shuffled];
pub(crate) const LEVELS: &[Level] = &[Level::Flat, Level::Grounded, Level::Exact];
pub(crate) const MIXES: &[Mix] = &[Mix::None, Mix::Sizes, Mix::Masses, Mix::Shapes];
pub(crate) const PHASES: &[Phase] = &[Phase::Begin, Phase::Stay, Phase::End];
pub(crate) const SCALARS: &[ScalarKind] = &[ScalarKind::Fixed, ScalarKind::F32, ScalarKind::F64];
pub(crate) const DETAILS: &[Detail] = &[Detail::Digest, Detail::Positions, Detail::Full];
pub(crate) const FLOWS: &[Flow] = &[Flow::Drop, Flow::Hold];
pub(crate) const MISHAPS: &[Mishap] = &[
    Mishap::Panic,
    Mishap::IllegalInstruction,
    Mishap::StackOverflow,
    Mishap::PhysicsHangs,
    Mishap::LinkHangs,
    Mishap::Deaf,
    Mishap::LogStorm,
];
pub(crate) const CAUSES: &[Cause] = &[Cause::PowerOn, Cause::Fault, Cause::Watchdog, Cause::Brownout, Cause::Host];
pub(crate) const FAULTS: &[FaultKind] =
    &[FaultKind::Panic, FaultKind::Exception, FaultKind::StackOverflow, FaultKind::Watchdog];
pub(crate) const COUNTERS: &[Counter] = &[Counter::None, Counter::Instructions, Counter::Cycles, Counter::Nanoseconds];

/// Where the values of a message come from.
#[derive(Clone, Debug)]
pub(crate) enum Source {
    /// 1, 2, 3, so that no two fields are alike; short lists.
    Counting(u64),
    /// The values that take the most bytes; full lists.
    Longest,
    /// Drawn by proptest, then zeros.
    Random(Vec<u64>),
}

impl Source {
    pub(crate) fn random() -> impl Strategy<Value = Self> {
        // Shifted by a part of itself, a number is as likely to have few bits as many.
        let number = any::<u64>().prop_map(|number| number >> (number % 64));
        proptest::collection::vec(number, 0..400).prop_map(Self::Random)
    }

    fn u64(&mut self) -> u64 {
        match self {
            Self::Counting(last) => {
                *last += 1;
                *last
            }
            Self::Longest => u64::MAX,
            Self::Random(numbers) => numbers.pop().unwrap_or(0),
        }
    }

    fn u32(&mut self) -> u32 {
        self.u64() as u32
    }

    fn u16(&mut self) -> u16 {
        self.u64() as u16
    }

    fn u8(&mut self) -> u8 {
        self.u64() as u8
    }

    fn i16(&mut self) -> i16 {
        let zigzag = self.u16();
        (zigzag >> 1) as i16 ^ -((zigzag & 1) as i16)
    }

    fn bool(&mut self) -> bool {
        self.u64() % 2 == 1
    }

    /// The longest is the lowest, since signed numbers are sent zigzag: 0, -1, 1, -2, ...
    fn i64(&mut self) -> i64 {
        let zigzag = self.u64();
        (zigzag >> 1) as i64 ^ -((zigzag & 1) as i64)
    }

    fn i32(&mut self) -> i32 {
        let zigzag = self.u32();
        (zigzag >> 1) as i32 ^ -((zigzag & 1) as i32)
    }

    fn pick<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.u64() as usize % all.len()]
    }

    fn option<T>(&mut self, value: impl Fn(&mut Self) -> T) -> Option<T> {
        let some = match self {
            Self::Counting(_) | Self::Longest => true,
            Self::Random(_) => self.bool(),
        };
        some.then(|| value(self))
    }

    fn list<T, const N: usize>(&mut self, item: impl Fn(&mut Self) -> T) -> heapless::Vec<T, N> {
        let length = match self {
            Self::Counting(_) => 2,
            Self::Longest => N,
            Self::Random(_) => self.u64() as usize % (N + 1),
        };
        (0..length).map(|_| item(self)).collect()
    }

    fn text<const N: usize>(&mut self) -> heapless::String<N> {
        let letters: heapless::Vec<u8, N> = self.list(|source| b'a' + source.u8() % 26);
        heapless::String::from_utf8(letters).expect("letters are UTF-8")
    }

    fn point(&mut self) -> Point {
        Point { step: self.u32(), stage: self.u8() }
    }

    /// One command of each kind.
    pub(crate) fn commands(&mut self) -> Vec<Command> {
        vec![
            Command::Hello { protocol: self.u16() },
            Command::Load(SceneRequest {
                name: self.text(),
                bodies: self.option(Self::u16),
                seed: self.option(Self::u32),
                order: self.pick(ORDERS),
                level: self.pick(LEVELS),
                scalar: self.pick(SCALARS),
                iterations: self.option(Self::u8),
                effects: self.option(Self::u16),
                variant: Variant {
                    mirrored: self.bool(),
                    transposed: self.bool(),
                    phase: self.u16(),
                    shift: [self.i16(), self.i16()],
                    gravity: self.option(Self::i16),
                    gap: self.u8(),
                    mix: self.pick(MIXES),
                },
            }),
            Command::Stream(StreamRequest {
                detail: self.pick(DETAILS),
                every: self.u16(),
                contacts: self.bool(),
                stage_digests: self.bool(),
                stage_times: self.bool(),
                timing: self.bool(),
                events: self.bool(),
                measures_every: self.u16(),
                statistics_every: self.u16(),
                flow: self.pick(FLOWS),
            }),
            Command::Run { steps: self.u32() },
            Command::Stop,
            Command::Status,
            Command::Watch(self.point()),
            Command::Flip(Flip { point: self.point(), body: self.u16(), bit: self.u8() }),
            Command::Input { buttons: self.u8() },
            Command::Provoke(self.pick(MISHAPS)),
        ]
    }

    /// One reply of each kind.
    pub(crate) fn replies(&mut self) -> Vec<Reply> {
        vec![
            Reply::Hello(Hello {
                protocol: self.u16(),
                build: self.text(),
                board: self.text(),
                clock_hz: self.u32(),
                counter: self.pick(COUNTERS),
                capacities: self.list(|source| Capacity {
                    scalar: source.pick(SCALARS),
                    bodies: source.u16(),
                    contacts: source.u16(),
                }),
            }),
            Reply::Loaded(Loaded { bodies: self.u16(), digest: self.u64() }),
            Reply::Done,
            Reply::Refused(self.text()),
            Reply::Status(Status {
                step: self.u32(),
                remaining: self.u32(),
                backlog_us: self.u64(),
                received: self.u32(),
                damaged: self.u32(),
                dropped_detail: self.u32(),
                dropped_steps: self.u32(),
                late_us: self.u32(),
                took_us: self.u32(),
                overruns: self.u32(),
                stack: Stack { size: self.u32(), peak: self.u32() },
            }),
        ]
    }

    /// One frame of each kind.
    pub(crate) fn frames(&mut self) -> Vec<Frame> {
        vec![
            Frame::Step { step: self.u32(), digest: self.u64() },
            Frame::StageDigests { step: self.u32(), digests: [(); STAGES].map(|()| self.u64()) },
            Frame::StageTimes { step: self.u32(), counts: [(); STAGES].map(|()| self.u32()) },
            Frame::Timing { step: self.u32(), late_us: self.u32(), took_us: self.u32(), overruns: self.u32() },
            Frame::Bodies {
                at: self.point(),
                total: self.u16(),
                bodies: self.list(|source| BodyState {
                    slot: source.u16(),
                    position: [source.i64(), source.i64()],
                    velocity: [source.i64(), source.i64()],
                    remainder: [source.i16(), source.i16()],
                }),
            },
            Frame::Positions {
                step: self.u32(),
                total: self.u16(),
                bodies: self.list(|source| BodyPosition { slot: source.u16(), position: [source.i32(), source.i32()] }),
            },
            Frame::Contacts {
                at: self.point(),
                total: self.u16(),
                contacts: self.list(|source| ContactState {
                    bodies: [source.u16(), source.u16()],
                    normal: [source.i64(), source.i64()],
                    penetration: source.i64(),
                    impulse: [source.i64(), source.i64()],
                }),
            },
            Frame::Events {
                step: self.u32(),
                total: self.u16(),
                events: self.list(|source| ContactEvent {
                    phase: source.pick(PHASES),
                    bodies: [source.u16(), source.u16()],
                    tile: source.option(|source| [source.u16(), source.u16()]),
                    sensor: source.bool(),
                    normal: [source.i64(), source.i64()],
                    impulse: source.i64(),
                }),
            },
            Frame::Measures(Measures {
                step: self.u32(),
                kinetic: self.i64(),
                potential: self.i64(),
                momentum: [self.i64(), self.i64()],
                penetration: self.i64(),
                fastest: self.i64(),
            }),
            Frame::Statistics(Statistics {
                step: self.u32(),
                contacts: self.u16(),
                contacts_peak: self.u16(),
                contacts_lost: self.u32(),
                bodies: self.u16(),
                escaped: self.u16(),
                saturations: self.u32(),
                backlog_us: self.u64(),
                dropped_detail: self.u32(),
                dropped_steps: self.u32(),
            }),
            Frame::Finished {
                step: self.u32(),
                digest: self.u64(),
                dropped_detail: self.u32(),
                dropped_steps: self.u32(),
            },
            Frame::Started(self.pick(CAUSES)),
            Frame::Log { lost: self.u32(), bytes: self.list(Self::u8) },
            Frame::Fault(Fault {
                kind: self.pick(FAULTS),
                uptime_us: self.u64(),
                message: self.text(),
                place: self.option(|source| Place { file: source.text(), line: source.u32() }),
                backtrace: self.list(Self::u32),
            }),
        ]
    }

    /// One event of each kind.
    pub(crate) fn events(&mut self) -> Vec<Event> {
        let replies = self.replies();
        let replies = replies.into_iter().map(|reply| Event::Reply { to: self.u16(), reply });
        let mut events: Vec<_> = replies.collect();
        events.extend(self.frames().into_iter().map(Event::Frame));
        events
    }
}
