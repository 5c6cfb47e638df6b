//! The step and its stages.

use core::fmt;

use crate::config::Level;
use crate::effects::Switches;
use crate::pipeline::{broadphase, ccd, events, flat, grounded, integrate, narrowphase, position, sleep};
use crate::scalar::Scalar;
use crate::world::World;

/// Advances the world by 1/60 s.
///
/// `switches` says which effects are on: [`Only`](crate::effects::Only) for a game, [`Effects`](crate::effects::Effects) for a
/// harness; equal sets give equal bits.
pub fn step<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    for stage in Stage::ALL {
        stage.run(world, switches);
    }
}

/// The stages of a step, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Broadphase and narrowphase: which bodies touch.
    Detect,
    /// Gravity.
    IntegrateVelocity,
    /// Impulses: bounce and friction.
    SolveVelocity,
    /// Motion.
    IntegratePosition,
    /// Overlap is pushed apart.
    CorrectPenetration,
    /// What the step leaves for the game to read.
    Events,
}

impl Stage {
    /// All stages, in order.
    pub const ALL: [Self; 6] = [
        Self::Detect,
        Self::IntegrateVelocity,
        Self::SolveVelocity,
        Self::IntegratePosition,
        Self::CorrectPenetration,
        Self::Events,
    ];

    /// Runs this stage alone. A harness that looks between stages calls them all, in order; a game calls [`step`].
    #[inline]
    pub fn run<S: Scalar>(self, world: &mut World<'_, S>, switches: impl Switches) {
        match self {
            Self::Detect => {
                integrate::hold_kinematic(world, switches);
                sleep::update(world, switches);
                loop {
                    broadphase::update(world, switches);
                    narrowphase::refresh(world, switches);
                    if !sleep::wake_touched(world, switches) {
                        break;
                    }
                }
            }
            Self::IntegrateVelocity => integrate::velocities(world, switches),
            Self::SolveVelocity => match world.level(switches) {
                Level::Flat => flat::solve(world, switches),
                Level::Grounded | Level::Exact => grounded::solve(world, switches),
            },
            Self::IntegratePosition => ccd::advance(world, switches),
            Self::CorrectPenetration => position::correct(world, switches),
            Self::Events => events::publish(world, switches),
        }
    }

    /// Place in the order, from 0.
    pub const fn index(self) -> usize {
        self as usize
    }
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Detect => "detect",
            Self::IntegrateVelocity => "integrate_velocity",
            Self::SolveVelocity => "solve_velocity",
            Self::IntegratePosition => "integrate_position",
            Self::CorrectPenetration => "correct_penetration",
            Self::Events => "events",
        })
    }
}
