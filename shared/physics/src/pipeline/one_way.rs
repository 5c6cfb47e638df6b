//! Platforms that hold only what comes from above.
//!
//! A body lands when its contact shows it above the surface, within a graze, and not moving away from the ground. Once landed, it
//! is held until it leaves: however deep a heavy load has pressed it in, and wherever the platform moves. What hasn't landed
//! passes: from below, from the sides, and what lay inside from the start.
//!
//! Above is against gravity, as the [`Ground`] has it.

use super::narrowphase::{GRAZE, Manifold};
use crate::body::Body;
use crate::contact::{Axis, Flags};
use crate::pipeline::order::Ground;
use crate::scalar::{Quantity, Scalar};
use crate::vec2::Vec2;

/// How a body lies on a platform, if the platform holds it. `flags` remember from step to step whether it has landed.
pub(crate) fn hold<S: Scalar>(
    flags: &mut Flags,
    manifold: Option<Manifold<S>>,
    a: &Body<S>,
    platform: &Body<S>,
    ground: Ground,
) -> Option<Manifold<S>> {
    let Some(manifold) = manifold else {
        flags.clear(Flags::LANDED.or(Flags::DROPPED)); // it is gone
        return None;
    };
    let held = if flags.has(Flags::LANDED) {
        on_top(manifold, a, platform, ground)
    } else {
        let sinks = ground.depth(a.velocity) >= ground.depth(platform.velocity);
        let lands = sinks
            && !flags.has(Flags::DROPPED)
            && comes_from_above::<S>(manifold.normal, above(a, platform, ground), ground);
        lands.then_some(manifold)
    };
    flags.clear(Flags::LANDED);
    if held.is_some() {
        flags.set(Flags::LANDED);
    }
    held
}

/// Whether a body that is so far above a surface is over it, and not beside or below it.
pub(crate) fn comes_from_above<S: Scalar>(normal: Vec2<S::Unit>, above: S::Real, ground: Ground) -> bool {
    faces_up::<S>(normal, ground) && above >= -S::real(GRAZE)
}

/// How far a body's lower edge is above a platform's surface.
#[inline(never)]
pub(crate) fn above<S: Scalar>(a: &Body<S>, platform: &Body<S>, ground: Ground) -> S::Real {
    let halves = ground.depth(a.half).abs() + ground.depth(platform.half).abs();
    ground.depth(platform.position - a.position) - halves
}

/// Whether a surface, by its normal towards it, is a platform's top and not its side.
fn faces_up<S: Scalar>(normal: Vec2<S::Unit>, ground: Ground) -> bool {
    ground.depth(normal) >= S::unit_ratio(1, 10)
}

/// A body that has landed is pushed up, also where another way out would be shorter; over the edge, a circle rolls off.
fn on_top<S: Scalar>(manifold: Manifold<S>, a: &Body<S>, platform: &Body<S>, ground: Ground) -> Option<Manifold<S>> {
    let offset = platform.position - a.position;
    let (beyond, half) = (ground.across(offset).abs(), ground.across(platform.half).abs());
    if a.status.is_circle() && beyond > half {
        return faces_up::<S>(manifold.normal, ground).then_some(manifold);
    }
    let overlaps = a.status.is_circle() || beyond < half + ground.across(a.half).abs();
    overlaps.then(|| Manifold::along(ground.axis(), above(a, platform, ground)))
}

impl Ground {
    /// The axis towards the ground.
    pub(crate) fn axis(self) -> Axis {
        match (self.is_horizontal(), self.is_reversed()) {
            (false, false) => Axis::Down,
            (false, true) => Axis::Up,
            (true, false) => Axis::Right,
            (true, true) => Axis::Left,
        }
    }
}
