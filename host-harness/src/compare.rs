//! Two targets that should hold the same bits: where they part, down to the stage, the body and the field.

use std::fmt;

use flat_physics::Stage;
use flat_wire::message::{BodyState, Command, ContactState, Flip, Frame, Point, ScalarKind, StreamRequest};
use serde::Serialize;

use crate::client::Client;
use crate::collect::Collector;
use crate::drive;
use crate::error::Error;
use crate::job::Job;
use crate::number::{Quantity, decode, hexadecimal};

/// One side of a comparison: who, and the fault that is injected there.
pub struct Side<'a> {
    /// The target.
    pub client: &'a mut Client,
    /// The fault.
    pub flip: Option<Flip>,
}

/// Where two targets part.
#[derive(Clone, Debug, Serialize)]
pub struct Divergence {
    /// First step whose digests differ.
    pub step: u32,
    /// First stage of that step after which the digests differ; none = not when run again.
    pub stage: Option<String>,
    /// What differs there.
    pub difference: Difference,
}

/// What differs between two states whose digests do.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Difference {
    /// A number of a body.
    Body {
        /// Its slot.
        slot: u16,
        /// Which number.
        field: &'static str,
        /// Bits and value on the reference.
        reference: String,
        /// Bits and value on the target.
        target: String,
    },
    /// A number of a contact.
    Contact {
        /// Its place in the solver's order.
        index: usize,
        /// Slots of the two bodies on the reference.
        bodies: [u16; 2],
        /// Which number.
        field: &'static str,
        /// Bits and value on the reference.
        reference: String,
        /// Bits and value on the target.
        target: String,
    },
    /// One side has more bodies or contacts.
    Count {
        /// Of what.
        of: &'static str,
        /// On the reference.
        reference: usize,
        /// On the target.
        target: usize,
    },
    /// Every streamed number is equal: what differs is kept inside.
    Hidden,
    /// A second run of the same scene didn't part at this step.
    NotRepeated,
}

/// Finds out where two targets part, whose digests first differ after `step`; step 0 is the scene as built.
///
/// Runs the scene twice more on both: once for the stage, once for the state after that stage.
///
/// # Errors
/// If a target refuses, falls silent or goes away.
pub fn locate(reference: &mut Side<'_>, target: &mut Side<'_>, job: &Job, step: u32) -> Result<Divergence, Error> {
    // Nothing streams the scene as built, but the first stage moves nothing.
    let looked_at = step.max(1);
    let expected = stage_digests(reference, job, looked_at)?;
    let found = stage_digests(target, job, looked_at)?;
    let Some(stage) = expected.iter().zip(&found).position(|(expected, found)| expected != found) else {
        return Ok(Divergence { step, stage: None, difference: Difference::NotRepeated });
    };
    let at = Point { step: looked_at, stage: stage as u8 };
    let expected = watch(reference, job, at)?;
    let found = watch(target, job, at)?;
    Ok(Divergence {
        step,
        stage: Some(Stage::ALL[stage].to_string()),
        difference: expected.differs(&found, job.request.scalar),
    })
}

/// Digests after each stage of one step.
fn stage_digests(side: &mut Side<'_>, job: &Job, wanted: u32) -> Result<Vec<u64>, Error> {
    drive::load(side.client, &job.request, drive::LOSSLESS, side.flip)?;
    drive::run_silently(side.client, job.inputs.as_ref(), 0, wanted - 1)?;
    side.client.order(&Command::Stream(StreamRequest { stage_digests: true, ..drive::LOSSLESS }))?;
    let mut found = None;
    drive::run(side.client, job.inputs.as_ref(), wanted - 1, wanted, |frame| {
        if let Frame::StageDigests { step, digests } = frame
            && *step == wanted
        {
            found = Some(digests.to_vec());
        }
    })?;
    found.ok_or_else(|| lost(side.client, "stage digests", wanted))
}

/// Everything that can be streamed of one point.
#[derive(Debug, Default)]
struct State {
    bodies: Vec<BodyState>,
    contacts: Vec<ContactState>,
}

/// The state at one point.
fn watch(side: &mut Side<'_>, job: &Job, wanted: Point) -> Result<State, Error> {
    drive::load(side.client, &job.request, drive::LOSSLESS, side.flip)?;
    drive::run_silently(side.client, job.inputs.as_ref(), 0, wanted.step - 1)?;
    side.client.order(&Command::Watch(wanted))?;
    let missing_before = side.client.counters().missing;
    let mut all_bodies = None;
    let mut all_contacts = None;
    let (mut of_bodies, mut of_contacts) = (Collector::new(), Collector::new());
    drive::run(side.client, job.inputs.as_ref(), wanted.step - 1, wanted.step, |frame| match frame {
        Frame::Bodies { at, total, bodies } if *at == wanted => {
            all_bodies = of_bodies.push(*at, *total, bodies).or(all_bodies.take());
        }
        Frame::Contacts { at, total, contacts } if *at == wanted => {
            all_contacts = of_contacts.push(*at, *total, contacts).or(all_contacts.take());
        }
        _ => {}
    })?;
    let bodies = all_bodies.ok_or_else(|| lost(side.client, "bodies", wanted.step))?;
    // No contacts, no frame: then nothing may have got lost on the way.
    let complete = side.client.counters().missing == missing_before;
    let contacts = all_contacts.or_else(|| complete.then(Vec::new));
    Ok(State { bodies, contacts: contacts.ok_or_else(|| lost(side.client, "contacts", wanted.step))? })
}

fn lost(client: &Client, what: &str, step: u32) -> Error {
    Error::target(format!("{}: the {what} of step {step} got lost on the link", client.name()), "run it again")
}

impl State {
    fn differs(&self, other: &Self, scalar: ScalarKind) -> Difference {
        // Bodies first: a contact that differs is usually the consequence.
        for (a, b) in self.bodies.iter().zip(&other.bodies) {
            if let Some((field, reference, target)) = first_difference(&of_body(a), &of_body(b), scalar) {
                return Difference::Body { slot: a.slot, field, reference, target };
            }
        }
        if self.bodies.len() != other.bodies.len() {
            return Difference::Count { of: "bodies", reference: self.bodies.len(), target: other.bodies.len() };
        }
        for (index, (a, b)) in self.contacts.iter().zip(&other.contacts).enumerate() {
            if let Some((field, reference, target)) = first_difference(&of_contact(a), &of_contact(b), scalar) {
                return Difference::Contact { index, bodies: a.bodies, field, reference, target };
            }
        }
        if self.contacts.len() != other.contacts.len() {
            return Difference::Count { of: "contacts", reference: self.contacts.len(), target: other.contacts.len() };
        }
        Difference::Hidden
    }
}

/// A number with its name and unit; without a unit it is a plain count.
type Named = (&'static str, Option<Quantity>, i64);

fn of_body(body: &BodyState) -> [Named; 7] {
    [
        ("slot", None, i64::from(body.slot)),
        ("position.x", Some(Quantity::Length), body.position[0]),
        ("position.y", Some(Quantity::Length), body.position[1]),
        ("velocity.x", Some(Quantity::Speed), body.velocity[0]),
        ("velocity.y", Some(Quantity::Speed), body.velocity[1]),
        ("remainder.x", None, body.remainder[0].into()),
        ("remainder.y", None, body.remainder[1].into()),
    ]
}

fn of_contact(contact: &ContactState) -> [Named; 7] {
    [
        ("first body", None, i64::from(contact.bodies[0])),
        ("second body", None, i64::from(contact.bodies[1])),
        ("normal.x", Some(Quantity::Direction), contact.normal[0]),
        ("normal.y", Some(Quantity::Direction), contact.normal[1]),
        ("penetration", Some(Quantity::Length), contact.penetration),
        ("normal impulse", Some(Quantity::Speed), contact.impulse[0]),
        ("tangent impulse", Some(Quantity::Speed), contact.impulse[1]),
    ]
}

/// Name, reference's and target's value of the first number that differs.
fn first_difference(a: &[Named], b: &[Named], scalar: ScalarKind) -> Option<(&'static str, String, String)> {
    let ((field, quantity, a), (_, _, b)) = a.iter().zip(b).find(|(a, b)| a.2 != b.2)?;
    let shown = |bits| match quantity {
        None => format!("{bits}"),
        Some(quantity) => {
            let unit = match quantity {
                Quantity::Length => " px",
                Quantity::Speed => " px per step",
                Quantity::Direction => "",
            };
            format!("{} = {:?}{unit}", hexadecimal(scalar, bits), decode(scalar, *quantity, bits))
        }
    };
    Some((field, shown(*a), shown(*b)))
}

impl Divergence {
    /// Where in the run.
    pub fn place(&self) -> String {
        match (self.step, &self.stage) {
            (0, _) => "the scene as built".into(),
            (step, None) => format!("step {step}"),
            (step, Some(stage)) => format!("step {step}, after stage {stage}"),
        }
    }

    /// The two values, the reference's first, where the difference is one of values.
    pub fn values(&self) -> Option<(String, String)> {
        match &self.difference {
            Difference::Body { reference, target, .. } | Difference::Contact { reference, target, .. } => {
                Some((reference.clone(), target.clone()))
            }
            Difference::Count { reference, target, .. } => Some((reference.to_string(), target.to_string())),
            Difference::Hidden | Difference::NotRepeated => None,
        }
    }
}

/// What it is that differs, without the values.
impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Body { slot, field, .. } => write!(f, "{field} of body {slot}"),
            Self::Contact { index, bodies: [a, b], field, .. } => {
                write!(f, "{field} of contact {index}, between bodies {a} and {b}")
            }
            Self::Count { of, .. } => write!(f, "number of {of}"),
            Self::Hidden => f.write_str("state that isn't streamed; all bodies and contacts are equal"),
            Self::NotRepeated => f.write_str("nothing, when run again: the target doesn't repeat itself"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state() -> State {
        let body = |slot| BodyState { slot, position: [1, 2], velocity: [3, 4], remainder: [5, 6] };
        let contact = ContactState { bodies: [0, 1], normal: [0, 1 << 30], penetration: 5, impulse: [6, 7] };
        State { bodies: vec![body(0), body(1)], contacts: vec![contact] }
    }

    fn difference(change: impl FnOnce(&mut State)) -> String {
        let mut changed = state();
        change(&mut changed);
        state().differs(&changed, ScalarKind::Fixed).to_string()
    }

    #[test]
    fn the_first_difference_is_named() {
        assert_eq!(difference(|other| other.bodies[1].position[1] += 1), "position.y of body 1");
        assert_eq!(
            difference(|other| other.contacts[0].impulse[0] += 1),
            "normal impulse of contact 0, between bodies 0 and 1"
        );
        assert_eq!(difference(|other| other.bodies.truncate(1)), "number of bodies");
        assert_eq!(difference(|other| other.contacts.clear()), "number of contacts");
        assert!(difference(|_| {}).starts_with("state that isn't streamed"));
    }
}
