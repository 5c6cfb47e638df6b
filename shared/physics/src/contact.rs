//! Contacts between two bodies, and the fixed pool that holds a step's.

use crate::scalar::{Quantity, Scalar};
use crate::vec2::{Vec2, vec2};

/// Two bodies that touch or overlap. The first is rigid; the second is below it or static.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact<S: Scalar> {
    pub(crate) a: u16,
    pub(crate) b: u16,
    /// From `a` to `b`.
    pub(crate) normal: Vec2<S::Unit>,
    /// Overlap along the normal, px; 0 = touching.
    pub(crate) penetration: S::Real,
    /// Speed at which the bodies approached each other when they were found in contact, before this step's gravity.
    pub(crate) approach: S::Speed,
    /// Part of an impulse that moves `a`; the rest moves `b`.
    pub(crate) share: S::Unit,
    pub(crate) restitution: S::Real,
    pub(crate) friction: S::Real,
    /// Change of relative velocity that the solver applied along the normal (x) and the tangent (y).
    pub(crate) impulse: Vec2<S::Speed>,
}

impl<S: Scalar> Contact<S> {
    pub(crate) const EMPTY: Self = Self {
        a: 0,
        b: 0,
        normal: vec2(S::Unit::ZERO, S::Unit::ZERO),
        penetration: S::Real::ZERO,
        approach: S::Speed::ZERO,
        share: S::Unit::ZERO,
        restitution: S::Real::ZERO,
        friction: S::Real::ZERO,
        impulse: vec2(S::Speed::ZERO, S::Speed::ZERO),
    };

    /// Part of an impulse that moves `b`: nothing moves a static body.
    #[inline]
    pub(crate) fn other_share(&self) -> S::Unit {
        S::UNIT - self.share
    }
}

/// Fixed room for contacts. What doesn't fit is counted, never silently gone.
#[derive(Debug)]
pub(crate) struct Pool<'a, S: Scalar> {
    slots: &'a mut [Contact<S>],
    len: usize,
    /// Most contacts of any step.
    pub(crate) peak: u16,
    /// Contacts that found no room, over all steps.
    pub(crate) lost: u32,
}

impl<'a, S: Scalar> Pool<'a, S> {
    pub(crate) fn new(slots: &'a mut [Contact<S>]) -> Self {
        Self { slots, len: 0, peak: 0, lost: 0 }
    }

    pub(crate) fn clear(&mut self) {
        self.len = 0;
    }

    /// Forgets the contacts and the counts.
    pub(crate) fn reset(&mut self) {
        self.clear();
        self.peak = 0;
        self.lost = 0;
    }

    #[inline]
    pub(crate) fn push(&mut self, contact: Contact<S>) {
        if let Some(slot) = self.slots.get_mut(self.len) {
            *slot = contact;
            self.len += 1;
        } else {
            self.lost = self.lost.saturating_add(1);
        }
    }

    /// Forgets the contacts of a body, and keeps the others in their order.
    pub(crate) fn forget(&mut self, body: u16) {
        let mut kept = 0;
        for place in 0..self.len {
            let contact = self.slots[place];
            if contact.a != body && contact.b != body {
                self.slots[kept] = contact;
                kept += 1;
            }
        }
        self.len = kept;
    }

    pub(crate) fn note_peak(&mut self) {
        self.peak = self.peak.max(self.len as u16);
    }

    #[inline]
    pub(crate) fn all(&self) -> &[Contact<S>] {
        &self.slots[..self.len]
    }

    #[inline]
    pub(crate) fn all_mut(&mut self) -> &mut [Contact<S>] {
        &mut self.slots[..self.len]
    }

    pub(crate) fn capacity(&self) -> u16 {
        self.slots.len() as u16
    }
}
