//! Which bodies there may be.
//!
//! Every world takes all of them. A game that has boxes of equal mass alone, say, compiles without what circles and masses need:
//! see [`Only`](crate::effects::Only).

use core::fmt;

use crate::effects::write_names;

/// What bodies may be besides boxes of mass 1 that feel the world's gravity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variety(u8);

impl Variety {
    /// Nothing: boxes of mass 1 that feel the world's gravity.
    pub const BOXES: Self = Self(0);
    /// Round. Compiled without, circles collide as the squares around them.
    pub const CIRCLES: Self = Self(1);
    /// Of other masses than 1. Compiled without, bodies that collide weigh the same.
    pub const MASSES: Self = Self(1 << 1);
    /// With a [gravity scale](crate::BodyDef::gravity_scale) other than 1. Compiled without, all fall alike.
    pub const GRAVITY_SCALES: Self = Self(1 << 2);
    /// Anything.
    pub const ALL: Self = Self((1 << Self::NAMES.len()) - 1);

    /// Name of each kind, in the order of the bits.
    const NAMES: [&'static str; 3] = ["circles", "masses", "gravity scales"];

    /// The set of those bits; none if one of them stands for nothing.
    pub const fn from_bits(bits: u8) -> Option<Self> {
        if bits & !Self::ALL.0 == 0 { Some(Self(bits)) } else { None }
    }

    /// The bits, for use as [`Only`](crate::effects::Only)'s parameter.
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// The union of two sets.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What is in this set and not in the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether all of the other set is in this one.
    #[inline]
    pub const fn contain(self, other: Self) -> bool {
        other.without(self).0 == 0
    }
}

/// The names, joined by ` + `.
impl fmt::Display for Variety {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_names(self.0.into(), &Self::NAMES, "boxes", f)
    }
}
