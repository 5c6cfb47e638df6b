//! Which bodies may touch: two layers, in an order that only geometry decides.
//!
//! Moving bodies are found by a [`Sweep`] from the lowest centre up. Static bodies lie in a [`Grid`] that is rebuilt only when one of
//! them changed. There is no cap per cell, no end of the world and no limit to a body's size.
//!
//! What is found are pairs that may touch before bodies have moved by a [`SKIN`]; until then the same pairs serve step after
//! step. A pair's contacts lie in the order of the bodies, so results depend on where bodies are and not on when they were
//! inserted; only bodies with equal centres and sizes are told apart by their slots.

use super::grid::Grid;
use super::order::{self, Ground};
use super::pairs::{NONE, Update};
use super::sweep::{self, Near, Sweep};
use super::terrain;
use super::{carry, integrate};
use crate::body::{Body, Profile};
use crate::contact::Flags;
use crate::effects::{Effects, Switches};
use crate::geometry::Bounds;
use crate::scalar::{Quantity, Scalar, px, ratio};
use crate::tiles::TileMap;
use crate::variety::Variety;
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// How far bodies move before pairs are looked for again, px.
pub(crate) const SKIN: i16 = 1;

/// What the broadphase keeps from step to step, and its scratch space: four entries a body.
#[derive(Debug)]
pub(crate) struct Layers<'a> {
    /// Moving bodies in sweep order; static and sleeping ones at the end.
    order: &'a mut [u16],
    dynamic_count: usize,
    /// Bodies that sleep, which lie among the static ones.
    sleepers: usize,
    /// Next body in the same list of the sweep.
    links: &'a mut [u16],
    /// First contact of each body, by slot.
    groups: &'a mut [u16],
    grid: Grid<'a>,
    ground: Ground,
    /// Bodies came, went or changed.
    dirty: bool,
    /// Static bodies did.
    statics_dirty: bool,
    /// The contacts' groups don't lie in order.
    scattered: bool,
}

impl<'a> Layers<'a> {
    pub(crate) fn new(
        order: &'a mut [u16],
        links: &'a mut [u16],
        groups: &'a mut [u16],
        entries: &'a mut [u16],
    ) -> Self {
        Self {
            order,
            dynamic_count: 0,
            sleepers: 0,
            links,
            groups,
            grid: Grid::new(entries),
            ground: Ground::default(),
            dirty: true,
            statics_dirty: true,
            scattered: false,
        }
    }

    /// Becomes as another one of the same size is.
    pub(crate) fn copy_from(&mut self, other: &Layers<'_>) {
        let Layers { order, dynamic_count, sleepers, links, groups, grid, ground, dirty, statics_dirty, scattered } =
            other;
        self.order.copy_from_slice(order);
        self.links.copy_from_slice(links);
        self.groups.copy_from_slice(groups);
        self.grid.copy_from(grid);
        (self.dynamic_count, self.sleepers) = (*dynamic_count, *sleepers);
        (self.dirty, self.statics_dirty, self.scattered) = (*dirty, *statics_dirty, *scattered);
        self.ground = *ground;
    }

    /// Bodies that may move, in the order of the last sweep: from the ground up.
    #[inline]
    pub(crate) fn dynamics(&self) -> &[u16] {
        &self.order[..self.dynamic_count]
    }

    /// Bodies that may move, and the static layer, unless bodies came, went or changed since the last step.
    pub(crate) fn up_to_date(&self) -> Option<(&[u16], &Grid<'a>)> {
        (!self.dirty).then(|| (self.dynamics(), &self.grid))
    }

    /// The static layer.
    pub(crate) fn statics(&self) -> &Grid<'a> {
        &self.grid
    }

    #[inline]
    pub(crate) fn ground(&self) -> Ground {
        self.ground
    }

    /// A body was added, removed or changed.
    pub(crate) fn changed(&mut self, is_static: bool) {
        self.dirty = true;
        self.statics_dirty |= is_static;
    }

    /// No bodies are left.
    pub(crate) fn clear(&mut self) {
        self.changed(true);
        self.sleepers = 0;
    }

    /// Bodies that sleep, as of the last step.
    #[inline]
    pub(crate) fn sleepers(&self) -> usize {
        self.sleepers
    }

    /// Bodies have fallen asleep or woken, and their contacts lie elsewhere.
    pub(crate) fn shift_sleepers(&mut self) {
        self.changed(true);
        self.scattered = true;
    }

    /// Moving bodies; the links, which are free between steps; scratch space, one a body.
    #[inline]
    pub(crate) fn islands(&mut self) -> (&[u16], &mut [u16], &mut [u16]) {
        (&self.order[..self.dynamic_count], self.links, self.groups)
    }

    /// The next body round a sleeping island.
    pub(crate) fn next_in_island(&self, slot: u16) -> u16 {
        self.links[usize::from(slot)]
    }

    /// Brings both layers up to date with the bodies.
    pub(crate) fn refresh<S: Scalar>(&mut self, bodies: &[Body<S>]) {
        if !self.dirty {
            order::resort(&mut self.order[..self.dynamic_count], bodies, self.ground);
            return;
        }
        self.dirty = false;
        // Who moves is listed from the front, the others from the back.
        let (mut dynamic_count, mut rest) = (0, self.order.len());
        self.sleepers = 0;
        for (slot, body) in bodies.iter().enumerate().filter(|(_, body)| body.status.is_enabled()) {
            let place = if body.status.is_static() || body.is_asleep() {
                self.sleepers += usize::from(body.is_asleep());
                rest -= 1;
                rest
            } else {
                dynamic_count += 1;
                dynamic_count - 1
            };
            self.order[place] = slot as u16;
        }
        self.dynamic_count = dynamic_count;
        order::sort(&mut self.order[..dynamic_count], bodies, self.ground);
        if self.statics_dirty {
            self.statics_dirty = false;
            self.grid.rebuild(&self.order[rest..], bodies);
        }
    }
}

/// Brings the pairs up to date, if bodies may have met since that was last done.
pub(crate) fn update<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    turn(world, Ground::of(integrate::gravity(world, switches)));
    if !world.layers.dirty && world.travel.saturating_add(world.fastest) < skin::<S>() {
        return;
    }
    world.travel = S::Speed::ZERO;
    find_pairs(world, switches);
}

/// A skin, as the speed that covers it in a step.
fn skin<S: Scalar>() -> S::Speed {
    S::per_step(S::real(px(SKIN)))
}

/// Sorts bodies towards another ground, if gravity pulls elsewhere: what bears whom is then another matter.
fn turn<S: Scalar>(world: &mut World<'_, S>, ground: Ground) {
    if ground != world.layers.ground {
        (world.layers.ground, world.layers.dirty) = (ground, true);
        world.pool.all_mut().iter_mut().for_each(|contact| contact.flags.set(Flags::NEW));
    }
}

/// Finds all pairs that there is room for. If there isn't room for all, those that bear somebody come first.
fn find_pairs<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches) {
    search(world, switches, Wanted::All);
    if world.pool.missing > 0 {
        search(world, switches, Wanted::Bearing);
        search(world, switches, Wanted::All);
    }
}

/// Which pairs a search keeps and adds.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    All,
    /// A body and what it is about to touch below it, or what is immovable.
    Bearing,
}

#[inline(never)]
fn search<S: Scalar>(world: &mut World<'_, S>, switches: impl Switches, wanted: Wanted) {
    let tell_ends = switches.on(Effects::EVENTS) && world.told_at == Some(world.steps);
    let terrain = world.terrain;
    let World { bodies, profiles, layers, pool, tiles, smallest, fastest, uneven, used, .. } = world;
    let (bodies, profiles) = (&bodies[..usize::from(*used)], &**profiles);
    if !tell_ends {
        pool.forget_aside();
    }
    if layers.dirty {
        pool.set_aside(tell_ends);
    }
    let changed = layers.dirty;
    layers.refresh(bodies);
    if changed {
        let speeds = layers.dynamics().iter().map(|&slot| bodies[usize::from(slot)].velocity);
        *fastest = speeds.fold(S::Speed::ZERO, integrate::larger);
        let sizes = layers.dynamics().iter().map(|&slot| &bodies[usize::from(slot)].half);
        *smallest = S::per_step(sizes.fold(S::real(px(i16::MAX)), |least, half| least.lesser(half.x).lesser(half.y)));
        *uneven = switches.variety().contain(Variety::MASSES) && carry::is_uneven(layers.dynamics(), bodies, profiles);
    }
    let Layers { order, dynamic_count, links, groups, grid, ground, scattered, .. } = layers;
    let (dynamics, ground) = (&order[..*dynamic_count], *ground);
    let mut update = Update::new(pool, groups, core::mem::take(scattered));
    let pairs = Pairs { bodies, profiles, ground, switches, wanted, changed };
    // Until pairs are next looked for, either body may move by a skin. Where somebody is fast, that is in the next step.
    let margin = S::real(px(if *fastest < skin::<S>() { 2 * SKIN } else { SKIN }));
    if !grid.is_empty() {
        note_static(dynamics, margin, grid, &pairs, &mut update);
    }
    if switches.on(Effects::TILES) && terrain != NONE {
        note_terrain(dynamics, margin, terrain, tiles, &pairs, &mut update);
    }
    note_moving(dynamics, margin, links, &pairs, &mut update);
    update.finish(dynamics, links, bodies, profiles, ground, tell_ends);
}

/// Notes what bodies may touch of the static layer.
#[inline(never)]
fn note_static<S: Scalar, W: Switches>(
    dynamics: &[u16],
    margin: S::Real,
    grid: &Grid<'_>,
    pairs: &Pairs<'_, S, W>,
    update: &mut Update<'_, '_, S>,
) {
    for &slot in dynamics {
        let body = &pairs.bodies[usize::from(slot)];
        if !pairs.may_notice(body) {
            continue;
        }
        let is_rigid = body.status.is_rigid();
        let reach = body.half + way(body, margin);
        let bounds = Bounds { min: body.position - reach, max: body.position + reach };
        grid.visit(&bounds, pairs.bodies, |other| {
            // Whoever sleeps is found by rigid bodies; others have woken it if they move.
            if is_rigid || pairs.bodies[usize::from(other)].status.is_static() {
                pairs.note(slot, other, update);
            }
        });
    }
}

/// Notes what bodies may touch of the tile map, whose slot is `map`.
#[inline(never)]
fn note_terrain<S: Scalar, W: Switches>(
    dynamics: &[u16],
    margin: S::Real,
    map: u16,
    tiles: &TileMap<'_>,
    pairs: &Pairs<'_, S, W>,
    update: &mut Update<'_, '_, S>,
) {
    for &slot in dynamics {
        let body = &pairs.bodies[usize::from(slot)];
        if !pairs.may_notice(body) {
            continue;
        }
        let way = way(body, margin);
        let reach = way.x.greater(way.y);
        let around = tiles.bits_around::<S>(body.position, body.half + vec2(reach, reach));
        // Most are near nothing.
        if around != 0 {
            note_tiles(slot, map, reach, around, tiles, pairs, update);
        }
    }
}

/// How far a body comes in a step along each axis, and a margin.
#[inline]
fn way<S: Scalar>(body: &Body<S>, margin: S::Real) -> Vec2<S::Real> {
    body.velocity.map(|v| sweep::magnitude(S::in_a_step(v)) + margin)
}

/// Notes which bodies that may move may meet.
#[inline(never)]
fn note_moving<S: Scalar, W: Switches>(
    dynamics: &[u16],
    margin: S::Real,
    links: &mut [u16],
    pairs: &Pairs<'_, S, W>,
    update: &mut Update<'_, '_, S>,
) {
    let bodies = pairs.bodies;
    let mut sweep = Sweep::new(links, dynamics, bodies, pairs.ground);
    for &slot in dynamics {
        let body = &bodies[usize::from(slot)];
        if body.status.collides() {
            sweep.visit(slot, &Near::new(body, margin), bodies, |other| {
                if !(pairs.are_known_of(body) && update.keep_pair(slot, other)) {
                    pairs.note(slot, other, update);
                }
            });
        }
    }
}

/// What a search needs to know to tell which pairs of bodies count.
pub(crate) struct Pairs<'w, S: Scalar, W: Switches> {
    pub(crate) bodies: &'w [Body<S>],
    profiles: &'w [Profile<S>],
    ground: Ground,
    switches: W,
    wanted: Wanted,
    /// Bodies came, went or changed since the last search: a pair of then may not be one now.
    changed: bool,
}

impl<S: Scalar, W: Switches> Pairs<'_, S, W> {
    /// Whether anything happens when a body touches what is fixed.
    #[inline]
    fn may_notice(&self, body: &Body<S>) -> bool {
        body.status.collides() && (body.status.is_rigid() || self.switches.on(Effects::SENSORS))
    }

    /// Whether a pair of this upper body's that has a contact is still one.
    #[inline]
    pub(crate) fn are_known_of(&self, upper: &Body<S>) -> bool {
        !self.changed && upper.status.is_rigid() && self.wanted == Wanted::All
    }

    /// Notes two bodies that are near, `upper` after `lower` in the order, if anything happens when they touch.
    #[cold]
    #[inline(never)]
    pub(crate) fn note(&self, upper: u16, lower: u16, update: &mut Update<'_, '_, S>) {
        let [first, second] = [upper, lower].map(|slot| self.bodies[usize::from(slot)].status);
        if !(first.is_rigid() || second.is_rigid() || self.switches.on(Effects::SENSORS)) {
            return;
        }
        // What can be pushed comes first; what is immovable pushes. Of two that are, one is a sensor.
        let (a, b) = if first.is_rigid() || !second.is_rigid() { (upper, lower) } else { (lower, upper) };
        if self.wanted == Wanted::Bearing && !may_bear(upper, lower, self.bodies, self.ground) {
            return;
        }
        if self.changed && !self.meet(a, b) {
            return;
        }
        if !update.keep_pair(a, b) && (self.changed || self.meet(a, b)) {
            update.add_pair(a, b, self.bodies, self.profiles, self.switches);
        }
    }

    /// Whether anything happens when two bodies touch of which one is rigid, or sensors are on.
    fn meet(&self, a: u16, b: u16) -> bool {
        let [first, second] = [a, b].map(|slot| self.bodies[usize::from(slot)].status);
        (first.is_rigid() || second.is_rigid() || first.is_sensor() || second.is_sensor())
            && first.collides()
            && second.collides()
            && self.profiles[usize::from(a)].meets(&self.profiles[usize::from(b)])
    }
}

/// Makes room for what a body may touch of the tile map before it has moved by a skin, or in this step at its speed.
#[inline(never)]
fn note_tiles<S: Scalar, W: Switches>(
    slot: u16,
    map: u16,
    reach: S::Real,
    around: u8,
    tiles: &TileMap<'_>,
    pairs: &Pairs<'_, S, W>,
    update: &mut Update<'_, '_, S>,
) {
    let (body, profiles) = (&pairs.bodies[usize::from(slot)], pairs.profiles);
    if !profiles[usize::from(slot)].meets(&profiles[usize::from(map)]) {
        return;
    }
    let sensors = pairs.switches.on(Effects::SENSORS);
    if body.status.is_rigid() && !(sensors && body.status.is_sensor()) {
        let room = terrain::room(tiles, body, reach, around);
        if room > 0 {
            update.note_terrain(slot, map, room, profiles);
        }
    }
    if sensors && tiles.sensors() > 0 {
        terrain::sensors(tiles, body, reach, |number| update.note_sensor_tile(slot, map, number, profiles));
    }
}

/// Whether a body may be borne by another: one that is immovable, or that lies rather below than beside it; and they are as good as
/// in touch.
#[cold]
fn may_bear<S: Scalar>(upper: u16, lower: u16, bodies: &[Body<S>], ground: Ground) -> bool {
    let (a, b) = (&bodies[usize::from(upper)], &bodies[usize::from(lower)]);
    let gap = (b.position - a.position).map(sweep::magnitude) - a.half - b.half;
    let speed = (a.velocity.map(S::in_a_step) - b.velocity.map(S::in_a_step)).map(sweep::magnitude);
    let margin = S::real(ratio(1, 4)) + speed.x.greater(speed.y);
    let is_firm = !a.status.is_rigid() || !b.status.is_rigid();
    let (aside, away) = if ground.is_horizontal() { (gap.y, gap.x) } else { (gap.x, gap.y) };
    aside <= margin && away <= margin && (is_firm || aside <= away)
}
