//! The first obstacle on a body's way.

use super::collide::Collider;
use super::footing::lands;
use crate::body::{Body, Status};
use crate::geometry::{Bounds, Hit, Outline, along, cast, part, without};
use crate::scalar::{Exact, Quantity, Scalar, ratio};
use crate::tiles::{Tile, TileHit, TileMap};
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Bodies that impulses move rest where the solver left them, to within its slop. An edge that sticks out by no more than this
/// is a seam to walk over, not a wall, px.
const SEAM: ::fixed::types::I16F16 = ratio(1, 16);

/// Who moves, and what it is let through.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    pub(super) slot: u16,
    /// A body that doesn't count: the platform that carries the mover.
    pub(super) except: Option<u16>,
    /// A body that the mover stands on.
    pub(super) footing: Option<u16>,
    /// Whether one-way surfaces let the mover through from above, too.
    pub(super) drops: bool,
}

impl Passage {
    pub(super) fn of(slot: u16) -> Self {
        Self { slot, except: None, footing: None, drops: false }
    }
}

/// What is met, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct Obstacle<S: Scalar> {
    pub(super) hit: Hit<S>,
    pub(super) collider: Collider,
    /// The slot, if it is a body.
    pub(super) body: Option<u16>,
}

impl<S: Scalar> Obstacle<S> {
    /// Whether it is met before another. Of several at once, it is what opposes the motion most; of those, geometry decides, and
    /// where it can't, the lower slot, tiles last.
    fn precedes(&self, other: &Self, motion: Vec2<S::Real>) -> bool {
        let rank = |of: &Self| {
            let Hit { time, normal, .. } = of.hit;
            (time, along::<S>(motion, normal), normal.y, normal.x, of.body.unwrap_or(u16::MAX))
        };
        rank(self) < rank(other)
    }
}

impl<S: Scalar> World<'_, S> {
    /// What a body meets first.
    pub(super) fn first_obstacle(&self, passage: &Passage, motion: Vec2<S::Real>) -> Option<Obstacle<S>> {
        let status = self.bodies[usize::from(passage.slot)].status;
        if !status.collides() || motion == Vec2::default() {
            return None;
        }
        let mover = self.outline(passage.slot);
        let mut first: Option<Obstacle<S>> = None;
        let mut offer = |next: Obstacle<S>| {
            if first.is_none_or(|first| next.precedes(&first, motion)) {
                first = Some(next);
            }
        };
        self.visit_obstacles(passage, &Bounds::swept(&mover, motion), &mut |slot, body| {
            if let Some(hit) = meet(passage, status, &mover, motion, slot, body) {
                offer(Obstacle { hit, collider: Collider::Body(self.handle(slot)), body: Some(slot) });
            }
        });
        let blocks = |tile: Tile| !(passage.drops && tile.flags.is_one_way());
        let met = self.terrain_for(passage.slot).and_then(|tiles| tiles.cast(&mover, motion, blocks));
        if let Some(TileHit { hit, tile }) = met {
            offer(Obstacle { hit, collider: Collider::Tile(tile), body: None });
        }
        first
    }

    /// Visits the bodies that touch some bounds and may block.
    pub(super) fn visit_obstacles(&self, passage: &Passage, bounds: &Bounds<S>, visit: &mut dyn FnMut(u16, &Body<S>)) {
        let own = &self.profiles[usize::from(passage.slot)];
        self.visit_near(bounds, &mut |slot| {
            let (body, profile) = (&self.bodies[usize::from(slot)], &self.profiles[usize::from(slot)]);
            let counts = slot != passage.slot && Some(slot) != passage.except && !body.status.is_sensor();
            if counts && own.meets(profile) {
                visit(slot, body);
            }
        });
    }

    /// Visits the sensors that a body overlaps on its way.
    pub(super) fn visit_sensors(&self, slot: u16, motion: Vec2<S::Real>, visit: &mut dyn FnMut(Collider)) {
        if !self.bodies[usize::from(slot)].status.collides() {
            return;
        }
        let (mover, own) = (self.outline(slot), &self.profiles[usize::from(slot)]);
        let swept = Bounds::swept(&mover, motion);
        self.visit_near(&swept, &mut |other| {
            let (body, profile) = (&self.bodies[usize::from(other)], &self.profiles[usize::from(other)]);
            let notices = other != slot && body.status.is_sensor() && own.meets(profile);
            if notices && cast(&mover, motion, &Outline::of(body)).is_some() {
                visit(Collider::Body(self.handle(other)));
            }
        });
        if let Some(tiles) = self.terrain_for(slot).filter(|tiles| tiles.sensors() > 0) {
            for tile in tiles.tiles_in(&swept).filter(|tile| tile.flags.is_sensor()) {
                if cast(&mover, motion, &tiles.bounds(tile).into()).is_some() {
                    visit(Collider::Tile(tile));
                }
            }
        }
    }

    /// The map of tiles, if there is one that a body's layers meet.
    pub(super) fn terrain_for(&self, slot: u16) -> Option<&TileMap<'_>> {
        let terrain = self.profiles.get(usize::from(self.terrain))?;
        self.profiles[usize::from(slot)].meets(terrain).then_some(&self.tiles)
    }
}

/// Where a body is in a mover's way, if it is. A one-way mover carries what is on it and lets pass what isn't.
fn meet<S: Scalar>(
    passage: &Passage,
    status: Status,
    mover: &Outline<S>,
    motion: Vec2<S::Real>,
    slot: u16,
    body: &Body<S>,
) -> Option<Hit<S>> {
    if status.is_one_way() && !body.status.is_static() {
        return None;
    }
    let target = Outline::of(body);
    let met = cast(mover, motion, &target)?;
    let hit = if body.status.is_one_way() {
        lands(passage, mover, body, slot, met)?
    } else if body.status.is_rigid() || status.is_rigid() {
        over_seam(mover, motion, &target, met)
    } else {
        met
    };
    // What overlaps already, or is met at another side than it seemed, blocks only what leads deeper.
    let is_entered = hit == met && hit.depth == S::Real::ZERO;
    (is_entered || along::<S>(motion, hit.normal) < S::Real::ZERO).then_some(hit)
}

/// The motion along a surface that is left of one into it, turned outwards by what rounding leaves of it, so that the next sweep
/// doesn't meet the same surface again.
pub(super) fn slid<S: Scalar>(motion: Vec2<S::Real>, normal: Vec2<S::Unit>) -> Vec2<S::Real> {
    let zero = S::Unit::ZERO;
    let rest = without::<S>(motion, normal);
    if rest == Vec2::default() || normal.x == zero || normal.y == zero {
        return rest;
    }
    let outwards = |component: S::Unit| if component > zero { S::Real::NUDGE } else { -S::Real::NUDGE };
    rest.saturating_add(normal.map(outwards))
}

/// How boxes meet of which one is rigid: an edge that sticks out by a seam is met from above or below. So it can be walked over,
/// and landed on.
fn over_seam<S: Scalar>(mover: &Outline<S>, motion: Vec2<S::Real>, target: &Outline<S>, hit: Hit<S>) -> Hit<S> {
    let zero = S::Unit::ZERO;
    if mover.circle || target.circle || hit.normal.y != zero {
        return hit;
    }
    let place = mover.centre.y.saturating_add(part::<S>(motion, hit.time).y);
    let offset = place.saturating_sub(target.centre.y);
    let upright = if offset < S::Real::ZERO { -S::UNIT } else { S::UNIT };
    let is_seam = mover.half.y + target.half.y - offset.abs() <= S::real(SEAM);
    if is_seam { Hit { normal: vec2(zero, upright), ..hit } } else { hit }
}
