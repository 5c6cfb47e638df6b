//! The static layer: a hashed grid, built once and read every step.

use crate::body::Body;
use crate::scalar::Scalar;

/// Buckets, as a torus of 8 x 8 cells.
const BUCKETS: usize = 64;
/// Shift of whole px that puts every coordinate that a body can have at or above 0.
const ORIGIN: i32 = 1 << 15;
/// Cells start at 16 px, and grow until all entries fit. At `COARSEST` the whole world is one cell.
const FINEST: u32 = 4;
const COARSEST: u32 = 16;

/// Static bodies by cell; cells that are 8 apart share a bucket.
#[derive(Debug)]
pub(crate) struct Grid<'a> {
    /// Slots, bucket by bucket.
    entries: &'a mut [u16],
    /// Where each bucket ends; it begins where the one before ends.
    ends: [u16; BUCKETS],
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
    fn of<S: Scalar>(body: &Body<S>, shift: u32) -> Self {
        let cell = |edge| (S::floor(edge) + ORIGIN) >> shift;
        Self { left: cell(body.left()), top: cell(body.top()), right: cell(body.right()), bottom: cell(body.bottom()) }
    }

    /// The set of buckets, a bit each.
    fn buckets(self) -> u64 {
        let across = (self.left..=self.right.min(self.left + 7)).fold(0u64, |set, x| set | 1 << (x & 7));
        (self.top..=self.bottom.min(self.top + 7)).fold(0, |set, y| set | across << ((y & 7) * 8))
    }

    /// The bucket of the cell in which two bodies' common part begins: there, and only there, the pair is reported.
    fn meeting_bucket(self, other: Self) -> u32 {
        let (x, y) = (self.left.max(other.left), self.top.max(other.top));
        (x & 7) as u32 | ((y & 7) as u32) << 3
    }
}

/// The bits that are set, in ascending order.
fn bits(mut set: u64) -> impl Iterator<Item = u32> {
    core::iter::from_fn(move || {
        let bit = set.trailing_zeros();
        set &= set.wrapping_sub(1);
        (bit < u64::BITS).then_some(bit)
    })
}

impl<'a> Grid<'a> {
    /// An empty grid. `entries` holds at least one entry for each static body; more make finer cells.
    pub(crate) fn new(entries: &'a mut [u16]) -> Self {
        Self { entries, ends: [0; BUCKETS], shift: FINEST }
    }

    /// Files the bodies in the finest cells that fit.
    pub(crate) fn rebuild<S: Scalar>(&mut self, statics: &[u16], bodies: &[Body<S>]) {
        let mut counts = [0u32; BUCKETS];
        for shift in FINEST..=COARSEST {
            self.shift = shift;
            counts = [0; BUCKETS];
            for &slot in statics {
                for bucket in bits(Cells::of(&bodies[usize::from(slot)], shift).buckets()) {
                    counts[bucket as usize] += 1;
                }
            }
            if counts.iter().sum::<u32>() as usize <= self.entries.len() {
                break;
            }
        }
        let mut total = 0;
        for (end, count) in self.ends.iter_mut().zip(counts) {
            *end = total; // a start, until the bucket is filled
            total += count as u16;
        }
        for &slot in statics {
            for bucket in bits(Cells::of(&bodies[usize::from(slot)], self.shift).buckets()) {
                let end = &mut self.ends[bucket as usize];
                self.entries[usize::from(*end)] = slot;
                *end += 1;
            }
        }
    }

    /// Notes all static bodies whose bounding boxes touch this one's, each once.
    pub(crate) fn visit<S: Scalar>(&self, body: &Body<S>, bodies: &[Body<S>], note: &mut impl FnMut(u16)) {
        if self.ends[BUCKETS - 1] == 0 {
            return;
        }
        let cells = Cells::of(body, self.shift);
        for bucket in bits(cells.buckets()) {
            let start = if bucket == 0 { 0 } else { self.ends[bucket as usize - 1] };
            for &slot in &self.entries[usize::from(start)..usize::from(self.ends[bucket as usize])] {
                let other = &bodies[usize::from(slot)];
                let touching =
                    other.spans_column_of(body) && other.top() <= body.bottom() && other.bottom() >= body.top();
                if touching && cells.meeting_bucket(Cells::of(other, self.shift)) == bucket {
                    note(slot);
                }
            }
        }
    }
}
