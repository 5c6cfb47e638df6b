//! Bodies at rest are left out of the step until something happens to them.
//!
//! Bodies that may push each other make up an *island*. Once all of an island's bodies have been slow for [`PATIENCE`] steps, it
//! falls asleep as a whole: its bodies lie in the static layer from then on, its contacts at the end of the pool, and neither
//! costs a step anything. It wakes as a whole when
//!
//! - a moving body comes so near that it may touch one of its bodies in this step,
//! - the game pushes, moves or changes one of them, or what one of them touches,
//! - what one of them stands on, or leans against, moves or goes,
//! - something immovable appears where one of them is, or gravity changes.
//!
//! `Body::marks` say who sleeps, `Profile::rest` who belongs to an island that does, and the links of the broadphase, which
//! sleeping bodies don't need otherwise, go round the island.

use crate::body::{Body, Marks, Profile};
use crate::config::Level;
use crate::contact::{Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::geometry::{Bounds, Outline};
use crate::pipeline::pairs::NONE;
use crate::scalar::{Quantity, Scalar, px};
use crate::vec2::Vec2;
use crate::world::World;

/// How many steps a body is slow before it may fall asleep.
const PATIENCE: u8 = 30;
/// Islands are looked for once in so many steps.
const INTERVAL: u32 = 8;
/// `Profile::rest` of a body in a sleeping island.
pub(crate) const ASLEEP: u8 = u8::MAX;
/// How near something immovable must appear to wake a body, px: as far as pairs are looked for.
const NEAR: i16 = 2;

/// At the start of a step: wakes whom the game has disturbed since the last one, and lets fall asleep who has been at rest.
pub(crate) fn update<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    if !switches.on(Effects::SLEEP) {
        if !switches.are_fixed() && !world.pool.asleep().is_empty() {
            world.wake_all();
            rouse(world);
        }
        return;
    }
    if world.stirred {
        rouse(world);
    }
    let ripe = watch(world, switches);
    if ripe && world.steps.is_multiple_of(INTERVAL) {
        doze(world);
    }
}

/// Once contacts are known: wakes whoever may be touched in this step by a body that is awake; whether there was anybody.
pub(crate) fn wake_touched<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) -> bool {
    if !switches.on(Effects::SLEEP) || world.layers.sleepers() == 0 {
        return false;
    }
    let mut woken = false;
    for place in 0..world.pool.all().len() {
        let contact = &world.pool.all()[place];
        if links(contact) && world.bodies[usize::from(contact.b)].marks.has(Marks::ASLEEP) {
            woken = true;
            wake_island(contact.b, world);
        }
    }
    if woken {
        wake_contacts(world);
    }
    woken
}

/// Whether a contact makes its bodies one island: they may push each other in this step, or one notices the other.
fn links<S: Scalar>(contact: &Contact<S>) -> bool {
    let near = !contact.flags.has(Flags::FAR) || (contact.flags.has(Flags::SENSOR) && contact.gap < S::FASTEST);
    near && !contact.has_parted()
}

/// Notes that a rigid body is not at rest; whether it slept.
pub(crate) fn disturb<S: Scalar>(body: &mut Body<S>, profile: &mut Profile<S>) -> bool {
    body.marks.clear(Marks::ASLEEP);
    let slept = profile.rest == ASLEEP;
    if !slept {
        profile.rest = 0;
    }
    slept
}

/// Counts for how long each body has been slow; whether one has been for long enough. What moves by itself wakes whatever is near.
fn watch<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) -> bool {
    let slow = S::speed(world.config.sleep_speed);
    let knows_what_presses = world.level(switches) != Level::Flat;
    let mut ripe = false;
    for place in 0..world.layers.dynamics().len() {
        let slot = world.layers.dynamics()[place];
        let body = &world.bodies[usize::from(slot)];
        if may_sleep(body) {
            let profile = &mut world.profiles[usize::from(slot)];
            if is_at_rest(body, slow, knows_what_presses) {
                profile.rest = (profile.rest + 1).min(PATIENCE);
                ripe |= profile.rest == PATIENCE;
            } else {
                profile.rest = 0;
            }
        } else if switches.on(Effects::KINEMATIC)
            && body.status.is_kinematic()
            && body.velocity != Vec2::default()
            && world.layers.sleepers() > 0
        {
            rouse_around(slot, world);
            wake_contacts(world);
        }
    }
    ripe
}

/// Whether a body could sleep. Since they were last listed, some may have gone.
fn may_sleep<S: Scalar>(body: &Body<S>) -> bool {
    body.status.is_enabled() && body.status.is_rigid()
}

/// Slow while something presses on the body, or not moving at all. In free fall nobody is at rest, however slow.
fn is_at_rest<S: Scalar>(body: &Body<S>, slow: S::Speed, knows_what_presses: bool) -> bool {
    if !body.velocity.x.is_within(slow) || !body.velocity.y.is_within(slow) || body.marks.has(Marks::FORCED) {
        return false;
    }
    let is_pressed = body.marks.has(Marks::HELD_X.or(Marks::HELD_Y)) || !knows_what_presses;
    is_pressed || (body.velocity == Vec2::default() && !body.marks.has(Marks::MOVED))
}

/// Lets all islands fall asleep whose bodies have been slow for long enough.
fn doze<S: Scalar>(world: &mut World<'_, S>) {
    let World { bodies, profiles, layers, pool, .. } = world;
    let (order, parents, labels) = layers.islands();
    for &slot in order {
        parents[usize::from(slot)] = slot;
    }
    for contact in pool.all().iter().filter(|contact| links(contact)) {
        let [a, b] = [contact.a, contact.b].map(|slot| &bodies[usize::from(slot)]);
        if a.status.is_rigid() && b.status.is_rigid() {
            let [first, second] = [contact.a, contact.b].map(|slot| root(slot, parents));
            parents[usize::from(first.max(second))] = first.min(second);
        }
    }
    for contact in pool.all() {
        let other = &bodies[usize::from(contact.b)];
        let moves = other.velocity != Vec2::default() || other.marks.has(Marks::MOVED);
        // What bore the body since it came to rest may bear it no longer.
        if contact.flags.has(Flags::NEW) || contact.has_parted() || (other.status.is_kinematic() && moves) {
            profiles[usize::from(contact.a)].rest = 0;
        }
    }
    // An island waits for its last body: one that isn't ready holds the island's root back, for this time.
    for &slot in order {
        let label = root(slot, parents);
        labels[usize::from(slot)] = label;
        if profiles[usize::from(slot)].rest < PATIENCE {
            let rest = &mut profiles[usize::from(label)].rest;
            *rest = (*rest).min(PATIENCE - 1);
        }
    }
    // What pointed to a root becomes a ring.
    for &slot in order {
        parents[usize::from(slot)] = slot;
    }
    let mut count = 0;
    for &slot in order {
        let label = labels[usize::from(slot)];
        if label != slot {
            parents[usize::from(slot)] = parents[usize::from(label)];
            parents[usize::from(label)] = slot;
        }
        let body = &mut bodies[usize::from(slot)];
        if may_sleep(body) && profiles[usize::from(label)].rest >= PATIENCE {
            body.velocity = Vec2::default();
            body.marks = Marks::ASLEEP;
            count += 1;
        }
    }
    if count > 0 {
        fall_asleep(world);
    }
}

/// The root of a body's tree; on the way there, paths are halved.
fn root(mut slot: u16, parents: &mut [u16]) -> u16 {
    while parents[usize::from(slot)] != slot {
        let next = parents[usize::from(parents[usize::from(slot)])];
        parents[usize::from(slot)] = next;
        slot = next;
    }
    slot
}

/// Takes those that are newly marked as asleep, and their contacts, out of the step.
fn fall_asleep<S: Scalar>(world: &mut World<'_, S>) {
    let World { bodies, profiles, before, layers, pool, .. } = world;
    let sleeps = |slot: u16| bodies[usize::from(slot)].marks.has(Marks::ASLEEP);
    for contact in pool.all_mut() {
        // Who is awake looks for pairs; who sleeps doesn't.
        let meets_awake = bodies[usize::from(contact.b)].status.is_rigid() && !sleeps(contact.b);
        if sleeps(contact.a) && meets_awake && !contact.has_parted() {
            contact.part(profiles);
        }
    }
    let (order, _, groups) = layers.islands();
    for &slot in order {
        if sleeps(slot) {
            groups[usize::from(slot)] = NONE;
            profiles[usize::from(slot)].rest = ASLEEP;
            before[usize::from(slot)] = Vec2::default();
        }
    }
    pool.put_to_sleep(|contact| sleeps(contact.a) && !contact.has_parted());
    layers.shift_sleepers();
}

/// Wakes whoever was disturbed.
fn rouse<S: Scalar>(world: &mut World<'_, S>) {
    world.stirred = false;
    for place in 0..world.pool.asleep().len() {
        let contact = &world.pool.asleep()[place];
        let [a, b] = [contact.a, contact.b];
        if contact.has_parted() || contact.flags.has(Flags::NEW) {
            wake_island(if world.profiles[usize::from(a)].rest == ASLEEP { a } else { b }, world);
        }
    }
    for slot in 0..world.bodies.len() {
        let body = &world.bodies[slot];
        let (is_stirred, sleeps) = (!body.status.is_rigid() && body.marks.has(Marks::STIRRED), body.is_asleep());
        if world.profiles[slot].rest == ASLEEP && !sleeps {
            wake_island(slot as u16, world);
        }
        if is_stirred {
            world.bodies[slot].marks.clear(Marks::STIRRED);
            rouse_around(slot as u16, world);
        }
    }
    wake_contacts(world);
}

/// Wakes all that a body may touch, or may come to touch in this step.
fn rouse_around<S: Scalar>(slot: u16, world: &mut World<'_, S>) {
    let body = &world.bodies[usize::from(slot)];
    if !body.status.collides() {
        return;
    }
    let motion = body.velocity.map(S::in_a_step);
    let bounds = Bounds::swept(&Outline::of(body), motion).grown(S::real(px(NEAR)));
    for other in 0..world.bodies.len() {
        let sleeper = &world.bodies[other];
        let is_near = sleeper.is_asleep() && bounds.touch(&Bounds::of(&Outline::of(sleeper)));
        if is_near && world.profiles[usize::from(slot)].meets(&world.profiles[other]) {
            wake_island(other as u16, world);
        }
    }
}

/// Wakes the bodies of an island.
#[inline(never)]
fn wake_island<S: Scalar>(member: u16, world: &mut World<'_, S>) {
    let World { bodies, profiles, layers, .. } = world;
    let mut slot = member;
    while profiles[usize::from(slot)].rest == ASLEEP {
        profiles[usize::from(slot)].rest = 0;
        bodies[usize::from(slot)].marks.clear(Marks::ASLEEP);
        slot = layers.next_in_island(slot);
    }
}

/// Brings the contacts of all that were woken back into the step.
#[inline(never)]
fn wake_contacts<S: Scalar>(world: &mut World<'_, S>) {
    let World { profiles, layers, pool, .. } = world;
    let sleeps = |slot: u16| profiles[usize::from(slot)].rest == ASLEEP;
    pool.wake(|contact| !sleeps(contact.a) && !sleeps(contact.b));
    layers.shift_sleepers();
}

impl<S: Scalar> World<'_, S> {
    /// Wakes a body and all that it lies among. Changing a body does that by itself.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`](crate::Error::NoSuchBody).
    pub fn wake(&mut self, handle: crate::Handle) -> Result<(), crate::Error<S>> {
        self.slot(handle)?;
        self.disturb(handle.slot);
        Ok(())
    }

    /// Wakes all.
    #[inline(never)] // for the same reason as `World::clear`
    pub(crate) fn wake_all(&mut self) {
        for (body, profile) in self.bodies.iter_mut().zip(self.profiles.iter_mut()) {
            if body.status.is_rigid() {
                self.stirred |= disturb(body, profile);
            }
        }
    }
}
