//! The solver's constants: unit, default, and what breaks when they change.

use crate::error::{Error, Field, check};
use crate::scalar::{Quantity, Scalar, px, ratio};
use crate::vec2::{Vec2, vec2};

/// How much work a step puts into accuracy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Level {
    /// Plain impulses, partial position correction: the cheapest.
    Flat,
    /// Accumulated impulses, kept from step to step, and one pass from the ground up: stacks stand, heavy rests on light.
    #[default]
    Grounded,
    /// A pass more, and the time of impact for whoever is fast.
    Exact,
}

/// Constants of a world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config<S: Scalar> {
    /// Accuracy level.
    pub level: Level,
    /// Acceleration, px/s2, each component within +-8000. Default (0, 200).
    pub gravity: Vec2<S::Real>,
    /// Passes over the contacts in a step, 1..=16. Default 3, at level Flat 2, at level Exact 4; more make heaps firmer and
    /// cost time while they move.
    pub velocity_iterations: u8,
    /// Part of the penetration beyond the slop that a step removes, 0..=1. Default 0.5, at level Flat 0.2; from 0.7 on, what was
    /// crushed comes out faster.
    pub bias: S::Real,
    /// Penetration that is left alone, px, 0..=8. Default 0.02; less makes resting bodies tremble.
    pub slop: S::Real,
    /// Approach speed below which nothing bounces, px/s, 0..=1000. Default 0.5, and never less than what gravity adds in two
    /// steps: a resting body would bounce for ever.
    pub velocity_threshold: S::Real,
    /// What is left of a velocity after each step, 0..=1, where damping is called for. Default 0.999.
    pub damping: S::Real,
    /// Largest speed, px/s, 1..=7620, where the cap is called for. Default 500.
    pub speed_cap: S::Real,
    /// A body is swept once a step moves it by more than this multiple of half its shorter side, 0..=16, where CCD is called for
    /// or the level is Exact. Default 1: beyond that, thin walls could be missed; contacts stop whoever is slower. With 0, what is
    /// squeezed in a deep heap is stopped again and again, and sinks in.
    pub ccd_threshold: S::Real,
    /// Speed along each axis, px/s, 0..=60, up to which a body that something presses on is at rest, where sleep is called for.
    /// Default 1/16; more freezes what slides slowly.
    pub sleep_speed: S::Real,
}

impl<S: Scalar> Default for Config<S> {
    fn default() -> Self {
        Self::at(Level::default())
    }
}

impl<S: Scalar> Config<S> {
    /// The constants of a level.
    pub fn at(level: Level) -> Self {
        Self {
            level,
            gravity: vec2(S::Real::ZERO, S::real(px(200))),
            velocity_iterations: match level {
                Level::Flat => 2,
                Level::Grounded => 3,
                Level::Exact => 4,
            },
            bias: S::real(if level == Level::Flat { ratio(1, 5) } else { ratio(1, 2) }),
            slop: S::real(ratio(1, 50)),
            velocity_threshold: S::real(ratio(1, 2)),
            damping: S::real(ratio(999, 1000)),
            speed_cap: S::real(px(500)),
            ccd_threshold: S::ONE,
            sleep_speed: S::real(ratio(1, 16)),
        }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the first field that is, its value and its range.
    pub fn validate(&self) -> Result<(), Error<S>> {
        check(Field::GravityX, self.gravity.x, -8000, 8000)?;
        check(Field::GravityY, self.gravity.y, -8000, 8000)?;
        let iterations = S::real(px(i16::from(self.velocity_iterations)));
        check(Field::VelocityIterations, iterations, 1, 16)?;
        check(Field::Bias, self.bias, 0, 1)?;
        check(Field::Slop, self.slop, 0, 8)?;
        check(Field::VelocityThreshold, self.velocity_threshold, 0, 1000)?;
        check(Field::Damping, self.damping, 0, 1)?;
        check(Field::SpeedCap, self.speed_cap, 1, 7620)?;
        check(Field::CcdThreshold, self.ccd_threshold, 0, 16)?;
        check(Field::SleepSpeed, self.sleep_speed, 0, 60)
    }
}
