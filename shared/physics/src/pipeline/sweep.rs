//! The sweep of moving bodies from the lowest centre up.
//!
//! A body that the sweep has passed waits in a list, one of 64 columns hashed from its centre; the next body looks into the columns
//! that it can reach, in each from the nearest body down to the first that lies too deep. Bodies too large or too fast for the
//! columns wait in a list of their own.

use super::broadphase::SKIN;
use super::order::Ground;
use super::pairs::NONE;
use crate::body::Body;
use crate::scalar::{EXTENT_LIMIT, Quantity, Scalar, px, ratio};
use crate::vec2::{Vec2, vec2};

const COLUMNS: usize = 64;
/// Bodies that the width of the columns is taken from.
const SAMPLE: usize = 8;

/// The neighbourhood of a body: whom it may touch before both have moved by half of the margin, or in this step at their speeds.
pub(crate) struct Near<S: Scalar> {
    centre: Vec2<S::Real>,
    /// Half extents.
    half: Vec2<S::Real>,
    margin: S::Real,
    /// What its velocity makes in a step.
    motion: Vec2<S::Real>,
}

impl<S: Scalar> Near<S> {
    #[inline]
    pub(crate) fn new(body: &Body<S>, margin: S::Real) -> Self {
        Self { centre: body.position, half: body.half, margin, motion: body.velocity.map(S::in_a_step) }
    }

    #[inline]
    fn may_meet(&self, other: &Body<S>) -> bool {
        // Speeds are asked only where they matter. Of two that move alike, one may be stopped: then the own speed counts.
        let apart = |offset: S::Real, reach: S::Real, own: S::Real, other: S::Speed| {
            let space = magnitude(offset) - reach - self.margin;
            space > S::Real::ZERO && space > magnitude(S::in_a_step(other) - own).greater(magnitude(own))
        };
        !apart(other.position.x - self.centre.x, self.half.x + other.half.x, self.motion.x, other.velocity.x)
            && !apart(other.position.y - self.centre.y, self.half.y + other.half.y, self.motion.y, other.velocity.y)
    }
}

/// The absolute value of what isn't the least value of its format.
#[inline]
pub(crate) fn magnitude<T: Quantity>(value: T) -> T {
    value.greater(-value)
}

/// The bodies that the sweep has passed.
pub(crate) struct Sweep<'a, S: Scalar> {
    links: &'a mut [u16],
    /// Who came last into each column, and of those too wide for them.
    heads: [u16; COLUMNS + 1],
    /// Width of a column, as a power of two of px.
    shift: u32,
    /// How far whoever waits in a column reaches beyond its centre, at most.
    reach: S::Real,
    /// How much further the widest of all that wait reaches.
    beyond: S::Real,
    /// Mean motion in a step: what all share brings nobody together.
    drift: Vec2<S::Real>,
    ground: Ground,
}

impl<'a, S: Scalar> Sweep<'a, S> {
    /// Columns as wide as the mean body and what it moves, and room for thrice its speed: the mean of some is as good as that of all.
    pub(crate) fn new(links: &'a mut [u16], order: &[u16], bodies: &[Body<S>], ground: Ground) -> Self {
        let zero = S::Real::ZERO;
        let drift = vec2(zero, zero);
        let mut sweep = Self { links, heads: [NONE; COLUMNS + 1], shift: 0, reach: zero, beyond: zero, drift, ground };
        let sample = |number: usize| order.get(number * order.len() / SAMPLE).map(|&slot| &bodies[usize::from(slot)]);
        let share = |length: S::Real| S::half(S::half(S::half(length))); // an eighth
        for body in (0..SAMPLE).filter_map(sample) {
            sweep.drift = sweep.drift + body.velocity.map(|v| share(S::in_a_step(v)));
        }
        let (mut width, mut speed) = (0, zero);
        for body in (0..SAMPLE).filter_map(sample) {
            width += S::floor(body.half.x.greater(body.half.y)) as u32 + SKIN as u32;
            let beside = sweep.beside(body.velocity.map(S::in_a_step));
            speed = speed + share(beside.x.greater(beside.y));
        }
        // No wider than leaves sums of coordinates and reaches in the format; what is larger is wide.
        let width = (2 * width).div_ceil(SAMPLE as u32).clamp(4, EXTENT_LIMIT as u32).next_power_of_two();
        sweep.shift = (width + 2 * S::floor(speed) as u32).next_power_of_two().trailing_zeros();
        // With room for twice the mean, so many are too fast to wait in a heap that falls that it costs a quarter more.
        sweep.reach = S::real(px((width / 2) as i16)) + speed + speed + speed;
        sweep
    }

    /// How far a motion leads, beside what all share.
    #[inline]
    fn beside(&self, motion: Vec2<S::Real>) -> Vec2<S::Real> {
        (motion - self.drift).map(magnitude)
    }

    /// Tells all bodies passed that a body may meet, then lets it wait.
    #[inline]
    pub(crate) fn visit(&mut self, slot: u16, near: &Near<S>, bodies: &[Body<S>], mut meet: impl FnMut(u16)) {
        let ground = self.ground;
        let motion = near.motion;
        let beside = self.beside(motion);
        let farthest = vec2(beside.x.greater(magnitude(motion.x)), beside.y.greater(magnitude(motion.y)));
        let margin = near.margin + self.reach + S::real(ratio(1, 16)); // and some for rounding
        let reach = near.half + farthest + vec2(margin, margin);
        // Where the centres lie of those whom it may meet: along gravity, and across it.
        let mut along = Span::around(ground.upright(near.centre), ground.upright(reach));
        let mut across = Span::around(ground.across(near.centre), ground.across(reach));
        let shift = self.shift;
        let column_at = |across: S::Real| S::floor(across) >> shift;
        // Beyond so many columns, the same ones come again.
        let first = column_at(across.min);
        let last = column_at(across.max).min(first + COLUMNS as i32 - 1);
        let wide = i32::from(self.heads[COLUMNS] != NONE);
        let links = &mut self.links[..bodies.len()];
        let mut column = first;
        while column <= last + wide {
            let list = if column > last {
                (along, across) = (along.grown(self.beyond), across.grown(self.beyond));
                COLUMNS
            } else {
                column as usize % COLUMNS
            };
            let mut other = self.heads[list];
            while let Some(waiting) = bodies.get(usize::from(other)) {
                if !along.contains(ground.upright(waiting.position)) {
                    break; // it came before all that follow it in the list
                }
                if across.contains(ground.across(waiting.position)) && near.may_meet(waiting) {
                    meet(other);
                }
                other = links[usize::from(other)];
            }
            column += 1;
        }
        let reach = (near.half.x + beside.x).greater(near.half.y + beside.y);
        let list = if reach > self.reach {
            self.beyond = self.beyond.greater(reach - self.reach);
            COLUMNS
        } else {
            column_at(ground.across(near.centre)) as usize % COLUMNS
        };
        links[usize::from(slot)] = self.heads[list];
        self.heads[list] = slot;
    }
}

/// Coordinates between two, ends included.
#[derive(Clone, Copy)]
struct Span<T> {
    min: T,
    max: T,
}

impl<T: Quantity> Span<T> {
    #[inline]
    fn around(centre: T, reach: T) -> Self {
        Self { min: centre - reach, max: centre + reach }
    }

    #[inline]
    fn grown(self, by: T) -> Self {
        Self { min: self.min - by, max: self.max + by }
    }

    #[inline]
    fn contains(self, at: T) -> bool {
        at >= self.min && at <= self.max
    }
}
