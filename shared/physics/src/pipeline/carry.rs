//! Contacts between bodies with others in between: what presses on a light body presses on whatever is behind it.
//!
//! Passes over contacts hand a push on from body to body, and through a light body between heavy ones they do so ever so slowly:
//! with masses of 1:100, a hundred passes. But where no two neighbours of a row may overlap, its ends come no nearer than by the
//! gaps between them. This holds at once, and brings in no momentum (after T.-Y. Kim, N. Chentanez and M. Müller, "Long Range
//! Attachments", 2012, who hang up cloth so). It is kept
//!
//! - between a body and the first one that isn't far lighter, along a row of those that are;
//! - between a kinematic body that moves and each of the row that it pushes, unless it presses that on something immovable:
//!   there is no room then, and the row's impulses would add up to what throws it out once it is let go.
//!
//! Rows lie along an axis; along that of gravity there are none, where the pass from the ground up carries everything.

use crate::body::{Body, Marks, Profile};
use crate::contact::{Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::pipeline::integrate;
use crate::pipeline::pairs::NONE;
use crate::pipeline::position::Correction;
use crate::scalar::{Quantity, Scalar};
use crate::variety::Variety;
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Most bodies of a row.
const LONGEST: usize = 64;

/// Stops ends of rows that come together faster than the gaps between them allow.
#[inline]
pub(crate) fn velocities<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let driven = switches.on(Effects::KINEMATIC) && world.called_for.contain(Effects::KINEMATIC);
    let uneven = switches.variety().contain(Variety::MASSES) && world.uneven;
    if driven || uneven {
        let falls = integrate::gravity(world, switches) != Vec2::default();
        carry(world, falls, driven, None);
    }
}

/// Parts ends of rows between which there is too little room. Rows that a kinematic body pushes take care of themselves.
#[inline]
pub(crate) fn positions<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches, correction: Correction<S>) {
    if switches.variety().contain(Variety::MASSES) && world.uneven {
        let falls = integrate::gravity(world, switches) != Vec2::default();
        carry(world, falls, false, Some(correction));
        world.strays = true; // nobody has looked where the rows' ends came to lie
    }
}

/// Whether some rigid body is far lighter than another.
pub(crate) fn is_uneven<S: Scalar>(slots: &[u16], bodies: &[Body<S>], profiles: &[Profile<S>]) -> bool {
    masses(slots, bodies, profiles).is_some_and(|[lightest, heaviest]| is_far_lighter::<S>(lightest, heaviest))
}

/// The masses of the lightest and of the heaviest rigid body.
pub(crate) fn masses<S: Scalar>(slots: &[u16], bodies: &[Body<S>], profiles: &[Profile<S>]) -> Option<[S::Real; 2]> {
    let mut range = None;
    for slot in slots.iter().map(|&slot| usize::from(slot)) {
        if bodies[slot].status.is_rigid() {
            let mass = profiles[slot].mass;
            let [lightest, heaviest] = range.unwrap_or([mass, mass]);
            range = Some([lightest.lesser(mass), heaviest.greater(mass)]);
        }
    }
    range
}

/// Whether a body is so much lighter that a few passes over contacts don't carry a push through it: less than a quarter.
fn is_far_lighter<S: Scalar>(mass: S::Real, than: S::Real) -> bool {
    mass < S::half(S::half(than))
}

#[cold]
#[inline(never)]
fn carry<S: Scalar>(world: &mut World<'_, S>, falls: bool, driven: bool, correction: Option<Correction<S>>) {
    let ground = world.layers.ground();
    for horizontal in [false, true] {
        if falls && horizontal == ground.is_horizontal() {
            continue;
        }
        let World { layers, pool, bodies, profiles, .. } = &mut *world;
        let (order, before, after) = layers.islands();
        for &slot in order {
            (before[usize::from(slot)], after[usize::from(slot)]) = (NONE, NONE);
        }
        let next = [before, after];
        let mut rows = Rows { contacts: pool.all_mut(), bodies, profiles, horizontal, next, correction };
        if rows.link() {
            rows.carry(driven);
        }
    }
}

/// Bodies in rows along an axis.
struct Rows<'r, S: Scalar> {
    contacts: &'r mut [Contact<S>],
    bodies: &'r mut [Body<S>],
    profiles: &'r [Profile<S>],
    horizontal: bool,
    /// By slot, the contact with the next body against the axis, and along it: of several, that with the heaviest.
    next: [&'r mut [u16]; 2],
    /// How positions are corrected; none = velocities are.
    correction: Option<Correction<S>>,
}

impl<S: Scalar> Rows<'_, S> {
    /// Notes who is next to whom; whether anybody is.
    fn link(&mut self) -> bool {
        let mut any = false;
        for place in 0..self.contacts.len() {
            let Some(along) = self.direction(&self.contacts[place]) else { continue };
            let contact = self.contacts[place];
            any = true;
            self.note(contact.a, along, place as u16);
            if !contact.flags.has(Flags::IMMOVABLE) {
                self.note(contact.b, !along, place as u16);
            }
        }
        any
    }

    fn carry(&mut self, driven: bool) {
        for place in 0..self.contacts.len() {
            let Some(along) = self.direction(&self.contacts[place]) else { continue };
            let contact = self.contacts[place];
            if contact.flags.has(Flags::IMMOVABLE) {
                if driven && self.speed(contact.b) != S::Speed::ZERO {
                    if self.is_jammed(&contact, !along) {
                        self.ease(place, !along);
                    } else {
                        self.push(&contact, !along);
                    }
                }
            } else if contact.share < S::unit_ratio(1, 5) {
                self.reach(&contact, contact.a, along);
            } else if contact.share > S::unit_ratio(4, 5) {
                self.reach(&contact, contact.b, !along);
            }
        }
    }

    /// Whether `b` comes after `a` along the axis; none if they don't lie along it, to 30 degrees.
    #[inline]
    fn direction(&self, contact: &Contact<S>) -> Option<bool> {
        let slope = self.component(contact.normal);
        let lies_along = !contact.flags.has(Flags::FAR) && !slope.is_within(S::unit_ratio(7, 8));
        lies_along.then_some(slope > S::Unit::ZERO)
    }

    #[inline(never)]
    fn note(&mut self, slot: u16, along: bool, place: u16) {
        let mass = |place: u16| {
            let contact = &self.contacts[usize::from(place)];
            let other = usize::from(contact.other(slot));
            (contact.flags.has(Flags::IMMOVABLE), self.profiles[other].mass)
        };
        let next = self.next[usize::from(along)][usize::from(slot)];
        if next == NONE || mass(place) > mass(next) {
            self.next[usize::from(along)][usize::from(slot)] = place;
        }
    }

    /// The contact with a body's next one.
    #[inline]
    fn after(&self, slot: u16, along: bool) -> Option<Contact<S>> {
        self.contacts.get(usize::from(self.next[usize::from(along)][usize::from(slot)])).copied()
    }

    /// From a heavy body through the light one that it touches, and all that are as light, to the first that isn't.
    fn reach(&mut self, contact: &Contact<S>, heavy: u16, along: bool) {
        let mass = self.profiles[usize::from(heavy)].mass;
        let (mut gap, mut slot) = (contact.gap, contact.other(heavy));
        for _ in 0..LONGEST {
            let Some(next) = self.after(slot, along) else { return };
            gap = gap.saturating_add(next.gap);
            slot = next.other(slot);
            let other = self.profiles[usize::from(slot)].mass;
            if next.flags.has(Flags::IMMOVABLE) {
                return self.stop(heavy, slot, along, gap, S::UNIT);
            }
            if !is_far_lighter::<S>(other, mass) {
                return self.stop(heavy, slot, along, gap, S::mass_share(mass, other));
            }
        }
    }

    /// Whether a kinematic body presses a row on something immovable.
    fn is_jammed(&self, contact: &Contact<S>, along: bool) -> bool {
        let towards = if along { self.speed(contact.b) } else { -self.speed(contact.b) };
        let (mut gap, mut slot) = (contact.gap, contact.a);
        for _ in 0..LONGEST {
            let Some(next) = self.after(slot, along) else { return false };
            gap = gap.saturating_add(next.gap);
            if next.flags.has(Flags::IMMOVABLE) {
                return towards > S::Speed::ZERO && gap <= S::Speed::ZERO;
            }
            slot = next.other(slot);
        }
        false
    }

    /// Forgets the impulses in a row for which there is no room: no push makes any, and each step would add another.
    fn ease(&mut self, first: usize, along: bool) {
        let contact = &mut self.contacts[first];
        contact.impulse = Vec2::default();
        let mut slot = contact.a;
        for _ in 0..LONGEST {
            let place = self.next[usize::from(along)][usize::from(slot)];
            let Some(contact) = self.contacts.get_mut(usize::from(place)) else { return };
            contact.impulse = Vec2::default();
            if contact.flags.has(Flags::IMMOVABLE) {
                return;
            }
            slot = contact.other(slot);
        }
    }

    /// From a kinematic body to all of the row that it touches. One alone is no row: passes over contacts know what to do.
    fn push(&mut self, contact: &Contact<S>, along: bool) {
        let (mut gap, mut slot) = (contact.gap, contact.a);
        for place in 0..LONGEST {
            let next = self.after(slot, along).filter(|next| !next.flags.has(Flags::IMMOVABLE));
            if place > 0 || next.is_some() {
                self.stop(slot, contact.b, !along, gap, S::UNIT);
            }
            let Some(next) = next else { return };
            gap = gap.saturating_add(next.gap);
            slot = next.other(slot);
        }
    }

    /// Stops two ends, the other of which lies along the axis or against it; `share` of what that takes changes the one.
    #[inline(never)]
    fn stop(&mut self, one: u16, other: u16, along: bool, gap: S::Speed, share: S::Unit) {
        let excess = if let Some(correction) = self.correction {
            correction.of(-gap, -gap)
        } else {
            let closing = self.speed(one).saturating_sub(self.speed(other));
            if along { closing } else { -closing }.saturating_sub(gap.greater(S::Speed::ZERO))
        };
        if excess > S::Speed::ZERO {
            let excess = if along { excess } else { -excess };
            let part = S::speed_times(excess, share);
            self.change(one, -part);
            self.change(other, excess - part);
        }
    }

    #[inline(never)]
    fn change(&mut self, slot: u16, by: S::Speed) {
        let body = &mut self.bodies[usize::from(slot)];
        let zero = S::Speed::ZERO;
        let (by, held) =
            if self.horizontal { (vec2(by, zero), Marks::HELD_X) } else { (vec2(zero, by), Marks::HELD_Y) };
        if self.correction.is_some() {
            body.position = body.position.saturating_add(by.map(S::in_a_step));
            body.marks.set(Marks::MOVED);
        } else {
            body.velocity = body.velocity.saturating_add(by);
            body.marks.set(held);
        }
    }

    fn speed(&self, slot: u16) -> S::Speed {
        self.component(self.bodies[usize::from(slot)].velocity)
    }

    fn component<T: Quantity>(&self, vector: Vec2<T>) -> T {
        if self.horizontal { vector.x } else { vector.y }
    }
}
