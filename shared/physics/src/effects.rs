//! What a scene calls for, and where the switches come from.
//!
//! [`step`](crate::step()) asks a [`Switches`] what is on. A shipped game passes [`Only`], whose answers are constants: what
//! is off is neither run nor linked. A harness passes [`Effects`] itself and decides scene by scene.

use core::fmt;
use core::ops::BitOr;

use crate::config::Level;
use crate::variety::Variety;

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
        write_names(self.0, &Self::NAMES, "none", f)
    }
}

/// Writes the names of the bits that are set, joined by ` + `, or what an empty set is called.
pub(crate) fn write_names(bits: u16, names: &[&str], empty: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let mut names = names.iter().enumerate().filter(|(bit, _)| bits >> bit & 1 == 1);
    let Some((_, first)) = names.next() else {
        return f.write_str(empty);
    };
    f.write_str(first)?;
    names.try_for_each(|(_, name)| write!(f, " + {name}"))
}

/// Says which effects are on, and which levels of accuracy and bodies there are.
pub trait Switches: Copy {
    /// All effects that are on.
    fn effects(self) -> Effects;

    /// The level that every world has; none if each world's [`Config`](crate::Config) says.
    #[inline]
    fn level(self) -> Option<Level> {
        None
    }

    /// What bodies there may be. Worlds take all; this one compiles others out.
    #[inline]
    fn variety(self) -> Variety {
        Variety::ALL
    }

    /// Whether the effect is on.
    #[inline]
    fn on(self, effect: Effects) -> bool {
        self.effects().contain(effect)
    }

    /// Whether a world is only ever stepped with this set, so that nothing need be undone that another one did.
    #[inline]
    fn are_fixed(self) -> bool {
        false
    }
}

/// Decided at run time.
impl Switches for Effects {
    #[inline]
    fn effects(self) -> Effects {
        self
    }
}

/// Decided when compiled: `Only::<{ Effects::GRAVITY.bits() }>`. Code of other effects isn't linked; nor is that of other levels
/// if the second parameter names one, such as `{ Level::Grounded as u8 }`; nor what only other bodies need than the third one
/// says, such as `{ Variety::BOXES.bits() }`. [`World::declare`](crate::World::declare) makes sure that nothing is missed.
///
/// Bits that stand for no effect don't compile, and the compiler says so: "a bit of the set stands for no effect".
/// ```compile_fail,E0080
/// use flat_physics::{Effects, Only, Switches};
/// let effects = Only::<0x8000>.effects();
/// ```
/// Nor do levels or bodies that there aren't.
/// ```compile_fail,E0080
/// use flat_physics::{Effects, Only, Switches};
/// let level = Only::<0, 3>.level();
/// ```
/// ```compile_fail,E0080
/// use flat_physics::{Effects, Only, Switches};
/// let variety = Only::<0, 1, 0x80>.variety();
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Only<const BITS: u16, const LEVEL: u8 = { u8::MAX }, const VARIETY: u8 = { Variety::ALL.bits() }>;

impl<const BITS: u16, const LEVEL: u8, const VARIETY: u8> Only<BITS, LEVEL, VARIETY> {
    const EFFECTS: Effects = match Effects::from_bits(BITS) {
        Some(effects) => effects,
        None => panic!("a bit of the set stands for no effect"),
    };
    const LEVEL: Option<Level> = match LEVEL {
        0 => Some(Level::Flat),
        1 => Some(Level::Grounded),
        2 => Some(Level::Exact),
        u8::MAX => None,
        _ => panic!("the number stands for no level"),
    };
    const VARIETY: Variety = match Variety::from_bits(VARIETY) {
        Some(variety) => variety,
        None => panic!("a bit of the variety stands for nothing"),
    };
}

impl<const BITS: u16, const LEVEL: u8, const VARIETY: u8> Switches for Only<BITS, LEVEL, VARIETY> {
    #[inline]
    fn effects(self) -> Effects {
        Self::EFFECTS
    }
    #[inline]
    fn level(self) -> Option<Level> {
        Self::LEVEL
    }
    #[inline]
    fn variety(self) -> Variety {
        Self::VARIETY
    }
    #[inline]
    fn are_fixed(self) -> bool {
        true
    }
}
