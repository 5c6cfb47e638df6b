//! The static layer: a hashed grid, built once and read every step.

use crate::body::Body;
use crate::geometry::Bounds;
use crate::scalar::Scalar;
use crate::vec2::vec2;

/// Cells along each side of the torus.
const SIDE: i32 = 16;
const BUCKETS: usize = (SIDE * SIDE) as usize;
/// Shift of whole px that puts every coordinate that a body can have at or above 0.
const ORIGIN: i32 = 1 << 15;
/// Cells of 16 px at least, so large that all entries fit and none share a bucket: a room's walls are then far from its middle. At
/// `COARSEST` the whole world is one cell.
const FINEST: u32 = 4;
const COARSEST: u32 = 16;

/// Static bodies by cell; cells that are 16 apart share a bucket.
#[derive(Debug)]
pub(crate) struct Grid<'a> {
    /// Slots, bucket by bucket.
    entries: &'a mut [u16],
    /// Where each bucket ends; it begins where the one before ends.
    ends: [u16; BUCKETS],
    /// Buckets that hold somebody, row by row, a bit a column: most bodies are near none.
    taken: [u16; SIDE as usize],
    shift: u32,
}

/// A span of cells, ends included.
#[derive(Clone, Copy)]
struct Cells {
    left: i32,
    top: i32,
    right: i32,
    bottom: i32,
}

impl Cells {
    fn of<S: Scalar>(bounds: &Bounds<S>, shift: u32) -> Self {
        let cell = |edge| (S::floor(edge) + ORIGIN) >> shift;
        let Bounds { min, max } = bounds;
        Self { left: cell(min.x), top: cell(min.y), right: cell(max.x), bottom: cell(max.y) }
    }

    #[inline]
    fn under<S: Scalar>(body: &Body<S>, shift: u32) -> Self {
        Self::of::<S>(&box_of(body), shift)
    }

    /// Calls a function for every bucket.
    #[inline]
    fn each_bucket(self, mut visit: impl FnMut(usize)) {
        for y in self.top..=self.bottom.min(self.top + SIDE - 1) {
            for x in self.left..=self.right.min(self.left + SIDE - 1) {
                visit(bucket(x, y));
            }
        }
    }

    /// Whether one of the buckets is taken.
    #[inline]
    fn meet(self, taken: &[u16; SIDE as usize]) -> bool {
        let columns = (2u32 << (self.right - self.left).min(SIDE - 1)) - 1;
        let columns = (columns as u16).rotate_left((self.left & (SIDE - 1)) as u32);
        (self.top..=self.bottom.min(self.top + SIDE - 1)).any(|y| taken[(y & (SIDE - 1)) as usize] & columns != 0)
    }

    /// The bucket of the cell in which two bodies' common part begins: there, and only there, the pair is reported.
    fn meeting_bucket(self, other: Self) -> usize {
        bucket(self.left.max(other.left), self.top.max(other.top))
    }
}

#[inline]
fn box_of<S: Scalar>(body: &Body<S>) -> Bounds<S> {
    Bounds { min: vec2(body.left(), body.top()), max: vec2(body.right(), body.bottom()) }
}

#[inline]
fn bucket(x: i32, y: i32) -> usize {
    ((y & (SIDE - 1)) * SIDE + (x & (SIDE - 1))) as usize
}

/// Calls a function for every bucket of every body.
#[inline(never)]
fn each_entry<S: Scalar>(statics: &[u16], bodies: &[Body<S>], shift: u32, mut visit: impl FnMut(u16, usize)) {
    for &slot in statics {
        Cells::under(&bodies[usize::from(slot)], shift).each_bucket(|bucket| visit(slot, bucket));
    }
}

impl<'a> Grid<'a> {
    /// An empty grid. `entries` holds at least one entry for each static body; more make finer cells.
    pub(crate) fn new(entries: &'a mut [u16]) -> Self {
        Self { entries, ends: [0; BUCKETS], taken: [0; SIDE as usize], shift: FINEST }
    }

    /// Becomes as another one of the same size is.
    pub(crate) fn copy_from(&mut self, other: &Grid<'_>) {
        let Grid { entries, ends, taken, shift } = other;
        self.entries.copy_from_slice(entries);
        (self.ends, self.taken, self.shift) = (*ends, *taken, *shift);
    }

    /// Files the bodies in the finest cells that fit.
    #[inline(never)]
    pub(crate) fn rebuild<S: Scalar>(&mut self, statics: &[u16], bodies: &[Body<S>]) {
        let mut all = Cells { left: i32::MAX, top: i32::MAX, right: i32::MIN, bottom: i32::MIN };
        for &slot in statics {
            let Cells { left, top, right, bottom } = Cells::under(&bodies[usize::from(slot)], 0);
            (all.left, all.top) = (all.left.min(left), all.top.min(top));
            (all.right, all.bottom) = (all.right.max(right), all.bottom.max(bottom));
        }
        let mut counts = [0u32; BUCKETS];
        for shift in FINEST..=COARSEST {
            self.shift = shift;
            let beyond = |first: i32, last: i32| (last >> shift).saturating_sub(first >> shift) >= SIDE;
            if beyond(all.left, all.right) || beyond(all.top, all.bottom) {
                continue;
            }
            counts = [0; BUCKETS];
            each_entry(statics, bodies, shift, |_, bucket| counts[bucket] += 1);
            if counts.iter().sum::<u32>() as usize <= self.entries.len() {
                break;
            }
        }
        let mut total = 0;
        self.taken = [0; SIDE as usize];
        for (bucket, (end, count)) in self.ends.iter_mut().zip(&counts).enumerate() {
            *end = total; // a start, until the bucket is filled
            total += *count as u16;
            self.taken[bucket / SIDE as usize] |= u16::from(*count > 0) << (bucket % SIDE as usize);
        }
        let Self { entries, ends, shift, .. } = self;
        each_entry(statics, bodies, *shift, |slot, bucket| {
            let end = &mut ends[bucket];
            entries[usize::from(*end)] = slot;
            *end += 1;
        });
    }

    /// Whether there are no static bodies.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.ends[BUCKETS - 1] == 0
    }

    /// Notes all static bodies whose bounding boxes touch these bounds, each once.
    #[inline]
    pub(crate) fn visit<S: Scalar>(&self, bounds: &Bounds<S>, bodies: &[Body<S>], mut note: impl FnMut(u16)) {
        let cells = Cells::of(bounds, self.shift);
        if !cells.meet(&self.taken) {
            return;
        }
        cells.each_bucket(|bucket| {
            let start = if bucket == 0 { 0 } else { self.ends[bucket - 1] };
            for &slot in &self.entries[usize::from(start)..usize::from(self.ends[bucket])] {
                let other = &bodies[usize::from(slot)];
                if bounds.touch(&box_of(other)) && cells.meeting_bucket(Cells::under(other, self.shift)) == bucket {
                    note(slot);
                }
            }
        });
    }
}
