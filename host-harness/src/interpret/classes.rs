//! Classes of instructions, and what each costs on an ESP32-C3.

use serde::Serialize;

/// What an instruction keeps a simple pipeline busy with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Class {
    /// Sums, shifts, comparisons, and everything else of one cycle.
    Plain,
    /// The low word of a product.
    Multiply,
    /// The high word of a product.
    MultiplyHigh,
    /// Quotient or remainder.
    Divide,
    /// From memory.
    Load,
    /// To memory.
    Store,
    /// A branch that falls through.
    NotTaken,
    /// A branch that is taken.
    Taken,
    /// An unconditional jump, a call or a return.
    Jump,
}

impl Class {
    /// All, in the order of [`Tally`].
    pub const ALL: [Self; 9] = [
        Self::Plain,
        Self::Multiply,
        Self::MultiplyHigh,
        Self::Divide,
        Self::Load,
        Self::Store,
        Self::NotTaken,
        Self::Taken,
        Self::Jump,
    ];

    /// Cycles that the estimate charges, with code and data in internal RAM: upper figures of measurements on the chip, where
    /// they depend on operands or neighbours. A load whose value is used at once takes 2, otherwise 1; a division 3 to 35.
    pub const fn cycles(self) -> u64 {
        match self {
            Self::Plain | Self::Multiply | Self::Store | Self::NotTaken => 1,
            Self::Load | Self::Jump => 2,
            Self::Taken => 3,
            Self::MultiplyHigh => 5,
            Self::Divide => 35,
        }
    }

    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Multiply => "mul",
            Self::MultiplyHigh => "mulh",
            Self::Divide => "div, rem",
            Self::Load => "load",
            Self::Store => "store",
            Self::NotTaken => "branch not taken",
            Self::Taken => "branch taken",
            Self::Jump => "jump",
        }
    }
}

/// How many instructions of each class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally([u64; Class::ALL.len()]);

impl Tally {
    /// One more.
    #[inline]
    pub fn add(&mut self, class: Class) {
        self.0[class as usize] += 1;
    }

    /// Of one class.
    pub fn of(&self, class: Class) -> u64 {
        self.0[class as usize]
    }

    /// Of all classes: retired instructions.
    pub fn instructions(&self) -> u64 {
        self.0.iter().sum()
    }

    /// The estimate.
    pub fn cycles(&self) -> u64 {
        Class::ALL.iter().map(|class| self.of(*class) * class.cycles()).sum()
    }

    /// What this one has more than an earlier one.
    #[must_use]
    pub fn since(&self, earlier: &Self) -> Self {
        Self(std::array::from_fn(|class| self.0[class] - earlier.0[class]))
    }

    /// The sum of both.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|class| self.0[class] + other.0[class]))
    }
}
