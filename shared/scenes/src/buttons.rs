//! What a player holds down, and for how long.

use core::fmt;

/// Buttons that are held down, a bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Buttons(u8);

impl Buttons {
    /// None.
    pub const IDLE: Self = Self(0);
    /// Run to the left.
    pub const LEFT: Self = Self(1);
    /// Run to the right.
    pub const RIGHT: Self = Self(1 << 1);
    /// Jump, from a floor.
    pub const JUMP: Self = Self(1 << 2);
    /// Drop through what blocks from above only.
    pub const DOWN: Self = Self(1 << 3);

    /// Every button and its name, from the lowest bit.
    pub const NAMES: [(Self, &'static str); 4] =
        [(Self::LEFT, "left"), (Self::RIGHT, "right"), (Self::JUMP, "jump"), (Self::DOWN, "down")];

    /// The buttons of these bits; none if there is a bit without a button.
    pub const fn from_bits(bits: u8) -> Option<Self> {
        let all = Self::LEFT.0 | Self::RIGHT.0 | Self::JUMP.0 | Self::DOWN.0;
        if bits & !all == 0 { Some(Self(bits)) } else { None }
    }

    /// A bit each.
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// These and those.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether all of those are held.
    pub const fn hold(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

/// Names with a plus between them; `idle` for none.
impl fmt::Display for Buttons {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut held = Self::NAMES.iter().filter(|(button, _)| self.hold(*button)).map(|(_, name)| name);
        f.write_str(held.next().unwrap_or(&"idle"))?;
        held.try_for_each(|name| write!(f, "+{name}"))
    }
}

/// Buttons, held for a while.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hold {
    /// Which.
    pub buttons: Buttons,
    /// For how many steps.
    pub steps: u32,
}

impl Hold {
    /// What is held at a step, counted from 1, if these follow one another; nothing after the last.
    pub fn at(holds: &[Self], step: u32) -> Buttons {
        let mut end = 0;
        let current = holds.iter().find(|hold| {
            end += hold.steps;
            step <= end
        });
        current.map_or(Buttons::IDLE, |hold| hold.buttons)
    }
}

/// As the harness takes it: `jump+right:20`.
impl fmt::Display for Hold {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.buttons, self.steps)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use std::string::ToString;

    #[test]
    fn holds_follow_one_another_and_end_in_nothing() {
        let hold = |buttons, steps| Hold { buttons, steps };
        let holds = [hold(Buttons::LEFT, 2), hold(Buttons::IDLE, 1), hold(Buttons::JUMP, 1)];
        let held = [1, 2, 3, 4, 5].map(|step| Hold::at(&holds, step));
        assert_eq!(held, [Buttons::LEFT, Buttons::LEFT, Buttons::IDLE, Buttons::JUMP, Buttons::IDLE]);
    }

    #[test]
    fn buttons_go_by_their_names_and_unknown_bits_are_none() {
        assert_eq!(Hold { buttons: Buttons::JUMP.and(Buttons::LEFT), steps: 3 }.to_string(), "left+jump:3");
        assert_eq!(Buttons::IDLE.to_string(), "idle");
        assert_eq!(Buttons::from_bits(5), Some(Buttons::LEFT.and(Buttons::JUMP)));
        assert_eq!(Buttons::from_bits(1 << 4), None);
    }
}
