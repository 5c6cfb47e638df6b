//! What a scene promises.

use fixed::types::I16F16;
use flat_physics::Vec2;

/// Something that must hold when the scene runs; lengths in px, speeds in px/s.
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
        /// Speed.
        at_most: I16F16,
    },
    /// The centre of a body (by its number in the scene) has its n-th highest point after a bounce at this height.
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
}
