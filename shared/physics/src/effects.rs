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
    /// A factor on every velocity, each step.
    pub const DAMPING: Self = Self(1 << 3);
    /// A limit to every speed, below what the number format holds.
    pub const SPEED_CAP: Self = Self(1 << 4);
    /// Continuous collision detection: nothing passes through anything, however fast.
    pub const CCD: Self = Self(1 << 5);
    /// Bodies that notice others and don't block them.
    pub const SENSORS: Self = Self(1 << 6);
    /// Platforms that hold what lands on them from above and let pass what comes from elsewhere.
    pub const ONE_WAY: Self = Self(1 << 7);
    /// Bodies that the game moves.
    pub const KINEMATIC: Self = Self(1 << 8);
    /// A tile map that collides.
    pub const TILES: Self = Self(1 << 9);
    /// Bodies at rest cost nothing until something wakes them.
    pub const SLEEP: Self = Self(1 << 10);
    /// Begin, stay and end of every contact, for the game to read.
    pub const EVENTS: Self = Self(1 << 11);
    /// Everything there is.
    pub const ALL: Self = Self((1 << Self::NAMES.len()) - 1);

    /// Name of each effect, in the order of their bits.
    const NAMES: [&'static str; 12] = [
        "gravity",
        "bounce",
        "friction",
        "damping",
        "speed cap",
        "ccd",
        "sensors",
        "one-way",
        "kinematic",
        "tiles",
        "sleep",
        "events",
    ];

    /// The set of those bits; none if one of them stands for nothing.
    pub const fn from_bits(bits: u16) -> Option<Self> {
        if bits & !Self::ALL.0 == 0 { Some(Self(bits)) } else { None }
    }

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

    /// Whether a world is only ever stepped with this set, so that nothing need be undone that another one did.
    fn are_fixed(self) -> bool {
        false
    }
}

/// Decided at run time.
impl Switches for Effects {
    #[inline]
    fn on(self, effect: Effects) -> bool {
        self.contain(effect)
    }
}

/// Decided when compiled: `Only::<{ Effects::GRAVITY.bits() }>`.
///
/// Bits that stand for no effect don't compile:
/// ```compile_fail
/// use flat_physics::{Effects, Only};
/// let effects = Effects::from(Only::<0x8000>);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Only<const BITS: u16>;

impl<const BITS: u16> Only<BITS> {
    const EFFECTS: Effects = match Effects::from_bits(BITS) {
        Some(effects) => effects,
        None => panic!("a bit of the set stands for no effect"),
    };
}

impl<const BITS: u16> From<Only<BITS>> for Effects {
    fn from(_: Only<BITS>) -> Self {
        Only::<BITS>::EFFECTS
    }
}

impl<const BITS: u16> Switches for Only<BITS> {
    #[inline]
    fn on(self, effect: Effects) -> bool {
        Self::EFFECTS.contain(effect)
    }
    #[inline]
    fn are_fixed(self) -> bool {
        true
    }
}
