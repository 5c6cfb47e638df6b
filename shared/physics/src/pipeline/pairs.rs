//! The pool of contacts, kept from step to step: pairs that come near are added, pairs that part are dropped, and all lie in
//! groups, one an upper body, in the order of the bodies.

use super::order::{self, Ground};
use super::terrain;
use crate::body::{Body, Profile};
use crate::contact::{Contact, Flags, Pool};
use crate::effects::Switches;
use crate::scalar::{Quantity, Scalar};
use crate::variety::Variety;

/// Marks a body without a group, and the end of a list.
pub(crate) const NONE: u16 = u16::MAX;

/// An update of the pool: pairs that nobody notes are dropped at its end.
pub(crate) struct Update<'p, 'a, S: Scalar> {
    pool: &'p mut Pool<'a, S>,
    /// First contact of each body's group, by slot; anything for bodies without one.
    groups: &'p mut [u16],
    /// Contacts that were there before.
    old: usize,
    kept: usize,
    /// Whether a pair is new or has turned around: else the groups may stay as they lie.
    regroup: bool,
}

impl<'p, 'a, S: Scalar> Update<'p, 'a, S> {
    /// `scattered`: groups lie in another order than the bodies.
    pub(crate) fn new(pool: &'p mut Pool<'a, S>, groups: &'p mut [u16], scattered: bool) -> Self {
        let mut previous = NONE;
        for (place, contact) in pool.all_mut().iter_mut().enumerate() {
            contact.flags.clear(Flags::KEPT);
            if contact.a != previous {
                previous = contact.a;
                groups[usize::from(previous)] = place as u16;
            }
        }
        let old = pool.all().len();
        pool.missing = 0;
        Self { pool, groups, old, kept: 0, regroup: scattered }
    }

    /// Keeps the contact between two bodies, if there was one.
    #[inline]
    pub(crate) fn keep_pair(&mut self, a: u16, b: u16) -> bool {
        let Some(contact) = self.find(a, b) else {
            return false;
        };
        contact.flags.set(Flags::KEPT);
        self.kept += 1;
        true
    }

    /// Adds a contact between two bodies that there was none between in this order.
    #[cold]
    pub(crate) fn add_pair(
        &mut self,
        a: u16,
        b: u16,
        bodies: &[Body<S>],
        profiles: &[Profile<S>],
        switches: impl Switches,
    ) {
        self.regroup = true;
        if !bodies[usize::from(b)].status.is_static()
            && let Some(contact) = self.find(b, a)
        {
            // They have changed places in the order. Turned around, the same impulses push the same bodies.
            (contact.a, contact.b) = (a, b);
            contact.share = S::UNIT - contact.share;
            contact.flags.set(Flags::KEPT.or(Flags::NEW));
            self.kept += 1;
        } else {
            let mut contact = Contact { a, b, flags: Flags::KEPT, ..Contact::EMPTY };
            define(&mut contact, bodies, profiles, switches);
            self.pool.push(contact);
        }
    }

    /// Makes room for so many contacts of a body with the tile map.
    pub(crate) fn note_terrain(&mut self, a: u16, terrain: u16, count: usize, profiles: &[Profile<S>]) {
        let mut kept = 0;
        for contact in self.group(a).filter(|contact| is_blocking(contact, terrain)) {
            contact.flags.set(Flags::KEPT);
            kept += 1;
        }
        if kept > count {
            return self.keep_most_used(a, terrain, count);
        }
        self.kept += kept;
        for _ in kept..count {
            self.pool.push(terrain::found(a, terrain, None, profiles));
            self.regroup = true;
        }
    }

    /// Of a body's blocking contacts with the tile map, which are more, keeps so many: first those that bear or stop the body.
    #[cold]
    fn keep_most_used(&mut self, a: u16, terrain: u16, count: usize) {
        for contact in self.group(a).filter(|contact| is_blocking(contact, terrain)) {
            contact.flags.clear(Flags::KEPT);
        }
        let used = |contact: &Contact<S>| is_blocking(contact, terrain) && terrain::is_in_use(contact);
        let kept = self.keep(a, used, count);
        self.keep(a, |contact| is_blocking(contact, terrain), count - kept);
    }

    /// Notes that a body may overlap a sensor tile.
    pub(crate) fn note_sensor_tile(&mut self, a: u16, terrain: u16, number: u32, profiles: &[Profile<S>]) {
        let same = |contact: &Contact<S>| {
            contact.b == terrain && contact.flags.has(Flags::SENSOR) && S::number_of(contact.share) == number
        };
        if self.keep(a, same, 1) == 0 {
            self.pool.push(terrain::found(a, terrain, Some(number), profiles));
            self.regroup = true;
        }
    }

    /// Keeps up to `most` more of a body's contacts for which a condition holds; how many there were.
    fn keep(&mut self, a: u16, condition: impl Fn(&Contact<S>) -> bool, most: usize) -> usize {
        let mut kept = 0;
        for contact in self.group(a) {
            if kept < most && contact.has_parted() && condition(contact) {
                contact.flags.set(Flags::KEPT);
                kept += 1;
            }
        }
        self.kept += kept;
        kept
    }

    /// The contact between two bodies, if there was one.
    #[inline]
    fn find(&mut self, a: u16, b: u16) -> Option<&mut Contact<S>> {
        self.group(a).find(|contact| contact.b == b)
    }

    /// The contacts that a body had.
    #[inline]
    fn group(&mut self, a: u16) -> impl Iterator<Item = &mut Contact<S>> {
        let first = usize::from(self.groups[usize::from(a)]);
        let group = self.pool.all_mut().get_mut(first..self.old).unwrap_or_default();
        group.iter_mut().take_while(move |contact| contact.a == a)
    }

    /// Drops what nobody noted, and brings the rest into groups. `places` is scratch space, one a body.
    pub(crate) fn finish(
        self,
        order: &[u16],
        places: &mut [u16],
        bodies: &[Body<S>],
        profiles: &[Profile<S>],
        ground: Ground,
        tell_ends: bool,
    ) {
        let have_parted = self.kept < self.old;
        if have_parted && tell_ends {
            for contact in self.pool.all_mut().iter_mut().filter(|contact| contact.has_parted()) {
                contact.part(profiles);
            }
        }
        if self.regroup {
            let contacts = self.pool.all_mut();
            let kept = regroup(contacts, order, self.groups, places);
            sort_groups(&mut contacts[..kept], bodies, ground);
            self.pool.set_aside_from(kept, tell_ends);
        } else if have_parted {
            self.pool.set_aside(tell_ends);
        }
    }
}

/// Whether a contact is with what blocks in the tile map.
fn is_blocking<S: Scalar>(contact: &Contact<S>, terrain: u16) -> bool {
    contact.b == terrain && !contact.flags.has(Flags::SENSOR)
}

/// Takes over into a contact what its bodies' definitions say.
pub(crate) fn define<S: Scalar>(
    contact: &mut Contact<S>,
    bodies: &[Body<S>],
    profiles: &[Profile<S>],
    switches: impl Switches,
) {
    let (a, b) = (usize::from(contact.a), usize::from(contact.b));
    let (own, other) = (&profiles[a], &profiles[b]);
    let flags = &mut contact.flags;
    // The slot of the tile map is the only disabled one in a contact; its sensors are tiles.
    let tile_sensor = flags.has(Flags::SENSOR) && !bodies[b].status.is_enabled();
    flags.clear(Flags::IMMOVABLE.or(Flags::EVEN).or(Flags::BOUNCY).or(Flags::SENSOR));
    flags.set(Flags::NEW);
    if bodies[b].status.is_rigid() {
        if !switches.variety().contain(Variety::MASSES) || own.mass == other.mass {
            flags.set(Flags::EVEN);
            contact.share = S::unit_ratio(1, 2);
        } else {
            contact.share = S::mass_share(own.mass, other.mass);
        }
    } else {
        flags.set(Flags::IMMOVABLE);
    }
    if own.returns().lesser(other.returns()) > S::Real::ZERO {
        flags.set(Flags::BOUNCY);
    }
    if bodies[a].status.is_sensor() || bodies[b].status.is_sensor() || tile_sensor {
        flags.set(Flags::SENSOR);
    }
    contact.friction = own.friction.min(other.friction);
}

/// Moves every contact into the group of its upper body, in place, and those that have parted behind them all; how many last (P.
/// `McIlroy`, K. Bostic and M. `McIlroy`, "Engineering Radix Sort", 1993: each swap brings at least one to its group).
fn regroup<S: Scalar>(contacts: &mut [Contact<S>], order: &[u16], groups: &mut [u16], next: &mut [u16]) -> usize {
    let groups = &mut groups[..next.len()]; // both have an entry a body: one check of a slot is enough
    for &slot in order {
        next[usize::from(slot)] = 0;
    }
    for contact in contacts.iter().filter(|contact| !contact.has_parted()) {
        next[usize::from(contact.a)] += 1;
    }
    let mut total = 0;
    for &slot in order {
        let (group, next) = (&mut groups[usize::from(slot)], &mut next[usize::from(slot)]);
        let count = *next;
        (*group, *next) = (total, total);
        total += count;
    }
    let mut parted = total;
    for place in 0..total {
        let contact = &contacts[usize::from(place)];
        if !contact.has_parted() {
            let (start, next) = (groups[usize::from(contact.a)], &mut next[usize::from(contact.a)]);
            if (start..=*next).contains(&place) {
                // It belongs here, and may be the first to have been looked at.
                *next += u16::from(place == *next);
                continue;
            }
        }
        // Lifted out, a contact takes the place of another until one comes that belongs here.
        let mut held = *contact;
        loop {
            let goal = if held.has_parted() { &mut parted } else { &mut next[usize::from(held.a)] };
            let free = *goal;
            *goal += 1;
            if free == place {
                break;
            }
            core::mem::swap(&mut held, &mut contacts[usize::from(free)]);
        }
        contacts[usize::from(place)] = held;
    }
    usize::from(total)
}

/// Sorts each body's contacts by the other body, in the order of bodies.
fn sort_groups<S: Scalar>(contacts: &mut [Contact<S>], bodies: &[Body<S>], ground: Ground) {
    for start in 1..contacts.len() {
        // All that a body has with the tile map are with one slot.
        let follows = |pair: &[Contact<S>]| {
            pair[0].a == pair[1].a && pair[0].b != pair[1].b && order::precedes(pair[1].b, pair[0].b, bodies, ground)
        };
        let mut place = start;
        while place > 0 && follows(&contacts[place - 1..=place]) {
            contacts.swap(place, place - 1);
            place -= 1;
        }
    }
}
