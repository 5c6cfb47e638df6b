//! When a moving shape meets a resting one: exact, however far it moves.

use super::{Outline, Penetration, Sum, away, gap, part};
use crate::scalar::{Exact, Quantity, Scalar};
use crate::vec2::{Vec2, vec2};

/// Where a moving shape meets a resting one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<S: Scalar> {
    /// Part of the motion that is free, 0..=1, rounded down: [`part`] of the motion ends where the shapes don't
    /// overlap. In fixed point boxes then touch to the last place for motions up to 8192 px, to the last two beyond.
    pub time: S::Unit,
    /// Unit normal of the resting shape at the point that is met; against it goes the motion, unless the shapes overlapped.
    pub normal: Vec2<S::Unit>,
    /// If the shapes overlapped from the start, how deep, px: `time` is then 0 and `normal` the shortest way out. Otherwise 0.
    pub depth: S::Real,
}

/// Shapes that overlap from the start.
impl<S: Scalar> From<Penetration<S>> for Hit<S> {
    fn from(overlap: Penetration<S>) -> Self {
        Self { time: S::Unit::ZERO, normal: overlap.normal, depth: overlap.depth }
    }
}

/// Sweeps a shape along a motion, |component| <= 32767 px, against a resting shape.
///
/// Touching is not meeting: none if the shapes only graze, touch at the end, or touch and move along each other or apart. Shapes
/// that overlap from the start always meet, wherever they move: see [`Hit::depth`].
#[inline(never)]
pub fn cast<S: Scalar>(mover: &Outline<S>, motion: Vec2<S::Real>, target: &Outline<S>) -> Option<Hit<S>> {
    Sum::of(mover, target).cast(motion)
}

/// [`cast`] for boxes: without what round corners take.
#[inline(never)]
pub(crate) fn cast_box<S: Scalar>(mover: &Outline<S>, motion: Vec2<S::Real>, target: &Outline<S>) -> Option<Hit<S>> {
    let sum = Sum::of_boxes(mover, target);
    let entry = enter::<S>(sum.offset, motion, sum.reach)?;
    Some(if sum.is_reached() { sum.way_through_a_face().into() } else { sum.meet_face(entry) })
}

/// A moving point and the sum's span, seen along one axis.
#[derive(Clone, Copy)]
struct Lane<S: Scalar> {
    /// Way to the span; below 0 inside.
    gap: S::Real,
    /// Way to the span's far end.
    exit: S::Real,
    /// Length of the whole motion.
    pace: S::Real,
}

impl<S: Scalar> Lane<S> {
    /// None if the point never gets inside.
    fn new(offset: S::Real, motion: S::Real, reach: S::Real) -> Option<Self> {
        let zero = S::Real::ZERO;
        let (gap, pace) = (gap::<S>(offset, reach), motion.abs());
        let towards = if motion < zero { offset < zero } else { offset >= zero };
        if gap >= zero && (!towards || gap >= pace) {
            return None;
        }
        let exit = if towards { offset.abs().saturating_add(reach) } else { -gap };
        Some(Self { gap, exit, pace })
    }

    fn is_outside(&self) -> bool {
        self.gap >= S::Real::ZERO
    }

    /// Whether the point enters this span before it leaves the other.
    fn enters_before_leaving(&self, other: &Self) -> bool {
        other.pace == S::Real::ZERO || S::Real::product_less(self.gap, other.pace, other.exit, self.pace)
    }

    /// Whether the point, outside of both, enters this span after the other.
    fn enters_after(&self, other: &Self) -> bool {
        S::Real::product_less(other.gap, self.pace, self.gap, other.pace)
    }
}

/// A point that enters a rectangle.
#[derive(Clone, Copy)]
struct Entry<S: Scalar> {
    time: S::Unit,
    /// Through the left or right edge, not the upper or lower.
    sideways: bool,
}

/// When a point enters a rectangle at `offset` from outside. Of two edges that it meets at once, the upper or lower counts.
fn enter<S: Scalar>(offset: Vec2<S::Real>, motion: Vec2<S::Real>, half: Vec2<S::Real>) -> Option<Entry<S>> {
    let x = Lane::<S>::new(offset.x, motion.x, half.x)?;
    let y = Lane::<S>::new(offset.y, motion.y, half.y)?;
    // The span that is entered last decides.
    let sideways = x.is_outside() && (!y.is_outside() || x.enters_after(&y));
    let (last, other) = if sideways { (x, y) } else { (y, x) };
    if !last.is_outside() {
        return Some(Entry { time: S::Unit::ZERO, sideways });
    }
    last.enters_before_leaving(&other).then(|| Entry { time: last.gap.fraction_of(last.pace), sideways })
}

impl<S: Scalar> Sum<S> {
    fn cast(&self, motion: Vec2<S::Real>) -> Option<Hit<S>> {
        let outer = enter::<S>(self.offset, motion, self.reach)?;
        if self.is_entered() {
            return Some(self.way_out().into());
        }
        if self.round == S::Real::ZERO {
            return Some(self.meet_face(outer));
        }
        // Where the point crosses the outermost edges, it stands before a face or before a corner.
        let place = self.offset_after(motion, outer.time);
        if self.corner_from(place).is_none()
            && let Some(entry) = self.enter_faces(motion, outer.sideways)
            && entry.sideways == outer.sideways
        {
            return Some(self.meet_face(entry));
        }
        self.cast_at_corner(place, motion).or_else(|| {
            // Rounding took a face's last place for the corner's.
            let (level, upright) = (self.enter_faces(motion, true), self.enter_faces(motion, false));
            let first = match (level, upright) {
                (Some(level), Some(upright)) if upright.time < level.time => Some(upright),
                _ => level.or(upright),
            };
            first.map(|entry| self.meet_face(entry))
        })
    }

    /// Enters the rectangle that lies between the left and right faces (`sideways`) or the upper and lower ones.
    fn enter_faces(&self, motion: Vec2<S::Real>, sideways: bool) -> Option<Entry<S>> {
        let half = if sideways { vec2(self.reach.x, self.rect.y) } else { vec2(self.rect.x, self.reach.y) };
        enter::<S>(self.offset, motion, half)
    }

    fn meet_face(&self, entry: Entry<S>) -> Hit<S> {
        let zero = S::Unit::ZERO;
        let (left_or_right, up_or_down) = (away::<S>(self.offset.x), away::<S>(self.offset.y));
        let normal = if entry.sideways { vec2(left_or_right, zero) } else { vec2(zero, up_or_down) };
        Hit { time: entry.time, normal, depth: S::Real::ZERO }
    }

    /// Meets the corner next to a place on the way.
    fn cast_at_corner(&self, place: Vec2<S::Real>, motion: Vec2<S::Real>) -> Option<Hit<S>> {
        let beside = |place: S::Real, rect: S::Real| if place < S::Real::ZERO { rect } else { -rect };
        let shift = vec2(beside(place.x, self.rect.x), beside(place.y, self.rect.y));
        let estimate = S::Real::approach(self.offset.saturating_add(shift), motion, self.round)?;
        let after = |time| Self { offset: self.offset_after(motion, time), ..*self };
        let time = last_clear::<S>(estimate, motion, |time| !after(time).is_entered());
        Some(Hit { time, normal: after(time).way_out().normal, depth: S::Real::ZERO })
    }

    /// From the first one's centre to the second's after part of a motion.
    #[inline(never)]
    fn offset_after(&self, motion: Vec2<S::Real>, time: S::Unit) -> Vec2<S::Real> {
        self.offset.saturating_sub(part::<S>(motion, time))
    }
}

/// The time of the closed formula is rounded, and so is the place where it leads: goes back, a unit of the last place first,
/// twice as far each time, to a place that is clear.
fn last_clear<S: Scalar>(estimate: S::Unit, motion: Vec2<S::Real>, is_clear: impl Fn(S::Unit) -> bool) -> S::Unit {
    if is_clear(estimate) {
        return estimate;
    }
    let (unit, longest) = (S::Real::NUDGE, motion.x.abs().greater(motion.y.abs()));
    if longest <= unit + unit {
        return S::Unit::ZERO;
    }
    // Of motions beyond 16384 px, a unit is too small a part.
    let step = unit.fraction_of(longest);
    let mut step = if step > S::Unit::ZERO { step } else { (unit + unit).fraction_of(longest) };
    let mut time = estimate;
    while step > S::Unit::ZERO && step < time {
        time = time - step;
        if is_clear(time) {
            return time;
        }
        step = step.saturating_add(step);
    }
    S::Unit::ZERO
}
