//! Contacts of bodies that sleep: they lie at the very end of the pool, out of every stage's sight, until their bodies wake.

use super::{Contact, Flags, Pool, exchange};
use crate::scalar::Scalar;

impl<S: Scalar> Pool<'_, S> {
    /// Contacts of sleeping bodies.
    pub(crate) fn asleep(&self) -> &[Contact<S>] {
        &self.slots[self.slots.len() - self.asleep..]
    }

    /// All contacts that last, sleeping ones last.
    pub(crate) fn waking_and_asleep(&self) -> impl Iterator<Item = &Contact<S>> {
        self.all().iter().chain(self.asleep())
    }

    /// The same, to change them.
    pub(crate) fn waking_and_asleep_mut(&mut self) -> impl Iterator<Item = &mut Contact<S>> {
        let (rest, asleep) = self.slots.split_at_mut(self.slots.len() - self.asleep);
        rest[..self.len].iter_mut().chain(asleep)
    }

    /// Puts contacts to sleep; events of their bodies go on saying that they touch.
    pub(crate) fn put_to_sleep(&mut self, sleeps: impl Fn(&Contact<S>) -> bool) {
        let awake = part(&mut self.slots[..self.len], &|contact| !sleeps(contact));
        let count = self.len - awake;
        for contact in &mut self.slots[awake..self.len] {
            contact.flags.clear(Flags::TOUCHED);
            if contact.flags.has(Flags::TOUCHING) {
                contact.flags.set(Flags::TOUCHED);
            }
        }
        let far = self.slots.len() - self.asleep;
        let start = far - self.aside - count;
        for place in (0..count).rev() {
            exchange(self.slots, awake + place, start + place);
        }
        rotate(&mut self.slots[start..far], count); // what is set aside lies before them
        self.asleep += count;
        self.len = awake;
    }

    /// Wakes contacts.
    pub(crate) fn wake(&mut self, wakes: impl Fn(&Contact<S>) -> bool) {
        let far = self.slots.len() - self.asleep;
        let count = part(&mut self.slots[far..], &wakes);
        let start = far - self.aside;
        rotate(&mut self.slots[start..far + count], self.aside);
        for place in 0..count {
            exchange(self.slots, start + place, self.len + place);
        }
        self.asleep -= count;
        self.len += count;
    }
}

/// Moves the contacts for which a condition holds to the front, all in the order in which they were; how many there are.
fn part<S: Scalar>(contacts: &mut [Contact<S>], condition: &impl Fn(&Contact<S>) -> bool) -> usize {
    match contacts {
        [] => 0,
        [contact] => usize::from(condition(contact)),
        _ => {
            let middle = contacts.len() / 2;
            let (left, right) = contacts.split_at_mut(middle);
            let (first, second) = (part(left, condition), part(right, condition));
            rotate(&mut contacts[first..middle + second], middle - first);
            first + second
        }
    }
}

/// Moves the first so many contacts behind the others: as [`slice::rotate_left`] does, in a quarter of its code.
fn rotate<S: Scalar>(contacts: &mut [Contact<S>], first: usize) {
    let (ahead, behind) = contacts.split_at_mut(first);
    reverse(ahead);
    reverse(behind);
    reverse(contacts);
}

#[inline(never)]
fn reverse<S: Scalar>(contacts: &mut [Contact<S>]) {
    for place in 0..contacts.len() / 2 {
        exchange(contacts, place, contacts.len() - 1 - place);
    }
}
