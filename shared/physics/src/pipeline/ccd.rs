//! Continuous collision detection: no body passes through another, however fast.
//!
//! Each body that would move by more than [`ccd_threshold`](crate::Config::ccd_threshold) says is swept along its motion, relative
//! to that of the other, against everything that the broadphase paired it with, and against the tiles. It stops where it first
//! meets something and keeps its velocity: the next step finds it at the surface, and solves the contact there.
//!
//! The pairs are those of the motion that the step began with. A body that has bounced, was pushed, or stops on its way moves
//! otherwise: it is swept against whatever is near, round by round until nobody is stopped any more.

use crate::body::{Body, Marks};
use crate::config::Level;
use crate::contact::{Axis, Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::geometry::{Bounds, Hit, Outline, along, cast, cast_box, without};
use crate::pipeline::order::Ground;
use crate::pipeline::{integrate, one_way, terrain};
use crate::scalar::{Exact, Quantity, Scalar, ratio};
use crate::tiles::Tile;
use crate::variety::Variety;
use crate::vec2::Vec2;
use crate::world::World;

/// A mover is swept as if it were smaller by this on all sides, px: so it slides over the seams between floors on which it rests
/// within the slop, and grazes corners.
const SKIN: ::fixed::types::I16F16 = ratio(1, 32);
/// Most rounds in which bodies stop each other: a row of so many is stopped in good order.
const ROUNDS: usize = 16;
/// Tiles along which one sweep slides: a floor and a wall, before it stops at the next.
const SURFACES: usize = 3;

/// Moves every body, and none through another.
///
/// Who is fast shows as all are moved. Most steps nobody is; otherwise the motions are taken back, and those that would meet
/// something cut short.
pub(crate) fn advance<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    if !switches.on(Effects::CCD) && world.level(switches) != Level::Exact {
        return integrate::positions(world, switches, false);
    }
    let threshold = world.config.ccd_threshold;
    let slow = S::speed_scaled(world.smallest, threshold);
    // Floats can't take a motion back to the last bit, and afterwards nobody could tell that one was cut already, or who has bounced.
    let optimistic = S::Real::SLACK == S::Real::ZERO && !world.deep && !world.bounced && world.fastest.is_within(slow);
    if !optimistic {
        if world.deep {
            hold_back(world, switches);
        }
        if !all_are_slow(slow, world) {
            limit(world, threshold, switches);
        }
    }
    let (travel, fastest) = (world.travel, world.fastest);
    integrate::positions(world, switches, !optimistic);
    if optimistic && !world.fastest.is_within(slow) {
        take_back(world, switches);
        (world.travel, world.fastest) = (travel, fastest);
        limit(world, threshold, switches);
        integrate::positions(world, switches, true);
    }
}

/// Moves every body back by what it has just moved. Position and remainder then add up to what they did.
#[cold]
fn take_back<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    for place in 0..world.layers.dynamics().len() {
        let slot = world.layers.dynamics()[place];
        let motion = motion(slot, world, switches);
        let body = &mut world.bodies[usize::from(slot)];
        body.advance(-motion);
        if body.marks.has(Marks::MOVED) {
            world.crept[usize::from(slot)] = u16::MAX; // however little it moves now, it is looked at
        }
    }
}

/// Cuts the motions of fast bodies short; [`Body::push`] says by how much until they have moved.
fn limit<S: Scalar>(world: &mut World<'_, S>, threshold: S::Real, switches: impl Switches) {
    let (mut fast, mut swift) = (false, false);
    for place in 0..world.layers.dynamics().len() {
        let slot = world.layers.dynamics()[place];
        let speed = mark(slot, threshold, world, switches);
        fast |= speed != Pace::Slow;
        swift |= speed == Pace::Swift;
    }
    if !fast {
        return;
    }
    if switches.on(Effects::TILES) && !world.tiles.is_empty() {
        for place in 0..world.layers.dynamics().len() {
            let slot = world.layers.dynamics()[place];
            sweep_tiles(slot, world, switches);
        }
    }
    for _ in 0..ROUNDS {
        let mut stopped = sweep_pairs(world, switches);
        let count = if swift { world.layers.dynamics().len() } else { 0 };
        for place in 0..count {
            let slot = world.layers.dynamics()[place];
            let marks = &mut world.bodies[usize::from(slot)].marks;
            if marks.has(Marks::JOLTED) {
                marks.clear(Marks::JOLTED);
                stopped |= sweep_around(slot, world, switches);
            }
        }
        if !stopped {
            break;
        }
    }
}

/// Whether nobody moves by more than that in this step.
fn all_are_slow<S: Scalar>(slow: S::Speed, world: &World<'_, S>) -> bool {
    let is_slow = |body: &Body<S>| body.velocity.x.is_within(slow) && body.velocity.y.is_within(slow);
    world.fastest.is_within(slow) && world.slots().iter().all(is_slow)
}

/// Gap from which on a contact is held back.
#[inline]
pub(crate) fn deep<S: Scalar>() -> S::Speed {
    S::per_step(S::real(ratio(-1, 4)))
}

/// What is pressed deep into something immovable, however slowly, is pressed no further than to its centre.
fn hold_back<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    let deep = deep::<S>();
    for place in 0..world.pool.all().len() {
        let contact = world.pool.all()[place];
        let flags = contact.flags;
        if contact.gap >= deep || !flags.has(Flags::IMMOVABLE) || flags.has(Flags::FAR) {
            continue;
        }
        let motion = motion(contact.a, world, switches);
        let body = &mut world.bodies[usize::from(contact.a)];
        let into = S::in_a_step(S::speed_along(motion, contact.normal));
        let room = (least(body) - S::in_a_step(-contact.gap)).greater(S::Real::ZERO);
        if into > room {
            cut(body, motion.map(S::in_a_step), room.fraction_of(into));
        }
    }
}

/// Sweeps the pairs of which at least one is fast; whether that stopped anybody.
fn sweep_pairs<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) -> bool {
    let mut stopped = false;
    for place in 0..world.pool.all().len() {
        let contact = world.pool.all()[place];
        if contact.b == world.terrain || contact.has_parted() {
            continue;
        }
        let [a, b] = [contact.a, contact.b].map(|slot| world.bodies[usize::from(slot)].marks);
        if a.or(b).has(Marks::FAST) {
            match sweep(contact.a, contact.b, contact.flags, world, switches) {
                Outcome::Free => {}
                Outcome::Noticed => world.pool.all_mut()[place].flags.set(Flags::BOUNCED),
                Outcome::Stopped => stopped = true,
            }
        }
    }
    stopped
}

/// What a sweep leads to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Free,
    /// One is a sensor, and meets the other.
    Noticed,
    /// One is stopped earlier than before.
    Stopped,
}

/// How fast a body is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pace {
    Slow,
    /// To be swept against its pairs.
    Fast,
    /// Fast enough to get past something that it wasn't paired with.
    Swift,
}

/// Marks a fast body, and as jolted one whose motion isn't that for which pairs were found.
fn mark<S: Scalar>(slot: u16, threshold: S::Real, world: &mut World<'_, S>, switches: impl Switches) -> Pace {
    let motion = motion(slot, world, switches);
    let before = world.before[usize::from(slot)];
    let body = &mut world.bodies[usize::from(slot)];
    let least = S::per_step(least(body));
    let is_within = |v: Vec2<S::Speed>, limit| v.x.is_within(limit) && v.y.is_within(limit);
    if !is_within(motion.saturating_sub(before), least) {
        body.marks.set(Marks::JOLTED);
    }
    if !body.status.collides() || is_within(motion, S::speed_scaled(least, threshold)) {
        return Pace::Slow;
    }
    body.marks.set(Marks::FAST);
    if is_within(motion, least) { Pace::Fast } else { Pace::Swift }
}

/// Half of a body's shorter side: what moves by less leaves its centre on the near side of whatever it meets.
fn least<S: Scalar>(body: &Body<S>) -> S::Real {
    body.half.x.lesser(body.half.y)
}

/// Sweeps a body against all that is near its way; whether that stopped anybody.
fn sweep_around<S: Scalar>(slot: u16, world: &mut World<'_, S>, switches: impl Switches) -> bool {
    let mut stopped = false;
    let mut place = 0;
    while let Some(&other) = world.layers.dynamics().get(place) {
        place += 1;
        let marks = world.bodies[usize::from(slot)].marks.or(world.bodies[usize::from(other)].marks);
        if other != slot && marks.has(Marks::FAST) {
            stopped |= sweep(slot, other, Flags::default(), world, switches) == Outcome::Stopped;
        }
    }
    let (outline, motion) =
        (Outline::of(&world.bodies[usize::from(slot)]), motion(slot, world, switches).map(S::in_a_step));
    let way = Bounds::swept(&outline, motion);
    let World { bodies, profiles, layers, .. } = world;
    let mut body = bodies[usize::from(slot)];
    if !body.status.is_rigid() || !body.marks.has(Marks::FAST) {
        return stopped;
    }
    layers.statics().visit(&way, bodies, |other| {
        let target = &bodies[usize::from(other)];
        let notices = switches.on(Effects::SENSORS) && (body.status.is_sensor() || target.status.is_sensor());
        let solid = !notices && target.status.collides();
        if solid && profiles[usize::from(slot)].meets(&profiles[usize::from(other)]) {
            let platform = switches.on(Effects::ONE_WAY) && target.status.is_one_way();
            if let Some(hit) = impact(&body, motion, target, switches)
                && (!platform || lands(&hit, &body, target, layers.ground()))
                && let Some(time) = stop(&body, motion, &hit)
            {
                stopped |= cut(&mut body, motion, time);
            }
        }
    });
    world.bodies[usize::from(slot)] = body;
    stopped
}

/// Cuts the motions of a pair that would meet on its way, of which at least one is fast.
fn sweep<S: Scalar>(a: u16, b: u16, flags: Flags, world: &mut World<'_, S>, switches: impl Switches) -> Outcome {
    let ground = world.layers.ground();
    let [motion_a, motion_b] = [a, b].map(|slot| motion(slot, world, switches));
    let relative = motion_a.saturating_sub(motion_b).map(S::in_a_step);
    let [first, second] = [a, b].map(|slot| &world.bodies[usize::from(slot)]);
    let meet = world.profiles[usize::from(a)].meets(&world.profiles[usize::from(b)]);
    let near = Bounds::swept(&Outline::of(first), relative).touch(&Bounds::of(&Outline::of(second)));
    if !meet || !near || !second.status.collides() || !(first.status.is_rigid() || second.status.is_rigid()) {
        return Outcome::Free;
    }
    let Some(hit) = impact(first, relative, second, switches) else {
        return Outcome::Free;
    };
    if switches.on(Effects::SENSORS) && (first.status.is_sensor() || second.status.is_sensor()) {
        return Outcome::Noticed;
    }
    if switches.on(Effects::ONE_WAY) {
        let dropped = flags.has(Flags::IMMOVABLE) && flags.has(Flags::DROPPED);
        let turned = Hit { normal: -hit.normal, ..hit };
        let passes = |hit: &Hit<S>, mover: &Body<S>, platform: &Body<S>| {
            platform.status.is_one_way() && (dropped || !lands(hit, mover, platform, ground))
        };
        if passes(&hit, first, second) || passes(&turned, second, first) {
            return Outcome::Free;
        }
    }
    let pressed = if first.status.is_rigid() { first } else { second };
    let mut outcome = Outcome::Free;
    if let Some(time) = stop(pressed, relative, &hit) {
        for (slot, motion) in [(a, motion_a), (b, motion_b)] {
            let body = &mut world.bodies[usize::from(slot)];
            let is_cut = body.marks.has(Marks::FAST) && body.status.is_rigid();
            if is_cut && cut(body, motion.map(S::in_a_step), time) {
                outcome = Outcome::Stopped;
            }
        }
    }
    outcome
}

/// Whether a platform holds what meets it so.
fn lands<S: Scalar>(hit: &Hit<S>, mover: &Body<S>, platform: &Body<S>, ground: Ground) -> bool {
    let above = one_way::above(mover, platform, ground);
    hit.depth == S::Real::ZERO && one_way::comes_from_above::<S>(-hit.normal, above, ground)
}

/// Cuts the motion of a body that would meet a tile.
fn sweep_tiles<S: Scalar>(slot: u16, world: &mut World<'_, S>, switches: impl Switches) {
    let body = &world.bodies[usize::from(slot)];
    let meets = world.profiles[usize::from(slot)].meets(&world.profiles[usize::from(world.terrain)]);
    let notices = switches.on(Effects::SENSORS) && body.status.is_sensor();
    if !body.marks.has(Marks::FAST) || !body.status.is_rigid() || notices || !meets {
        return;
    }
    let whole = motion(slot, world, switches).map(S::in_a_step);
    let mut motion = whole;
    let mut stopped: Option<S::Unit> = None;
    for _ in 0..SURFACES {
        let counts =
            |tile: Tile| tile.flags.is_solid() || (switches.on(Effects::ONE_WAY) && may_hold(tile, slot, world));
        let Some(met) = world.tiles.cast(&inner(body), motion, counts) else {
            break;
        };
        if let Some(time) = stop(body, motion, &met.hit) {
            stopped = Some(stopped.map_or(time, |stopped| if time < stopped { time } else { stopped }));
        }
        if met.hit.depth == S::Real::ZERO {
            break;
        }
        motion = without::<S>(motion, met.hit.normal); // what lies behind the surface that it is pressed into
    }
    if let Some(time) = stopped {
        cut(&mut world.bodies[usize::from(slot)], whole, time);
    }
}

/// Whether a one-way tile may hold a body: where down is down, and it doesn't let that body through.
fn may_hold<S: Scalar>(tile: Tile, slot: u16, world: &World<'_, S>) -> bool {
    let lets_through = |contact: &Contact<S>| {
        contact.a == slot
            && contact.b == world.terrain
            && contact.flags.has(Flags::DROPPED)
            && terrain::tile(&world.tiles, contact)[1] == tile.row
    };
    world.layers.ground().axis() == Axis::Down && !world.pool.all().iter().any(lets_through)
}

/// Where a body that is swept meets another.
#[inline]
fn impact<S: Scalar>(
    mover: &Body<S>,
    motion: Vec2<S::Real>,
    target: &Body<S>,
    switches: impl Switches,
) -> Option<Hit<S>> {
    let (mover, target) = (inner(mover), Outline::of(target));
    if switches.variety().contain(Variety::CIRCLES) {
        cast(&mover, motion, &target)
    } else {
        cast_box(&mover, motion, &target)
    }
}

/// A body that is swept, smaller by a skin.
#[inline(never)]
fn inner<S: Scalar>(body: &Body<S>) -> Outline<S> {
    let outline = Outline::of(body);
    let skin = S::real(SKIN).lesser(S::half(least(body)));
    Outline { half: outline.half.map(|half| half - skin), ..outline }
}

/// The part of a motion that is left to a body that meets something. If they overlap already, it may be pressed in until its
/// centre is at the surface; none if it may move on.
#[inline(never)]
fn stop<S: Scalar>(body: &Body<S>, motion: Vec2<S::Real>, hit: &Hit<S>) -> Option<S::Unit> {
    let zero = S::Real::ZERO;
    if hit.depth == zero {
        return Some(hit.time);
    }
    let into = -along::<S>(motion, hit.normal);
    let room = (least(body) - hit.depth).greater(zero);
    (into > room).then(|| room.fraction_of(into))
}

/// How far a body would move in this step.
#[inline(never)]
fn motion<S: Scalar>(slot: u16, world: &World<'_, S>, switches: impl Switches) -> Vec2<S::Speed> {
    let body = &world.bodies[usize::from(slot)];
    let motion = integrate::motion(body, world.before[usize::from(slot)], world.level(switches) != Level::Flat);
    if body.push == 0 { motion } else { motion.map(|speed| S::uncut(speed, body.push)) }
}

/// Leaves a part of what is left of a body's motion. Whether so much is lost that who follows close may run into it; or, if it is
/// as much as half of the body, who follows from further away.
#[inline(never)]
fn cut<S: Scalar>(body: &mut Body<S>, motion: Vec2<S::Real>, time: S::Unit) -> bool {
    let whole = i32::from(i16::MAX);
    let rest = (whole - i32::from(body.push)) * (whole - i32::from(S::cut(time))) / whole;
    body.push = (whole - rest) as i16;
    let lost = S::length_times(motion.x.abs().greater(motion.y.abs()), S::UNIT - time);
    if lost > least(body) {
        body.marks.set(Marks::JOLTED);
    }
    lost > S::real(SKIN)
}
