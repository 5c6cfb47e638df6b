//! Motion: velocities from gravity, positions from velocities (semi-implicit Euler).

use crate::effects::{Effects, Switches};
use crate::scalar::{Quantity, Scalar};
use crate::world::World;

/// Adds a step's gravity to every rigid body.
pub(crate) fn velocities<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    if !switches.on(Effects::GRAVITY) {
        return;
    }
    let gravity = world.gravity;
    for &slot in world.layers.dynamics() {
        let body = &mut world.bodies[usize::from(slot)];
        let scale = world.profiles[usize::from(slot)].gravity_scale;
        let pull = if scale == S::ONE { gravity } else { gravity.map(|g| S::speed_scaled(g, scale)) };
        body.velocity = body.velocity.saturating_add(pull);
    }
}

/// Moves every rigid body by its velocity, which is first held within the speed limit.
pub(crate) fn positions<S: Scalar>(world: &mut World<'_, S>) {
    for &slot in world.layers.dynamics() {
        let body = &mut world.bodies[usize::from(slot)];
        let velocity = body.velocity.map(|v| v.held(S::FASTEST));
        if velocity != body.velocity {
            body.velocity = velocity;
            world.saturations = world.saturations.saturating_add(1);
        }
        body.position.x = S::advance(body.position.x, &mut body.remainder.x, velocity.x);
        body.position.y = S::advance(body.position.y, &mut body.remainder.y, velocity.y);
    }
}
