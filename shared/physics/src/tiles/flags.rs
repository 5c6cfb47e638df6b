//! What a tile does, in one byte.

use core::ops::BitOr;

/// A set of properties of a tile.
///
/// A tile blocks in one of three ways, which exclude each other; the first that fits counts:
/// 1. [`SENSOR`](Self::SENSOR): it notices and never blocks, whatever else is set.
/// 2. [`ONE_WAY`](Self::ONE_WAY): it holds what lands on its top.
/// 3. [`SOLID`](Self::SOLID): it blocks from all sides.
///
/// A tile that does none of this but has [`DAMAGE`](Self::DAMAGE), [`COLLECTIBLE`](Self::COLLECTIBLE) or
/// [`TRIGGER`](Self::TRIGGER) is a sensor too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct TileFlags(u8);

impl TileFlags {
    /// No tile at all.
    pub const NONE: Self = Self(0);
    /// Blocks from all sides.
    pub const SOLID: Self = Self(1);
    /// Notices what overlaps it and blocks nothing.
    pub const SENSOR: Self = Self(1 << 1);
    /// Hurts; the game decides whom and how much.
    pub const DAMAGE: Self = Self(1 << 2);
    /// Can be consumed: a coin, a brick that breaks.
    pub const COLLECTIBLE: Self = Self(1 << 3);
    /// Holds what lands on it from above, at lesser y, and lets pass what comes from elsewhere. Where gravity pulls to another side
    /// than down, it holds nothing.
    pub const ONE_WAY: Self = Self(1 << 4);
    /// Starts something; the game decides what.
    pub const TRIGGER: Self = Self(1 << 5);

    const ALL: u8 = (1 << 6) - 1;
    const EFFECTS: u8 = Self::DAMAGE.0 | Self::COLLECTIBLE.0 | Self::TRIGGER.0;

    /// The set of those bits; none if one of them stands for nothing.
    pub const fn from_bits(bits: u8) -> Option<Self> {
        if bits & !Self::ALL == 0 { Some(Self(bits)) } else { None }
    }

    /// The flags among those bits.
    #[inline]
    pub(super) const fn masked(bits: u8) -> Self {
        Self(bits & Self::ALL)
    }

    /// The bits.
    #[inline]
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// The union of two sets.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether all of the other set is in this one.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Notices what overlaps it, and blocks nothing.
    pub const fn is_sensor(self) -> bool {
        let blocks = self.0 & (Self::SOLID.0 | Self::ONE_WAY.0) != 0;
        self.0 & Self::SENSOR.0 != 0 || (!blocks && self.0 & Self::EFFECTS != 0)
    }

    /// Holds what lands on its top, and blocks nothing else.
    #[inline]
    pub const fn is_one_way(self) -> bool {
        self.0 & (Self::SENSOR.0 | Self::ONE_WAY.0) == Self::ONE_WAY.0
    }

    /// Blocks from all sides.
    #[inline]
    pub const fn is_solid(self) -> bool {
        self.0 & (Self::SENSOR.0 | Self::ONE_WAY.0 | Self::SOLID.0) == Self::SOLID.0
    }

    /// Can be consumed.
    pub const fn is_collectible(self) -> bool {
        self.contains(Self::COLLECTIBLE)
    }
}

impl BitOr for TileFlags {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        self.and(other)
    }
}
