//! Contacts whose bodies have parted, kept until their end has been told.
//!
//! A body is removed, or a pair no longer meets: the contact is struck where it lies, so that whoever walks through the pool
//! isn't disturbed. When pairs are next looked for, struck contacts leave; those that somebody was told of move to the far end of
//! the pool, out of the solver's sight. There they stay for one step, which tells their end. Their bodies' slots may have been
//! filled anew by then: what names the old ones is kept in the contact.

use super::{Contact, Flags, Pool, exchange};
use crate::body::Profile;
use crate::scalar::{Quantity, Scalar};

impl<S: Scalar> Contact<S> {
    /// Whether the bodies have parted. Outside of the search for pairs, all others are marked as found.
    #[inline]
    pub(crate) fn has_parted(&self) -> bool {
        !self.flags.has(Flags::KEPT)
    }

    /// Whether it is a body's, and lasts.
    pub(crate) fn is_of(&self, slot: u16) -> bool {
        (self.a == slot || self.b == slot) && !self.has_parted()
    }

    /// Strikes the contact. It is never solved again.
    pub(crate) fn part(&mut self, profiles: &[Profile<S>]) {
        self.flags.clear(Flags::KEPT);
        self.flags.set(Flags::FAR);
        // Nobody asks for the gap and the friction of what has parted: there is room for the generations.
        self.gap = S::speed_from_bits(i64::from(profiles[usize::from(self.a)].generation));
        self.friction = profiles[usize::from(self.b)].generation;
    }

    /// Generations of the bodies that have parted.
    pub(crate) fn generations(&self) -> [u16; 2] {
        [self.gap.bits() as u16, self.friction]
    }
}

impl<S: Scalar> Pool<'_, S> {
    /// Takes parted contacts out, if `tell` says so to where their end can be told.
    pub(crate) fn set_aside(&mut self, tell: bool) {
        let mut kept = 0;
        for place in 0..self.len {
            if !self.slots[place].has_parted() {
                if kept < place && tell {
                    exchange(self.slots, kept, place);
                } else if kept < place {
                    self.slots[kept] = self.slots[place];
                }
                kept += 1;
            }
        }
        self.set_aside_from(kept, tell);
    }

    /// The same, where all that have parted lie from a place on.
    pub(crate) fn set_aside_from(&mut self, kept: usize, tell: bool) {
        let parted = core::mem::replace(&mut self.len, kept);
        if tell {
            self.set_aside_between(kept, parted);
        }
    }

    #[inline(never)]
    fn set_aside_between(&mut self, kept: usize, parted: usize) {
        for place in (kept..parted).rev() {
            let contact = self.slots[place];
            if contact.flags.has(Flags::TOUCHING) {
                // Places above this one have been dealt with, and so many of them were free.
                self.aside += 1;
                let free = self.slots.len() - self.asleep - self.aside;
                self.slots[free] = contact;
            }
        }
    }

    /// Forgets what was set aside.
    pub(crate) fn forget_aside(&mut self) {
        self.aside = 0;
    }

    /// Notes the end of what was set aside, and forgets those whose end was noted before.
    pub(crate) fn end_aside(&mut self) {
        let mut kept = 0;
        let far = self.slots.len() - self.asleep;
        for place in (far - self.aside..far).rev() {
            let mut contact = self.slots[place];
            if contact.flags.has(Flags::TOUCHING) {
                contact.flags.clear(Flags::TOUCHING);
                contact.flags.set(Flags::TOUCHED);
                kept += 1;
                self.slots[far - kept] = contact;
            }
        }
        self.aside = kept;
    }

    /// Of all contacts, those set aside first and sleeping ones last, the one at a place.
    pub(crate) fn at(&self, place: usize) -> Option<&Contact<S>> {
        let far = self.slots.len() - self.asleep;
        let Some(place) = place.checked_sub(self.aside) else {
            return self.slots.get(far - self.aside + place);
        };
        match place.checked_sub(self.len) {
            None => self.slots.get(place),
            Some(place) => self.asleep().get(place),
        }
    }
}
