//! What a step leaves for the game to read: its contacts, and the bodies that left the world.

use crate::scalar::{POSITION_LIMIT, Quantity, Scalar, px};
use crate::world::World;

/// Notes high-water marks, and disables bodies whose centre is beyond [`POSITION_LIMIT`].
pub(crate) fn publish<S: Scalar>(world: &mut World<'_, S>) {
    world.pool.note_peak();
    let limit = S::real(px(POSITION_LIMIT));
    let mut escaped = 0;
    for &slot in world.layers.dynamics() {
        let body = &mut world.bodies[usize::from(slot)];
        if body.position.x.abs() > limit || body.position.y.abs() > limit {
            body.position = body.position.map(|p| p.held(limit));
            body.status.disable();
            escaped += 1;
        }
    }
    if escaped > 0 {
        world.escaped = world.escaped.saturating_add(escaped);
        world.layers.dynamics_changed();
    }
    world.steps = world.steps.wrapping_add(1);
}
