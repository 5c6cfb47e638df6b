//! Overlap is pushed apart without touching velocities: a part of what exceeds the slop, each step (J. Baumgarte's
//! stabilization, 1972, applied to positions).
//!
//! Above level Flat, the pass runs from the ground up as the shock of velocities does: what stands on firm ground alone gives way,
//! along gravity, and how far each body was pushed is taken into account by those that stand on it. Overlap beyond the slop is
//! corrected to half of it: else everything would rest on the threshold, and be pushed every other step.

use ::fixed::types::I16F16;

use crate::body::{Body, Marks, PUSH};
use crate::config::Level;
use crate::contact::{Contact, Flags};
use crate::effects::Switches;
use crate::pipeline::order::Ground;
use crate::pipeline::{carry, ccd};
use crate::scalar::{Quantity, Scalar, px};
use crate::vec2::Vec2;
use crate::world::World;

/// Most that one contact parts two movable bodies by in a step, px: many in one place don't throw each other over a wall.
const MOST: I16F16 = px(1);

/// How much of an overlap is corrected.
#[derive(Clone, Copy)]
pub(crate) struct Correction<S: Scalar> {
    slop: S::Speed,
    /// What is left of the overlap in the end.
    aim: S::Speed,
    /// Part of the rest that a step leaves.
    rest: S::Real,
}

impl<S: Scalar> Correction<S> {
    /// How far to part bodies that overlap by `depth`, and of it by `old` before this pass: a part of what was there, and all that
    /// the pass has added. So a stack rises as one.
    #[inline]
    pub(crate) fn of(self, depth: S::Speed, old: S::Speed) -> S::Speed {
        if depth <= self.slop {
            return S::Speed::ZERO;
        }
        depth - self.aim - S::speed_scaled((old - self.aim).greater(S::Speed::ZERO), self.rest)
    }
}

/// One pass over all contacts.
pub(crate) fn correct<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let slop = S::per_step(world.config.slop);
    let ground = world.layers.ground();
    let flat = world.level(switches) == Level::Flat;
    let aim = if flat { slop } else { S::half_speed(slop) };
    let correction = Correction { slop, aim, rest: S::ONE - world.config.bias };
    let most = S::per_step(S::real(MOST));
    let mut parted = false;
    world.deep = false;
    let mut pushed_anybody = false;
    let shallow = -slop;
    for contact in world.pool.all() {
        if !pushed_anybody && contact.gap >= shallow {
            continue; // most contacts at rest, and most of those that are far
        }
        if contact.flags.has(Flags::FAR) {
            continue;
        }
        let pushed = if pushed_anybody { pushed(contact, world.bodies, ground) } else { S::Speed::ZERO };
        let depth = -(contact.gap + pushed);
        if depth <= slop {
            continue;
        }
        world.deep |= contact.gap < ccd::deep::<S>();
        let by = correction.of(depth, if flat { depth } else { depth.lesser(-contact.gap) });
        let a = &world.bodies[usize::from(contact.a)];
        let b = &world.bodies[usize::from(contact.b)];
        let bears = contact.flags.has(Flags::BEARS) && !flat;
        if bears && a.marks.has(Marks::GROUNDED) && (!b.status.is_rigid() || b.marks.has(Marks::GROUNDED)) {
            lift(contact, by, world.bodies, ground, switches);
        } else {
            let whole = flat || contact.flags.has(Flags::IMMOVABLE);
            part(contact, if whole { by } else { by.lesser(most) }, world.bodies, ground, switches);
            parted = true;
        }
        pushed_anybody = true;
        world.strays |= [contact.a, contact.b].iter().any(|&slot| world.bodies[usize::from(slot)].is_beyond_limit());
    }
    if parted && !flat {
        carry::positions(world, switches, correction);
    }
}

/// How far this pass has moved the bodies apart along the normal.
#[inline]
fn pushed<S: Scalar>(contact: &Contact<S>, bodies: &[Body<S>], ground: Ground) -> S::Speed {
    let push = i32::from(bodies[usize::from(contact.b)].push) - i32::from(bodies[usize::from(contact.a)].push);
    if push == 0 {
        return S::Speed::ZERO;
    }
    S::speed_times(S::pushes(push), ground.depth(contact.normal))
}

/// Moves the upper body alone, away from the ground.
fn lift<S: Scalar>(
    contact: &Contact<S>,
    correction: S::Speed,
    bodies: &mut [Body<S>],
    ground: Ground,
    switches: impl Switches,
) {
    let along_gravity =
        if contact.slopes(switches) { S::over_slope(correction, ground.depth(contact.normal)) } else { correction };
    let push = S::whole_pushes(along_gravity);
    let body = &mut bodies[usize::from(contact.a)];
    body.push = body.push.saturating_sub(push);
    ground.lower(&mut body.position, -S::in_a_step(S::pushes(i32::from(push))));
    body.marks.set(Marks::MOVED);
}

/// Moves both bodies along the normal, each by its share.
fn part<S: Scalar>(
    contact: &Contact<S>,
    correction: S::Speed,
    bodies: &mut [Body<S>],
    ground: Ground,
    switches: impl Switches,
) {
    let apart = contact.normal.map(|n| S::speed_times(correction, n));
    let [own, other] = contact.parts(apart, switches);
    shift(&mut bodies[usize::from(contact.a)], -own, ground);
    if !contact.flags.has(Flags::IMMOVABLE) {
        shift(&mut bodies[usize::from(contact.b)], other, ground);
    }
}

#[inline(never)]
fn shift<S: Scalar>(body: &mut Body<S>, motion: Vec2<S::Speed>, ground: Ground) {
    body.position = body.position.saturating_add(motion.map(S::in_a_step));
    body.push = body.push.saturating_add(S::whole_pushes(ground.depth(motion)));
    body.marks.set(Marks::MOVED);
}

const _: () = assert!(PUSH == 1 << 12);
