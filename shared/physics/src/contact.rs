//! Contacts between two bodies, and the fixed pool that holds them.

mod asleep;
mod parted;

use crate::effects::Switches;
use crate::scalar::{Quantity, Scalar};
use crate::variety::Variety;
use crate::vec2::{Vec2, vec2};

/// Two bodies that touch, overlap, or may do so within the next steps. The first is rigid; the second is below it or immovable.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact<S: Scalar> {
    pub(crate) a: u16,
    pub(crate) b: u16,
    /// From `a` to `b`.
    pub(crate) normal: Vec2<S::Unit>,
    /// Distance along the normal, px, as the speed that closes it in a step; negative = overlap.
    pub(crate) gap: S::Speed,
    /// Change of relative velocity that the solver applies along the normal (x) and along the normal turned by a quarter (y).
    pub(crate) impulse: Vec2<S::Speed>,
    /// Part of an impulse that moves `a`, where something moves `b` as well: see [`own_share`](Self::own_share). The number of the
    /// tile, where `b` is the tile map.
    pub(crate) share: S::Unit,
    /// In 1/32768.
    pub(crate) friction: u16,
    pub(crate) flags: Flags,
}

/// What kind of contact it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Flags(u16);

impl Flags {
    /// The normal is an axis: the two lowest bits say which.
    pub(crate) const AXIS: Self = Self(1 << 2);
    /// Nothing moves `b`.
    pub(crate) const IMMOVABLE: Self = Self(1 << 3);
    /// The masses are equal.
    pub(crate) const EVEN: Self = Self(1 << 4);
    /// Too far apart to touch in this step.
    pub(crate) const FAR: Self = Self(1 << 5);
    /// Restitution is above 0.
    pub(crate) const BOUNCY: Self = Self(1 << 6);
    /// Not looked at since it was found.
    pub(crate) const NEW: Self = Self(1 << 7);
    /// Found again by the broadphase.
    pub(crate) const KEPT: Self = Self(1 << 8);
    /// `b` bears `a`: it lies towards the ground, within 60 degrees.
    pub(crate) const BEARS: Self = Self(1 << 9);
    /// `b` connects `a` to the ground: it lies below, within 78 degrees.
    pub(crate) const CONNECTS: Self = Self(1 << 10);
    /// One of the bodies is a sensor: it is never solved, which [`FAR`](Self::FAR) sees to.
    pub(crate) const SENSOR: Self = Self(1 << 11);
    /// Touched when events were last noted.
    pub(crate) const TOUCHING: Self = Self(1 << 12);
    /// Touched the time before that.
    pub(crate) const TOUCHED: Self = Self(1 << 13);
    /// Has bounced in this step, or in the last one if it wasn't looked at since. Of a sensor: was passed within the step.
    pub(crate) const BOUNCED: Self = Self(1 << 14);
    /// `a` stands on the one-way platform `b`.
    pub(crate) const LANDED: Self = Self(1 << 15);
    /// `a` was let through the one-way platform `b`. Platforms are immovable, so masses that are equal say nothing there.
    pub(crate) const DROPPED: Self = Self::EVEN;

    #[inline]
    pub(crate) const fn or(self, flags: Self) -> Self {
        Self(self.0 | flags.0)
    }
    #[inline]
    pub(crate) const fn has(self, flags: Self) -> bool {
        self.0 & flags.0 != 0
    }
    #[inline]
    pub(crate) fn set(&mut self, flags: Self) {
        self.0 |= flags.0;
    }
    #[inline]
    pub(crate) fn clear(&mut self, flags: Self) {
        self.0 &= !flags.0;
    }
    /// An axis as a normal.
    #[inline]
    pub(crate) fn axis(self) -> Axis {
        match self.0 & 3 {
            0 => Axis::Down,
            1 => Axis::Up,
            2 => Axis::Right,
            _ => Axis::Left,
        }
    }
    /// Flags of a normal along an axis.
    pub(crate) const fn along(axis: Axis) -> Self {
        Self(Self::AXIS.0 | axis as u16)
    }
    /// Whether the normal slopes and an impulse moves both bodies alike: most contacts between balls, known in one test.
    #[inline]
    pub(crate) fn is_plain(self, switches: impl Switches) -> bool {
        let kind = Self::AXIS.or(Self::IMMOVABLE).or(Self::EVEN);
        switches.variety().contain(Variety::CIRCLES) && self.0 & kind.0 == Self::EVEN.0
    }
    /// Forgets what the geometry had said.
    pub(crate) fn forget_geometry(&mut self) {
        let geometry = Self::AXIS.or(Self::FAR).or(Self::NEW).or(Self::BEARS).or(Self::CONNECTS).or(Self::BOUNCED);
        self.0 &= !(3 | geometry.0);
    }
}

/// A normal without a slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axis {
    Down,
    Up,
    Right,
    Left,
}

impl Axis {
    pub(crate) fn normal<S: Scalar>(self) -> Vec2<S::Unit> {
        let zero = S::Unit::ZERO;
        match self {
            Self::Down => vec2(zero, S::UNIT),
            Self::Up => vec2(zero, -S::UNIT),
            Self::Right => vec2(S::UNIT, zero),
            Self::Left => vec2(-S::UNIT, zero),
        }
    }
}

impl<S: Scalar> Contact<S> {
    pub(crate) const EMPTY: Self = Self {
        a: 0,
        b: 0,
        normal: vec2(S::Unit::ZERO, S::Unit::ZERO),
        gap: S::Speed::ZERO,
        impulse: vec2(S::Speed::ZERO, S::Speed::ZERO),
        share: S::Unit::ZERO,
        friction: 0,
        flags: Flags(0),
    };

    /// Part of an impulse that moves `a`; the rest moves `b`.
    #[inline]
    pub(crate) fn own_share(&self) -> S::Unit {
        if self.flags.has(Flags::IMMOVABLE) { S::UNIT } else { self.share }
    }

    /// What a change of relative velocity, or of a distance, does to `a` and to `b`: their shares, to nearest. Of equal masses equal
    /// ones: nothing is lost to rounding.
    #[inline(never)]
    pub(crate) fn parts(&self, change: Vec2<S::Speed>, switches: impl Switches) -> [Vec2<S::Speed>; 2] {
        if self.flags.has(Flags::IMMOVABLE) {
            [change, Vec2::default()]
        } else if self.is_even(switches) {
            [change.map(S::even_part); 2]
        } else {
            [self.share, S::UNIT - self.share].map(|share| change.map(|speed| S::speed_times(speed, share)))
        }
    }

    /// The one of its bodies that isn't `slot`.
    #[inline]
    pub(crate) fn other(&self, slot: u16) -> u16 {
        if self.a == slot { self.b } else { self.a }
    }

    /// Whether the bodies exactly touch, overlap, or press on each other.
    #[inline]
    pub(crate) fn touches(&self) -> bool {
        !self.flags.has(Flags::FAR) && (self.gap <= S::Speed::ZERO || self.impulse.x > S::Speed::ZERO)
    }

    /// Whether the normal has a slope.
    #[inline]
    pub(crate) fn slopes(&self, switches: impl Switches) -> bool {
        switches.variety().contain(Variety::CIRCLES) && !self.flags.has(Flags::AXIS)
    }

    /// Whether an impulse moves both bodies alike, if it moves both.
    #[inline]
    pub(crate) fn is_even(&self, switches: impl Switches) -> bool {
        !switches.variety().contain(Variety::MASSES) || self.flags.has(Flags::EVEN)
    }

    /// Components of a vector along the normal (x) and the normal turned by a quarter (y).
    #[inline]
    pub(crate) fn in_frame(&self, v: Vec2<S::Speed>, switches: impl Switches) -> Vec2<S::Speed> {
        if self.slopes(switches) {
            return S::into_frame(v, self.normal);
        }
        match self.flags.axis() {
            Axis::Down => vec2(v.y, -v.x),
            Axis::Up => vec2(-v.y, v.x),
            Axis::Right => v,
            Axis::Left => -v,
        }
    }

    /// The inverse of [`in_frame`](Self::in_frame).
    #[inline]
    pub(crate) fn out_of_frame(&self, v: Vec2<S::Speed>, switches: impl Switches) -> Vec2<S::Speed> {
        if self.slopes(switches) {
            return S::out_of_frame(v, self.normal);
        }
        match self.flags.axis() {
            Axis::Down => vec2(-v.y, v.x),
            Axis::Up => vec2(v.y, -v.x),
            Axis::Right => v,
            Axis::Left => -v,
        }
    }
}

/// Fixed room for contacts. What doesn't fit is counted, never silently gone.
#[derive(Debug)]
pub(crate) struct Pool<'a, S: Scalar> {
    slots: &'a mut [Contact<S>],
    len: usize,
    /// Contacts near the far end that are over, and whose end is being told.
    aside: usize,
    /// Contacts at the very end, of bodies that sleep.
    asleep: usize,
    /// Most contacts of any step.
    pub(crate) peak: u16,
    /// Contacts that found no room, over all steps.
    pub(crate) lost: u32,
    /// Contacts that found no room when pairs were last looked for.
    pub(crate) missing: u32,
}

impl<'a, S: Scalar> Pool<'a, S> {
    pub(crate) fn new(slots: &'a mut [Contact<S>]) -> Self {
        Self { slots, len: 0, aside: 0, asleep: 0, peak: 0, lost: 0, missing: 0 }
    }

    /// Becomes as another one of the same size is.
    pub(crate) fn copy_from(&mut self, other: &Pool<'_, S>) {
        let Pool { slots, len, aside, asleep, peak, lost, missing } = other;
        self.slots.copy_from_slice(slots);
        (self.len, self.aside, self.asleep) = (*len, *aside, *asleep);
        (self.peak, self.lost, self.missing) = (*peak, *lost, *missing);
    }

    /// Forgets the contacts and the counts.
    pub(crate) fn reset(&mut self) {
        (self.len, self.aside, self.asleep) = (0, 0, 0);
        (self.peak, self.lost, self.missing) = (0, 0, 0);
    }

    #[inline]
    pub(crate) fn push(&mut self, contact: Contact<S>) {
        if self.len + self.aside + self.asleep < self.slots.len() {
            self.slots[self.len] = contact;
            self.len += 1;
        } else {
            self.missing += 1;
        }
    }

    /// Counts, at the end of a step.
    pub(crate) fn count(&mut self) {
        self.peak = self.peak.max((self.len + self.aside + self.asleep) as u16);
        self.lost = self.lost.saturating_add(self.missing);
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

/// [`slice::swap`], out of line.
#[inline(never)]
fn exchange<S: Scalar>(contacts: &mut [Contact<S>], one: usize, other: usize) {
    contacts.swap(one, other);
}
