//! What is sent of a step, frame by frame, and what happens when the line is full.

use flat_physics::Stage;
use flat_wire::message::{Detail, Event, Flow, Frame, Point, STAGES, Statistics, StreamRequest};

use crate::any_world::AnyWorld;
use crate::punctuality::Punctuality;
use crate::sink::{Class, Sender, Sink};

/// Measurements of the step under way.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Record {
    /// Digest after each stage that was asked for, and always after the last.
    pub(crate) digests: [u64; STAGES],
    pub(crate) counts: [u32; STAGES],
    pub(crate) backlog_us: u64,
    pub(crate) punctuality: Punctuality,
}

impl Record {
    /// Nothing measured yet; the state has this digest.
    pub(crate) fn new(digest: u64) -> Self {
        let mut digests = [0; STAGES];
        digests[STAGES - 1] = digest;
        Self { digests, ..Self::default() }
    }

    /// Digest after the last step that has ended.
    pub(crate) fn digest(&self) -> u64 {
        self.digests[STAGES - 1]
    }
}

/// Frames dropped because the line was slow.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Dropped {
    pub(crate) detail: u32,
    pub(crate) steps: u32,
}

/// Frames on their way out: which comes next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emission {
    at: Point,
    next: Part,
    /// What the host asked for.
    request: StreamRequest,
    /// Whether this is the end of a step.
    ends_step: bool,
}

/// The frames of a step, in the order in which they are sent.
#[derive(Clone, Copy, Debug)]
enum Part {
    Step,
    StageDigests,
    StageTimes,
    Timing,
    /// From this slot on.
    Bodies(u16),
    /// From this place on.
    Contacts(u16),
    /// From this one on.
    Events(u16),
    Measures,
    Statistics,
    End,
}

impl Emission {
    /// Everything that the host wants of a step that has ended.
    pub(crate) fn of_step(step: u32, request: StreamRequest) -> Self {
        let at = Point { step, stage: Stage::Events.index() as u8 };
        Self { at, next: Part::Step, request, ends_step: true }
    }

    /// Bodies and contacts in the middle of a step.
    pub(crate) fn of_point(at: Point, request: StreamRequest) -> Self {
        Self { at, next: Part::Bodies(0), request, ends_step: false }
    }

    /// Sends what there is room for. True when all is sent, or dropped where the host allows it; false to be called again.
    pub(crate) fn send(
        &mut self,
        world: &dyn AnyWorld,
        record: &Record,
        dropped: &mut Dropped,
        sender: &mut Sender,
        sink: &mut dyn Sink,
    ) -> bool {
        loop {
            let Some((class, frame, next)) = self.frame(world, record, *dropped) else {
                return true;
            };
            if !sender.offer(class, &Event::Frame(frame), sink) {
                if self.request.flow == Flow::Hold {
                    return false;
                }
                sink.skip();
                let count = if class == Class::Detail { &mut dropped.detail } else { &mut dropped.steps };
                *count = count.saturating_add(1);
            }
            self.next = next;
        }
    }

    /// The next frame that is wanted, and what comes after it.
    fn frame(&self, world: &dyn AnyWorld, record: &Record, dropped: Dropped) -> Option<(Class, Frame, Part)> {
        let Point { step, .. } = self.at;
        let mut part = self.next;
        loop {
            part = match part {
                Part::Step => {
                    let digest = record.digest();
                    return Some((Class::Step, Frame::Step { step, digest }, Part::StageDigests));
                }
                Part::StageDigests if self.request.stage_digests => {
                    let digests = record.digests;
                    return Some((Class::Detail, Frame::StageDigests { step, digests }, Part::StageTimes));
                }
                Part::StageDigests => Part::StageTimes,
                Part::StageTimes if self.request.stage_times => {
                    let counts = record.counts;
                    return Some((Class::Detail, Frame::StageTimes { step, counts }, Part::Timing));
                }
                Part::StageTimes => Part::Timing,
                Part::Timing if self.request.timing => {
                    return Some((Class::Detail, record.punctuality.frame(step), Part::Bodies(0)));
                }
                Part::Timing => Part::Bodies(0),
                Part::Bodies(from) => match self.state(world, from) {
                    Some((frame, next)) => return Some((Class::Detail, frame, Part::Bodies(next))),
                    None => Part::Contacts(0),
                },
                Part::Contacts(from) => match self.contacts(world, from) {
                    Some((frame, next)) => return Some((Class::Detail, frame, Part::Contacts(next))),
                    None => Part::Events(0),
                },
                Part::Events(from) => match self.events(world, from) {
                    Some((frame, next)) => return Some((Class::Detail, frame, Part::Events(next))),
                    None => Part::Measures,
                },
                Part::Measures if self.ends_step && every(self.request.measures_every, step) => {
                    return Some((Class::Detail, Frame::Measures(world.measures()), Part::Statistics));
                }
                Part::Measures => Part::Statistics,
                Part::Statistics if self.ends_step && every(self.request.statistics_every, step) => {
                    let statistics = statistics(world, record, dropped);
                    return Some((Class::Step, Frame::Statistics(statistics), Part::End));
                }
                Part::Statistics => Part::End,
                Part::End => return None,
            };
        }
    }

    /// The bodies from a slot on, and where the next frame continues; none if there are no more or they aren't wanted.
    fn state(&self, world: &dyn AnyWorld, from: u16) -> Option<(Frame, u16)> {
        if !every(self.request.every, self.at.step) {
            return None;
        }
        let (step, total) = (self.at.step, world.statistics().bodies);
        match self.request.detail {
            Detail::Digest => None,
            Detail::Positions => {
                let bodies = world.positions(from);
                let next = bodies.last()?.slot + 1;
                Some((Frame::Positions { step, total, bodies }, next))
            }
            Detail::Full => {
                let bodies = world.bodies(from);
                let next = bodies.last()?.slot + 1;
                Some((Frame::Bodies { at: self.at, total, bodies }, next))
            }
        }
    }

    fn contacts(&self, world: &dyn AnyWorld, from: u16) -> Option<(Frame, u16)> {
        if !self.request.contacts || !every(self.request.every, self.at.step) {
            return None;
        }
        let contacts = world.contacts(from);
        if contacts.is_empty() {
            return None;
        }
        let next = from + contacts.len() as u16;
        Some((Frame::Contacts { at: self.at, total: world.statistics().contacts, contacts }, next))
    }

    fn events(&self, world: &dyn AnyWorld, from: u16) -> Option<(Frame, u16)> {
        if !self.request.events || !self.ends_step {
            return None;
        }
        let events = world.events(from);
        if events.is_empty() {
            return None;
        }
        let next = from + events.len() as u16;
        Some((Frame::Events { step: self.at.step, total: world.event_count(), events }, next))
    }
}

/// Whether something sent every so many steps is due; 0 = never.
fn every(interval: u16, step: u32) -> bool {
    interval != 0 && step.is_multiple_of(u32::from(interval))
}

fn statistics(world: &dyn AnyWorld, record: &Record, dropped: Dropped) -> Statistics {
    let world = world.statistics();
    Statistics {
        step: world.steps,
        contacts: world.contacts,
        contacts_peak: world.contacts_peak,
        contacts_lost: world.contacts_lost,
        bodies: world.bodies,
        escaped: world.escaped,
        saturations: world.saturations,
        backlog_us: record.backlog_us,
        dropped_detail: dropped.detail,
        dropped_steps: dropped.steps,
    }
}
