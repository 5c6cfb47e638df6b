//! From counts to cycles, and from cycles to what a chip has time for.

use std::fmt;

use flat_wire::message::Counter;
use serde::Serialize;

use crate::interpret::{Class, Tally};

/// Steps a second.
const STEPS_PER_S: f64 = 60.0;

/// A processor's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Clock {
    /// MHz.
    pub mhz: u32,
}

impl Clock {
    /// The ESP32-C3's, and the ESP32's.
    pub const USUAL: [Self; 2] = [Self { mhz: 160 }, Self { mhz: 240 }];

    /// Cycles between two steps.
    pub fn budget(self) -> f64 {
        f64::from(self.mhz) * 1e6 / STEPS_PER_S
    }
}

impl fmt::Display for Clock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} MHz", self.mhz)
    }
}

/// How counts become cycles.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cycles {
    /// Cycles of a count.
    pub per_count: f64,
    /// Whether they are an estimate.
    pub estimated: bool,
    /// Where the figure comes from.
    pub basis: String,
    /// What it is made of, if it is an estimate from classes.
    pub mix: Vec<Share>,
}

/// A class of instructions in the estimate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Share {
    /// The class.
    pub class: &'static str,
    /// Its part of all instructions.
    pub part: f64,
    /// Cycles that each is charged.
    pub cycles: u64,
}

impl Cycles {
    /// What is known of a target by its unit, and by whether it may be a chip: an emulation's cycles are an estimate.
    pub fn of(unit: Counter, is_board: bool) -> Self {
        match unit {
            Counter::Cycles if is_board => Self {
                per_count: 1.0,
                estimated: false,
                basis: "counted by the chip, without what reading its counter takes".into(),
                mix: Vec::new(),
            },
            Counter::Cycles => Self {
                per_count: 1.0,
                estimated: true,
                basis: "an estimate: counted in an emulation of the chip, which charges each instruction what it takes for right"
                    .into(),
                mix: Vec::new(),
            },
            _ => Self {
                per_count: 1.4,
                estimated: true,
                basis: "an estimate: 1.4 cycles an instruction, code and data in internal RAM".into(),
                mix: Vec::new(),
            },
        }
    }

    /// An estimate from the classes of the instructions that an interpreter executed; `what` says in which run.
    pub fn from_classes(tally: &Tally, what: &str) -> Self {
        let instructions = tally.instructions().max(1) as f64;
        let per_count = tally.cycles() as f64 / instructions;
        let share = |class: &Class| Share {
            class: class.name(),
            part: tally.of(*class) as f64 / instructions,
            cycles: class.cycles(),
        };
        Self {
            per_count,
            estimated: true,
            basis: format!(
                "an estimate: {per_count:.2} cycles an instruction, by classes of what an interpreter executed in {what}; code \
                 and data in internal RAM"
            ),
            mix: Class::ALL.iter().map(share).collect(),
        }
    }

    /// Part of the clock's budget that so many counts take; 1 is all of it.
    pub fn load(&self, counts: f64, clock: Clock) -> f64 {
        counts * self.per_count / clock.budget()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_of_160_mhz_has_two_and_two_thirds_million_cycles_a_step() {
        let clock = Clock { mhz: 160 };
        assert!((clock.budget() - 2_666_666.7).abs() < 0.1);
        assert!((Cycles::of(Counter::Cycles, true).load(1_333_333.0, clock) - 0.5).abs() < 1e-6);
    }

    #[test]
    fn only_a_chip_counts_its_cycles() {
        assert!(!Cycles::of(Counter::Cycles, true).estimated);
        assert!(Cycles::of(Counter::Cycles, false).estimated);
        assert!(Cycles::of(Counter::Instructions, true).estimated);
    }
}
