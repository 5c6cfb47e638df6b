//! What a scene calls for, and where the switches come from.
//!
//! [`step`](crate::step()) asks a [`Switches`] what is on. A shipped game passes [`Only`], whose answers are constants: what
//! is off is neither run nor linked. A harness passes [`Effects`] itself and decides scene by scene.

use core::fmt;
use core::ops::BitOr;

/// A set of effects.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effects(u16);

impl Effects {
    /// Plain bodies that move and don't overlap.
    pub const NONE: Self = Self(0);
    /// A constant acceleration of all rigid bodies.
    pub const GRAVITY: Self = Self(1);
    /// Restitution.
    pub const BOUNCE: Self = Self(1 << 1);
    /// Coulomb friction.
    pub const FRICTION: Self = Self(1 << 2);
    /// Everything there is.
    pub const ALL: Self = Self(0b111);

    /// Name of each effect, in the order of their bits.
    const NAMES: [&'static str; 3] = ["gravity", "bounce", "friction"];

    /// The bits, for use as [`Only`]'s parameter.
    pub const fn bits(self) -> u16 {
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

    /// Whether all of the other set's effects are in this one.
    pub const fn contain(self, other: Self) -> bool {
        other.without(self).0 == 0
    }
}

impl BitOr for Effects {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        self.and(other)
    }
}

/// The names, joined by ` + `.
impl fmt::Display for Effects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut names = Self::NAMES.iter().enumerate().filter(|(bit, _)| self.0 >> bit & 1 == 1);
        let Some((_, first)) = names.next() else {
            return f.write_str("none");
        };
        f.write_str(first)?;
        names.try_for_each(|(_, name)| write!(f, " + {name}"))
    }
}

/// Says which effects are on.
pub trait Switches: Copy {
    /// Whether the effect is on.
    fn on(self, effect: Effects) -> bool;
}

/// Decided at run time.
impl Switches for Effects {
    #[inline]
    fn on(self, effect: Effects) -> bool {
        self.contain(effect)
    }
}

/// Decided when compiled: `Only::<{ Effects::GRAVITY.bits() }>`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Only<const BITS: u16>;

impl<const BITS: u16> Switches for Only<BITS> {
    #[inline]
    fn on(self, effect: Effects) -> bool {
        Effects(BITS).contain(effect)
    }
}
