//! The columns or the rows of a map: which of them cover a coordinate or an interval.

use core::ops::Range;

use crate::scalar::{Quantity, Scalar, px};

/// Columns or rows: where they start, how wide they are, how many there are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Axis {
    origin: i16,
    size: u8,
    count: u32,
    /// px from the start to the end.
    extent: i32,
    /// Where what has more of it on both sides begins and how far it extends, px.
    inside: i32,
    inside_extent: u32,
    /// `2^24 / size`, rounded up: see [`Axis::divided`].
    reciprocal: u32,
}

impl Axis {
    pub(super) fn new(origin: i16, size: u8, count: u16) -> Self {
        let reciprocal = (1_u32 << 24).div_ceil(u32::from(size));
        let (inside, inside_count) = (i32::from(origin) + i32::from(size), u32::from(count.saturating_sub(2)));
        let extent = i32::from(size) * i32::from(count);
        let inside_extent = inside_count * u32::from(size);
        Self { origin, size, count: count.into(), extent, inside, inside_extent, reciprocal }
    }

    pub(super) fn origin(&self) -> i16 {
        self.origin
    }

    pub(super) fn size(&self) -> u8 {
        self.size
    }

    #[inline]
    pub(super) fn count(&self) -> u32 {
        self.count
    }

    /// Width of a column or height of a row, px.
    #[inline]
    pub(super) fn pitch<S: Scalar>(&self) -> S::Real {
        S::real(px(self.size.into()))
    }

    /// `distance / size` without a division. The reciprocal is less than `size / 2^24` of itself too large; that adds less
    /// than `1 / size` to a quotient of distances up to 2^16 (Granlund and Montgomery, 1994).
    #[inline]
    fn divided(&self, distance: i32) -> u32 {
        ((u64::from((distance as u32) << 8) * u64::from(self.reciprocal)) >> 32) as u32
    }

    /// What covers a coordinate in whole px; `u32::MAX` if nothing does.
    #[inline]
    pub(super) fn index(&self, whole_px: i32) -> u32 {
        let distance = whole_px.saturating_sub(self.origin.into());
        if (0..self.extent).contains(&distance) { self.divided(distance) } else { u32::MAX }
    }

    /// What covers a coordinate in whole px, if there is more of it on both sides.
    #[inline]
    pub(super) fn inner(&self, whole_px: i32) -> Option<u32> {
        let distance = whole_px.wrapping_sub(self.inside);
        ((distance as u32) < self.inside_extent).then(|| self.divided(distance) + 1)
    }

    /// What an interval overlaps or touches.
    #[inline(never)]
    pub(super) fn span<S: Scalar>(&self, low: S::Real, high: S::Real) -> Range<u32> {
        // The last px that begins below `low`, so that touching counts on both sides alike.
        let first = S::floor(S::Real::ZERO.saturating_sub(low)).saturating_neg().saturating_sub(1);
        self.between([first, S::floor(high)])
    }

    /// What covers the first and the last of some whole px, if something does.
    #[inline]
    pub(super) fn both(&self, ends: [i32; 2]) -> Option<[u32; 2]> {
        let [first, last] = ends.map(|whole_px| whole_px.saturating_sub(self.origin.into()));
        let is_inside = |distance: i32| (distance as u32) < self.extent as u32;
        (is_inside(first) && is_inside(last)).then(|| [first, last].map(|distance| self.divided(distance)))
    }

    /// What covers any of some whole px, of which the ends are given.
    #[inline]
    pub(super) fn between(&self, ends: [i32; 2]) -> Range<u32> {
        let [first, last] = ends.map(|whole_px| whole_px.saturating_sub(self.origin.into()));
        let extent = self.extent;
        if last < 0 || first >= extent {
            return 0..0;
        }
        let start = if first <= 0 { 0 } else { self.divided(first) };
        let end = if last >= extent { self.count } else { self.divided(last) + 1 };
        start..end
    }

    /// Coordinate of the lesser edge of a column or row, px.
    #[inline]
    pub(super) fn edge<S: Scalar>(&self, index: u32) -> S::Real {
        // Within the coordinate range: that was checked when the map was placed.
        S::real(px((i32::from(self.origin) + i32::from(self.size) * index as i32) as i16))
    }
}
