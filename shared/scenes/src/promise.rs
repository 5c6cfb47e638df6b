//! What a scene promises.

use fixed::types::I16F16;
use flat_physics::Vec2;

/// A bar that is known to be missed, and by how much at most: shown wherever the scene runs, and an error once it gets worse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shortfall {
    /// The check, by the beginning of its title.
    pub check: &'static str,
    /// The worst figure that is known, in the check's unit.
    pub figure: I16F16,
}

/// Something that must hold when the scene runs, at every level.
///
/// Lengths in px, speeds in px/s; coordinates are the scene's own, with y down. Bodies go by their number in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Promise {
    /// No rigid body reaches out of this rectangle by more than `tolerance`, at any step.
    Within {
        /// Upper left corner.
        min: Vec2<I16F16>,
        /// Lower right corner.
        max: Vec2<I16F16>,
        /// How far is still within.
        tolerance: I16F16,
    },
    /// From this step on, no two bodies overlap deeper than this.
    Penetration {
        /// First step.
        from: u32,
        /// Depth.
        at_most: I16F16,
    },
    /// From this step on, no body is faster than this.
    Rest {
        /// First step.
        from: u32,
        /// Only this one; none = every rigid body.
        body: Option<u16>,
        /// Speed.
        at_most: I16F16,
    },
    /// From this step on, no bit of any rigid body changes.
    Still {
        /// First step that must be like the one before.
        from: u32,
    },
    /// No body moves up faster than this, at any step.
    Down {
        /// Speed.
        at_most: I16F16,
    },
    /// The centre of a body has its n-th highest point after a bounce at this height.
    Apex {
        /// The body's number.
        body: u16,
        /// Counted from 1.
        bounce: u16,
        /// The centre's y there.
        y: I16F16,
        /// How far off is still right.
        tolerance: I16F16,
    },
    /// From this step on, the sum of kinetic and potential energy is this part of what it was at the start.
    Energy {
        /// First step.
        from: u32,
        /// Only this one's; none = that of all rigid bodies.
        body: Option<u16>,
        /// Least part.
        at_least: I16F16,
        /// Largest part.
        at_most: I16F16,
    },
    /// The momentum of all bodies changes by no more than one unit of the number format's resolution for each contact
    /// that the solver has taken.
    Momentum,
    /// The centre of mass of all rigid bodies keeps its horizontal speed.
    CentreOfMass {
        /// By how much it may change.
        at_most: I16F16,
    },
    /// Every rigid body follows `p + v t + g t^2 / 2`, at every step. Not for binary32, which rounds far positions too much.
    Parabola {
        /// How far off is still right.
        at_most: I16F16,
    },
    /// At the end of the run every rigid body has gone the way that its first velocity says. Not for binary32, which has too
    /// few bits for long ways in short steps.
    Travel {
        /// How far off is still right, as a part of the way.
        tolerance: I16F16,
    },
    /// Two bodies that start with opposite velocities have moved by opposite amounts, to the bit, at every step. For
    /// fixed point only: floats round by where they are.
    Opposite {
        /// The two.
        bodies: [u16; 2],
    },
    /// Every rigid body falls as `v <- (v + g / 60) damping`, at every step.
    Terminal {
        /// The factor.
        damping: I16F16,
        /// How far off is still right, as a part of the speed.
        tolerance: I16F16,
    },
    /// A body comes to rest this far from where it started.
    StopDistance {
        /// The body's number.
        body: u16,
        /// The distance.
        distance: I16F16,
        /// How far off is still right, as a part of the distance.
        tolerance: I16F16,
    },
    /// One body moves no further along another than this.
    Slip {
        /// The two.
        bodies: [u16; 2],
        /// Distance.
        at_most: I16F16,
    },
    /// Every rigid body keeps its velocity, and its place across it, to the last bit, at every step.
    Steady,
    /// By pairs from number 0 on, the first body never gets past the second: its x stays less.
    Sides,
    /// From this step on, a body carries so much: the normal impulses on it sum up to mass times gravity times 1/60 s.
    Load {
        /// The body's number.
        body: u16,
        /// First step.
        from: u32,
        /// The masses above it.
        mass: I16F16,
        /// How far off is still right, as a part of the load.
        tolerance: I16F16,
    },
    /// After a step, a body's centre is where it should be.
    Place {
        /// The body's number.
        body: u16,
        /// The step.
        step: u32,
        /// Where the centre should be.
        at: Vec2<I16F16>,
        /// How far off is still right, along each axis.
        tolerance: I16F16,
    },
    /// A body never reaches into a solid tile deeper than this. Not for tiles that come and go.
    OutOfTiles {
        /// The body's number.
        body: u16,
        /// Depth.
        at_most: I16F16,
    },
    /// A body's centre stays inside this rectangle, at every step.
    Stays {
        /// The body's number.
        body: u16,
        /// Upper left corner.
        min: Vec2<I16F16>,
        /// Lower right corner.
        max: Vec2<I16F16>,
        /// How far outside is still inside.
        tolerance: I16F16,
    },
}
