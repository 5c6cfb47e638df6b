//! The sweep of moving bodies from the lowest centre up.
//!
//! A body that the sweep has passed waits in a list, one of 64 columns hashed from its centre, until the sweep has left it behind;
//! the next body looks into the columns that it can reach. Bodies too large or too fast for the columns wait in a list of their own.

use super::broadphase::{Pairs, SKIN};
use super::grid::Bounds;
use super::order::Ground;
use super::pairs::{NONE, Update};
use crate::body::Body;
use crate::effects::Switches;
use crate::scalar::{Quantity, Scalar, px};
use crate::vec2::Vec2;

const COLUMNS: usize = 64;
/// Bodies that the width of the columns is taken from, at most.
const SAMPLE: usize = 64;

/// The neighbourhood of a body: whom it may touch before both have moved by half of the margin, or in this step at their speeds.
pub(crate) struct Near<S: Scalar> {
    centre: Vec2<S::Real>,
    /// Half extents and the margin.
    reach: Vec2<S::Real>,
    velocity: Vec2<S::Speed>,
    /// How far any two bodies come together in a step, at most.
    closing: S::Real,
}

impl<S: Scalar> Near<S> {
    #[inline]
    pub(crate) fn new(body: &Body<S>, margin: S::Real, closing: S::Real) -> Self {
        Self { centre: body.position, reach: body.half.map(|half| half + margin), velocity: body.velocity, closing }
    }

    #[inline]
    fn may_meet(&self, other: &Body<S>) -> bool {
        // Most are too far aside: that is asked first, and speeds only where they matter.
        let apart = |offset: S::Real, reach: S::Real, own: S::Speed, other: S::Speed| {
            let space = offset.abs() - reach;
            space > S::Real::ZERO && (space > self.closing || space > approach::<S>(own, other))
        };
        !apart(other.position.x - self.centre.x, self.reach.x + other.half.x, self.velocity.x, other.velocity.x)
            && !apart(other.position.y - self.centre.y, self.reach.y + other.half.y, self.velocity.y, other.velocity.y)
    }

    /// Where it may touch what doesn't move.
    pub(crate) fn bounds(&self) -> Bounds<S> {
        let speed = self.velocity.map(|v| S::in_a_step(v).abs());
        Bounds::around(self.centre, self.reach + speed)
    }
}

/// How far two bodies come together along an axis in a step.
#[inline(never)]
fn approach<S: Scalar>(own: S::Speed, other: S::Speed) -> S::Real {
    // The other may be stopped in this step: then the own speed counts.
    S::in_a_step(other.saturating_sub(own).abs().greater(own.abs()))
}

/// The bodies that the sweep has passed and not yet left behind.
pub(crate) struct Sweep<'a, R, T> {
    links: &'a mut [u16],
    columns: [u16; COLUMNS],
    /// Large and fast bodies passed.
    wide: u16,
    /// Width of a column, as a power of two of px.
    shift: u32,
    /// How far whoever waits in a column reaches beyond its centre, at most.
    reach: R,
    /// Mean velocity: what all share brings nobody together.
    drift: Vec2<T>,
    ground: Ground,
}

impl<'a, R: Quantity, T: Quantity> Sweep<'a, R, T> {
    /// Columns as wide as the mean body, and room for thrice its speed: the mean of some [`SAMPLE`] is as good as that of all.
    pub(crate) fn new<S: Scalar<Real = R, Speed = T>>(
        links: &'a mut [u16],
        order: &[u16],
        bodies: &[Body<S>],
        ground: Ground,
    ) -> Self {
        let step = order.len().div_ceil(SAMPLE).max(1);
        let sample = || order.iter().step_by(step).map(|&slot| &bodies[usize::from(slot)]);
        let count = order.len().div_ceil(step).max(1) as u32;
        let drift = S::mean_velocity(sample().map(|body| body.velocity), count);
        let mut sweep = Self { links, columns: [NONE; COLUMNS], wide: NONE, shift: 0, reach: R::ZERO, drift, ground };
        let width: u32 = sample().map(|body| S::floor(skinned(body)) as u32).sum();
        sweep.shift = (2 * width.div_ceil(count)).max(4).next_power_of_two().trailing_zeros();
        let speed = S::mean_length(sample().map(|body| sweep.speed(body)), count);
        // With room for twice the mean, so many are too fast to wait in a heap that falls that it costs a quarter more.
        sweep.reach = S::real(px(1 << sweep.shift >> 1)) + speed + speed + speed;
        sweep
    }

    /// How far a body comes in a step, beside what all do.
    #[inline]
    fn speed<S: Scalar<Real = R, Speed = T>>(&self, body: &Body<S>) -> R {
        let speed = body.velocity.saturating_sub(self.drift).map(Quantity::abs);
        S::in_a_step(speed.x.greater(speed.y))
    }

    /// How far a body reaches in a step.
    #[inline]
    fn extent<S: Scalar<Real = R, Speed = T>>(&self, body: &Body<S>) -> R {
        skinned(body) + self.speed(body)
    }

    /// Notes all bodies passed that the body at this rank may meet, then lets it wait.
    #[inline]
    pub(crate) fn visit<S: Scalar<Real = R, Speed = T>>(
        &mut self,
        rank: usize,
        order: &[u16],
        near: &Near<S>,
        pairs: &Pairs<'_, S, impl Switches>,
        update: &mut Update<'_, '_, S>,
    ) {
        let slot = order[rank];
        let body = &pairs.bodies[usize::from(slot)];
        let extent = self.extent(body);
        if extent > self.reach {
            self.visit_wide(rank, order, near, pairs, update);
            return;
        }
        let (depth, across) = (self.ground.depth(body.position), self.ground.across(body.position));
        let reach = extent + self.reach;
        let behind = depth.saturating_add(self.reach + self.reach);
        let column = |x: i32| x >> self.shift;
        let (centre, radius) = (S::floor(across), S::floor(reach) + 1);
        let (first, last, home) = (column(centre - radius), column(centre + radius), column(centre));
        let group = if pairs.are_known_of(body) { update.group(slot) } else { NONE };
        for column in first..=last {
            let head = &mut self.columns[column as usize % COLUMNS];
            let (mut previous, mut other) = (NONE, *head);
            while other != NONE {
                let waiting = &pairs.bodies[usize::from(other)];
                if near.may_meet(waiting) {
                    if !update.keep_pair(group, slot, other) {
                        pairs.note(slot, other, update);
                    }
                } else if self.ground.depth(waiting.position) > behind {
                    // It came before all that follow it in the list: they are behind as well.
                    let link = if previous == NONE { &mut *head } else { &mut self.links[usize::from(previous)] };
                    *link = NONE;
                    break;
                }
                previous = other;
                other = self.links[usize::from(other)];
            }
        }
        let column = &mut self.columns[home as usize % COLUMNS];
        self.links[usize::from(slot)] = *column;
        *column = slot;
    }

    /// The same for a large or fast body, which doesn't wait: it looks at all whose depth it reaches, passed and to come.
    #[cold]
    #[inline(never)]
    fn visit_wide<S: Scalar<Real = R, Speed = T>>(
        &mut self,
        rank: usize,
        order: &[u16],
        near: &Near<S>,
        pairs: &Pairs<'_, S, impl Switches>,
        update: &mut Update<'_, '_, S>,
    ) {
        let slot = order[rank];
        let body = &pairs.bodies[usize::from(slot)];
        let (depth, extent) = (self.ground.depth(body.position), self.extent(body));
        let reach = extent.saturating_add(self.reach);
        let is_reached =
            |&&other: &&u16| (self.ground.depth(pairs.bodies[usize::from(other)].position) - depth).abs() <= reach;
        let waits = |other: u16| {
            let other = &pairs.bodies[usize::from(other)];
            other.status.collides() && near.may_meet(other) && self.extent(other) <= self.reach
        };
        for &other in order[..rank].iter().rev().take_while(is_reached) {
            if waits(other) {
                pairs.note(slot, other, update);
            }
        }
        for &other in order[rank + 1..].iter().take_while(is_reached) {
            if waits(other) {
                pairs.note(other, slot, update);
            }
        }
        // Two of this kind are found by the upper one.
        let mut other = self.wide;
        while other != NONE {
            if near.may_meet(&pairs.bodies[usize::from(other)]) {
                pairs.note(slot, other, update);
            }
            other = self.links[usize::from(other)];
        }
        self.links[usize::from(slot)] = self.wide;
        self.wide = slot;
    }
}

/// Half of the larger side and a skin.
#[inline]
fn skinned<S: Scalar>(body: &Body<S>) -> S::Real {
    body.half.x.greater(body.half.y) + S::real(px(SKIN))
}
