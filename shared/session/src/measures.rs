//! Sums over all bodies, in whole numbers: what a check of energy or momentum needs, for little.

use flat_physics::{Kind, Scalar, World};
use flat_wire::message::Measures;

/// Energy, momentum and overlap of a world now.
///
/// With speeds and masses in 1/65 536, kinetic energy is `m v^2 / 2` in 2^-49 and potential energy `-m g.p` in 2^-48.
pub(crate) fn of<S: Scalar>(world: &World<'_, S>) -> Measures {
    let whole = |value: S::Real| i128::from(S::in_65536ths(value));
    let gravity = world.config().gravity.map(whole);
    let (mut kinetic, mut potential, mut momentum, mut fastest) = (0i128, 0i128, [0i128; 2], 0);
    for body in world.bodies().filter(|body| body.kind == Kind::Rigid && body.enabled) {
        let Ok(definition) = world.definition(body.handle) else {
            continue; // it was just listed
        };
        let (mass, scale) = (whole(definition.mass), whole(definition.gravity_scale));
        let velocity = body.velocity.map(|v| whole(S::px_per_second(v)));
        let position = body.position.map(whole);
        kinetic += mass * (velocity.x * velocity.x + velocity.y * velocity.y);
        potential -= mass * (((gravity.x * position.x + gravity.y * position.y) * scale) >> 16);
        momentum = [momentum[0] + mass * velocity.x, momentum[1] + mass * velocity.y];
        fastest = fastest.max(velocity.x.abs()).max(velocity.y.abs());
    }
    let penetration = world.contacts().map(|contact| whole(contact.penetration)).max().unwrap_or(0);
    Measures {
        step: world.statistics().steps,
        kinetic: held(kinetic >> 33),
        potential: held(potential >> 32),
        momentum: momentum.map(|sum| held(sum >> 16)),
        penetration: held(penetration),
        fastest: held(fastest),
    }
}

/// Held at the ends of the wire's format.
fn held(value: i128) -> i64 {
    value.clamp(i64::MIN.into(), i64::MAX.into()) as i64
}
