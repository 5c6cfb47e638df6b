//! Which way is down, and bodies in that order: from the ground up.

use crate::body::Body;
use crate::scalar::{Quantity, Scalar};
use crate::vec2::Vec2;

/// The axis along which gravity pulls hardest: where the ground is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Ground {
    horizontal: bool,
    reversed: bool,
}

impl Ground {
    /// Without gravity, the ground is below.
    pub(crate) fn of<T: Quantity>(gravity: Vec2<T>) -> Self {
        let horizontal = gravity.x.abs() > gravity.y.abs();
        let pull = if horizontal { gravity.x } else { gravity.y };
        Self { horizontal, reversed: pull < T::ZERO }
    }

    pub(crate) fn is_horizontal(self) -> bool {
        self.horizontal
    }

    pub(crate) fn is_reversed(self) -> bool {
        self.reversed
    }

    /// Component towards the ground.
    #[inline]
    pub(crate) fn depth<T: Quantity>(self, v: Vec2<T>) -> T {
        let along = self.upright(v);
        if self.reversed { -along } else { along }
    }

    /// Component along gravity, whichever way it pulls: loops that ask for this alone don't come twice, once for each way.
    #[inline]
    pub(crate) fn upright<T: Quantity>(self, v: Vec2<T>) -> T {
        if self.horizontal { v.x } else { v.y }
    }

    /// Component along the ground.
    #[inline]
    pub(crate) fn across<T: Quantity>(self, v: Vec2<T>) -> T {
        if self.horizontal { v.y } else { v.x }
    }

    /// Adds to the component towards the ground, which doesn't leave the format.
    #[inline]
    pub(crate) fn add<T: Quantity>(self, v: &mut Vec2<T>, by: T) {
        let by = if self.reversed { -by } else { by };
        if self.horizontal {
            v.x = v.x + by;
        } else {
            v.y = v.y + by;
        }
    }

    /// Adds to the component towards the ground.
    #[inline]
    pub(crate) fn lower<T: Quantity>(self, v: &mut Vec2<T>, by: T) {
        let along = if self.horizontal { &mut v.x } else { &mut v.y };
        *along = if self.reversed { along.saturating_sub(by) } else { along.saturating_add(by) };
    }
}

/// Sorts a list in any order: a Shell sort, with gaps by G. Gonnet and R. Baeza-Yates (1991).
#[inline(never)]
pub(crate) fn sort<S: Scalar>(list: &mut [u16], bodies: &[Body<S>], ground: Ground) {
    let mut gap = list.len();
    while gap > 1 {
        gap = (5 * gap / 11).max(1);
        for place in gap..list.len() {
            insert(list, bodies, ground, place, gap);
        }
    }
}

/// Sorts a list that was sorted not long ago.
#[inline(never)]
pub(crate) fn resort<S: Scalar>(list: &mut [u16], bodies: &[Body<S>], ground: Ground) {
    let key = |slot: u16| ground.upright(bodies[usize::from(slot)].position);
    let Some(mut before) = list.first().map(|&slot| key(slot)) else {
        return;
    };
    for place in 1..list.len() {
        let own = key(list[place]);
        // Most lie right.
        if own == before || (own > before) != ground.reversed {
            insert(list, bodies, ground, place, 1);
            before = key(list[place]);
        } else {
            before = own;
        }
    }
}

/// Moves an entry down to where it belongs among every `gap`-th one before it, which are sorted.
#[inline(always)] // saving registers would cost as much as the work
fn insert<S: Scalar>(list: &mut [u16], bodies: &[Body<S>], ground: Ground, mut place: usize, gap: usize) {
    let slot = list[place];
    while place >= gap && precedes(slot, list[place - gap], bodies, ground) {
        list[place] = list[place - gap];
        place -= gap;
    }
    list[place] = slot;
}

/// From the lowest centre up, equal ones from left to right, then the lower ones, those by slot: a total order.
#[inline]
pub(crate) fn precedes<S: Scalar>(a: u16, b: u16, bodies: &[Body<S>], ground: Ground) -> bool {
    let (first, second) = (&bodies[usize::from(a)], &bodies[usize::from(b)]);
    let (one, other) = (ground.upright(first.position), ground.upright(second.position));
    if one == other { breaks_tie(a, b, first, second, ground) } else { (one > other) != ground.reversed }
}

#[cold]
fn breaks_tie<S: Scalar>(a: u16, b: u16, first: &Body<S>, second: &Body<S>, ground: Ground) -> bool {
    let (left, right) = (ground.across(first.position), ground.across(second.position));
    if left != right {
        return left < right;
    }
    let (small, large) = (ground.depth(first.half).abs(), ground.depth(second.half).abs());
    if small != large {
        return small < large;
    }
    a < b
}
