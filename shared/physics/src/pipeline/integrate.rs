//! Motion: velocities from gravity, damping and the speed cap; positions from velocities.
//!
//! A body that nothing holds moves by the mean of its velocities before and after the step, along each axis: what accelerates it
//! evenly, gravity in flight or friction on a floor, then carries it as far as the closed form says, `v t + a t^2 / 2`. Along an
//! axis on which a contact pushes, the velocity after the step counts: it is the one that the contact allows.

use crate::body::{Body, Marks};
use crate::config::Level;
use crate::effects::{Effects, Switches};
use crate::pipeline::bounce;
use crate::scalar::{Quantity, Scalar};
use crate::variety::Variety;
use crate::vec2::Vec2;
use crate::world::World;

/// How far a body creeps before its contacts are looked at again, as [`Scalar::creep`] counts. With more
/// than 2^-13 px, pyramids never come to rest.
const CREEP: u16 = 2;

/// What gravity adds to a velocity in a step, where it is on.
pub(crate) fn gravity<S: Scalar>(world: &World<'_, S>, switches: impl Switches) -> Vec2<S::Speed> {
    if switches.on(Effects::GRAVITY) { world.gravity } else { Vec2::default() }
}

/// Lets contacts bounce, then accelerates every rigid body.
pub(crate) fn velocities<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let gravity = gravity(world, switches);
    let bounced = switches.on(Effects::BOUNCE)
        && world.level(switches) != Level::Flat
        && bounce::bounce(world, gravity, switches);
    world.bounced = bounced;
    let (damping, cap) = (world.config.damping, world.speed_cap);
    let below_cap = S::half_speed(cap); // along both axes: most need no root
    let scaled = switches.variety().contain(Variety::GRAVITY_SCALES) && world.variety.contain(Variety::GRAVITY_SCALES);
    // Where nobody was near the cap when the step began, only forces and bounces may bring somebody there.
    let pull = gravity.x.abs().saturating_add(gravity.y.abs());
    let near_cap = bounced || scaled || world.fastest.saturating_add(pull) > below_cap;
    let sideways = gravity.x != S::Speed::ZERO; // most gravity pulls along one axis
    let World { bodies, before, profiles, layers, .. } = world;
    for &slot in layers.dynamics() {
        let slot = usize::from(slot);
        let body = &mut bodies[slot];
        let before = &mut before[slot];
        let (mut velocity, marks) = (body.velocity, body.marks);
        let mut may_exceed = near_cap;
        if marks.has(Marks::FORCED) {
            may_exceed = true;
            // What the game's forces add lies where the velocity goes now.
            velocity = velocity.saturating_add(*before);
        }
        *before = body.velocity;
        let passing = Marks::HELD_X.or(Marks::HELD_Y).or(Marks::GROUNDED).or(Marks::FORCED).or(Marks::FAST);
        let stood = if marks.has(Marks::GROUNDED) { Marks::STOOD } else { Marks::default() };
        body.marks = marks.without(passing).or(stood);
        body.push = 0;
        if !body.status.is_rigid() {
            continue;
        }
        if scaled && profiles[slot].gravity_scale != S::ONE {
            velocity = velocity.saturating_add(weighted::<S>(gravity, profiles[slot].gravity_scale));
        } else if sideways {
            velocity = velocity.saturating_add(gravity);
        } else {
            velocity.y = velocity.y.saturating_add(gravity.y);
        }
        if switches.on(Effects::DAMPING) {
            velocity = velocity.map(|v| S::speed_scaled(v, damping));
        }
        let is_slow = |v: Vec2<S::Speed>| v.x.is_within(below_cap) && v.y.is_within(below_cap);
        if switches.on(Effects::SPEED_CAP) && may_exceed && !is_slow(velocity) {
            velocity = S::capped(velocity, cap);
        }
        body.velocity = velocity;
    }
}

/// What gravity adds to a velocity in a step, scaled.
#[cold]
#[inline(never)]
fn weighted<S: Scalar>(gravity: Vec2<S::Speed>, scale: S::Real) -> Vec2<S::Speed> {
    gravity.map(|g| S::speed_scaled(g, scale))
}

/// Stops the kinematic bodies, where they are not called for: what isn't moved may as well be fixed.
pub(crate) fn hold_kinematic<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    if !switches.on(Effects::KINEMATIC) && world.called_for.contain(Effects::KINEMATIC) {
        let driven = world.bodies.iter_mut().filter(|body| body.status.is_kinematic());
        driven.for_each(|body| body.velocity = Vec2::default());
    }
}

/// Moves every body by its velocity, which is first held within the speed limit. `cuts` says whether motions may be cut short.
pub(crate) fn positions<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches, cuts: bool) {
    let averaged = world.level(switches) != Level::Flat;
    let (mut fastest, mut strays) = (S::Speed::ZERO, false);
    for &slot in world.layers.dynamics() {
        let body = &mut world.bodies[usize::from(slot)];
        let before = world.before[usize::from(slot)];
        let marks = body.marks.without(Marks::MOVED.or(Marks::JOLTED).or(Marks::STOOD));
        body.marks = marks;
        if body.velocity == Vec2::default() && before == Vec2::default() && !(cuts && body.push != 0) {
            continue;
        }
        if !body.velocity.x.is_within(fastest) || !body.velocity.y.is_within(fastest) {
            hold(body, &mut world.saturations);
            fastest = larger(fastest, body.velocity);
        }
        let mut motion = motion(body, before, averaged);
        if cuts && body.push != 0 {
            motion = motion.map(|v| S::uncut(v, body.push));
            body.push = 0;
        }
        if body.advance(motion) {
            strays |= body.is_beyond_limit();
            // What creeps is looked at once it has come somewhere.
            let crept = &mut world.crept[usize::from(slot)];
            let far = S::creep(motion);
            if far >= CREEP || crept.saturating_add(far) >= CREEP {
                *crept = 0;
                body.marks = marks.or(Marks::MOVED);
            } else {
                *crept = crept.saturating_add(far);
            }
        }
    }
    world.strays |= strays;
    // Nobody has moved faster than at the start or at the end of the step.
    world.travel = world.travel.saturating_add(fastest.greater(world.fastest));
    world.fastest = fastest;
}

/// The largest of a speed and a velocity's components.
#[inline]
pub(crate) fn larger<T: Quantity>(speed: T, velocity: Vec2<T>) -> T {
    speed.greater(velocity.x.abs()).greater(velocity.y.abs())
}

/// How far a body moves in this step, `before` being its velocity when the step began.
#[inline]
pub(crate) fn motion<S: Scalar>(body: &Body<S>, before: Vec2<S::Speed>, averaged: bool) -> Vec2<S::Speed> {
    let mut motion = body.velocity;
    if averaged && body.status.is_rigid() {
        if !body.marks.has(Marks::HELD_X) {
            motion.x = S::mean(before.x, motion.x);
        }
        if !body.marks.has(Marks::HELD_Y) {
            motion.y = S::mean(before.y, motion.y);
        }
    }
    motion
}

/// Holds a velocity within the speed limit, and counts if that changed it.
fn hold<S: Scalar>(body: &mut Body<S>, saturations: &mut u32) {
    let velocity = body.velocity.map(|v| v.held(S::FASTEST));
    if velocity != body.velocity {
        body.velocity = velocity;
        *saturations = saturations.saturating_add(1);
    }
}
