//! The walk of a platformer: a step's motion along floors, walls and ceilings.

use heapless::Vec;

use super::collide::{Collider, Collision};
use super::footing::{Footing, lands};
use super::sweep::{Passage, slid};
use crate::error::{Error, Field, check};
use crate::geometry::{Bounds, Hit, Outline, along, penetration, without};
use crate::handle::Handle;
use crate::scalar::{POSITION_LIMIT, Quantity, Scalar, px};
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// Surfaces along which one walk slides.
const SLIDES: usize = 4;
/// Surfaces that one walk meets, crates that it pushes included.
const MEETINGS: usize = 8;
/// Sensors that one walk reports.
const SENSORS: usize = 8;
/// Attempts to get out of what the body overlaps.
const RECOVERIES: usize = 4;
/// A surface counts as floor or ceiling up to 45 degrees: in a scale of 4096, cos 45 = 2896.3.
const SCALE: i16 = 4096;
const LEVEL: i16 = 2896;

/// How a body walks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlideOptions<S: Scalar> {
    /// Where floors face, of any length up to 16384; the zero vector where there are only walls, as seen from above. Default
    /// (0, -1).
    pub up: Vec2<S::Real>,
    /// How far a body that stands on a floor follows it down, px, 0..=64. Default 2.
    pub snap: S::Real,
    /// Whether rigid bodies in the way are pushed; otherwise they are walls. Default true.
    pub push: bool,
    /// Whether one-way platforms let the body through from above: to be set until it is below. Default false.
    pub drop_through: bool,
    /// What the body stood on after its last walk. Without it, platforms don't carry the body, and it doesn't snap.
    pub footing: Option<Footing<S>>,
}

impl<S: Scalar> Default for SlideOptions<S> {
    fn default() -> Self {
        Self { up: vec2(S::Real::ZERO, -S::ONE), snap: S::real(px(2)), push: true, drop_through: false, footing: None }
    }
}

impl<S: Scalar> SlideOptions<S> {
    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the first field that is, its value and its range.
    pub fn validate(&self) -> Result<(), Error<S>> {
        check(Field::UpX, self.up.x, -POSITION_LIMIT, POSITION_LIMIT)?;
        check(Field::UpY, self.up.y, -POSITION_LIMIT, POSITION_LIMIT)?;
        check(Field::Snap, self.snap, 0, 64)
    }
}

/// What a walk led to.
#[derive(Clone, Debug)]
pub struct Slide<S: Scalar> {
    /// Velocity left, px/s: without what led into floors, walls and ceilings, and with the platform's when the body left one.
    pub velocity: Vec2<S::Real>,
    /// Way done in all, px.
    pub travel: Vec2<S::Real>,
    /// Whether the body ended on a floor, or slid along one.
    pub floor: bool,
    /// Whether it met a wall.
    pub wall: bool,
    /// Whether it met a ceiling.
    pub ceiling: bool,
    /// What it stands on, for the next walk.
    pub footing: Option<Footing<S>>,
    /// Sensors that found no room in the list.
    pub sensors_lost: u16,
    collisions: Vec<Collision<S>, MEETINGS>,
    sensors: Vec<Collider, SENSORS>,
}

impl<S: Scalar> Slide<S> {
    /// What the body met, in order.
    pub fn collisions(&self) -> impl Iterator<Item = &Collision<S>> {
        self.collisions.iter()
    }

    /// Sensors that the body overlapped on its way, each once.
    pub fn sensors(&self) -> impl Iterator<Item = Collider> {
        self.sensors.iter().copied()
    }

    fn note_sensor(&mut self, sensor: Collider) {
        if !self.sensors.contains(&sensor) && self.sensors.push(sensor).is_err() {
            self.sensors_lost = self.sensors_lost.saturating_add(1);
        }
    }
}

impl<S: Scalar> World<'_, S> {
    /// Moves a kinematic body by one step at `velocity`, px/s, each component within +-7620, and slides along what it meets, up
    /// to four surfaces.
    ///
    /// First the body follows the platform that it stands on and leaves what it overlaps. A disabled body stays where it is.
    /// The body's own velocity is neither used nor changed: leave it at 0, or steps will move the body as well.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::NotKinematic`]; [`Error::OutOfRange`] for the velocity and what
    /// [`SlideOptions::validate`] finds. Nothing changes then.
    pub fn move_and_slide(
        &mut self,
        handle: Handle,
        velocity: Vec2<S::Real>,
        options: &SlideOptions<S>,
    ) -> Result<Slide<S>, Error<S>> {
        let slot = self.kinematic(handle)?;
        check(Field::VelocityX, velocity.x, -7620, 7620)?;
        check(Field::VelocityY, velocity.y, -7620, 7620)?;
        options.validate()?;
        let mut walk = Walk::new(self, slot, velocity, options);
        if walk.world.can_move(slot) {
            walk.run();
        }
        Ok(walk.slide)
    }
}

/// A walk under way.
struct Walk<'w, 'a, 'o, S: Scalar> {
    world: &'w mut World<'a, S>,
    options: &'o SlideOptions<S>,
    passage: Passage,
    up: Option<Vec2<S::Unit>>,
    /// The body that carries the walker.
    platform: Option<u16>,
    floor: Option<Collider>,
    slide: Slide<S>,
}

/// What a surface is to a walker.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Surface {
    Floor,
    Wall,
    Ceiling,
}

impl<'w, 'a, 'o, S: Scalar> Walk<'w, 'a, 'o, S> {
    fn new(world: &'w mut World<'a, S>, slot: u16, velocity: Vec2<S::Real>, options: &'o SlideOptions<S>) -> Self {
        let platform = options.footing.and_then(|footing| world.floor_slot(footing.collider));
        Self {
            world,
            options,
            passage: Passage { footing: platform, drops: options.drop_through, ..Passage::of(slot) },
            up: S::direction(options.up).map(|(direction, _)| direction),
            platform,
            floor: None,
            slide: Slide {
                velocity,
                travel: Vec2::default(),
                floor: false,
                wall: false,
                ceiling: false,
                footing: None,
                sensors_lost: 0,
                collisions: Vec::new(),
                sensors: Vec::new(),
            },
        }
    }

    fn run(&mut self) {
        let slot = usize::from(self.passage.slot);
        let start = self.world.bodies[slot].position;
        self.go(Vec2::default());
        self.ride();
        self.recover();
        let before = self.world.bodies[slot];
        let mut after = before;
        after.advance(self.slide.velocity.map(S::speed));
        let jumps = self.up.is_some_and(|up| along::<S>(self.slide.velocity, up) > S::Real::ZERO);
        self.along_surfaces(after.position - before.position);
        self.world.bodies[slot].remainder =
            if self.slide.collisions.is_empty() { after.remainder } else { Vec2::default() };
        if !jumps {
            self.snap();
        }
        self.settle();
        self.slide.travel = self.world.bodies[slot].position.saturating_sub(start);
    }

    /// Moves where nothing is in the way; notes the sensors on it.
    fn go(&mut self, motion: Vec2<S::Real>) {
        let Self { world, passage, slide, .. } = self;
        world.visit_sensors(passage.slot, motion, &mut |sensor| slide.note_sensor(sensor));
        self.world.shift(self.passage.slot, motion);
    }

    /// Follows the platform.
    fn ride(&mut self) {
        let (Some(floor), Some(footing)) = (self.platform, self.options.footing) else {
            return;
        };
        let mut rest = self.world.carried(self.passage.slot, floor, &footing);
        self.passage.except = self.platform;
        for _ in 0..SLIDES {
            let Some(met) = self.world.first_obstacle(&self.passage, rest) else {
                self.go(rest);
                break;
            };
            let collision = Collision::new(&met, rest);
            self.go(collision.travel);
            rest = slid::<S>(collision.remainder, collision.normal);
        }
        self.passage.except = None;
    }

    /// Leaves what the body overlaps, by the shortest ways, if that can't be pushed instead.
    fn recover(&mut self) {
        for _ in 0..RECOVERIES {
            let Some(way) = self.way_out() else {
                return;
            };
            self.go(way);
        }
    }

    /// Out of the body or tile that is overlapped deepest.
    fn way_out(&self) -> Option<Vec2<S::Real>> {
        let (world, passage) = (&*self.world, &self.passage);
        if !world.bodies[usize::from(passage.slot)].status.collides() {
            return None;
        }
        let mover = world.outline(passage.slot);
        let mut deepest: Option<Hit<S>> = None;
        let mut offer = |hit: Hit<S>| {
            // Geometry decides between equals, too.
            let rank = |hit: &Hit<S>| (hit.depth, hit.normal.y, hit.normal.x);
            if hit.depth > S::Real::ZERO && deepest.as_ref().is_none_or(|deepest| rank(&hit) > rank(deepest)) {
                deepest = Some(hit);
            }
        };
        world.visit_obstacles(passage, &Bounds::of(&mover), &mut |slot, body| {
            if body.status.is_rigid() {
                return;
            }
            let overlap = penetration(&mover, &Outline::of(body)).map(Hit::from);
            let held = |hit| if body.status.is_one_way() { lands(passage, &mover, body, slot, hit) } else { Some(hit) };
            if let Some(hit) = overlap.and_then(held) {
                offer(hit);
            }
        });
        if let Some(tiles) = world.terrain_for(passage.slot) {
            tiles.contacts(&mover, S::Real::ZERO, |contact| {
                if contact.tile.flags.is_solid() {
                    offer(Hit { time: S::Unit::ZERO, normal: -contact.normal, depth: contact.penetration });
                }
            });
        }
        deepest.map(|hit| hit.normal.map(|component| S::length_times(hit.depth, component)))
    }

    fn along_surfaces(&mut self, motion: Vec2<S::Real>) {
        let (mut rest, mut slides) = (motion, 0);
        let (mut pushed, mut before) = (None, None);
        for _ in 0..MEETINGS {
            let Some(met) = self.world.first_obstacle(&self.passage, rest) else {
                self.go(rest);
                return;
            };
            let collision = Collision::new(&met, rest);
            self.go(collision.travel);
            self.note(&collision);
            rest = collision.remainder;
            let surface = self.surface(collision.normal);
            if let Some(body) = met.body
                && surface == Surface::Wall
                && self.options.push
                && pushed != Some(body)
                && self.world.bodies[usize::from(body)].status.is_rigid()
            {
                pushed = Some(body);
                self.world.shove(body, self.level(rest, collision.normal));
                continue;
            }
            self.touch(surface, &collision);
            rest = slid::<S>(rest, collision.normal);
            slides += 1;
            let is_corner = before.is_some_and(|normal| along::<S>(rest, normal) < S::Real::ZERO);
            if slides == SLIDES || is_corner {
                return;
            }
            before = Some(collision.normal);
        }
    }

    /// Keeps to the floor that falls away from a body that stood on one.
    fn snap(&mut self) {
        let Some(up) =
            self.up.filter(|_| self.options.footing.is_some() && !self.slide.floor && !self.options.drop_through)
        else {
            return;
        };
        let down = up.map(|component| S::length_times(-self.options.snap, component));
        if let Some(met) = self.world.first_obstacle(&self.passage, down)
            && self.surface(met.hit.normal) == Surface::Floor
        {
            let collision = Collision::new(&met, down);
            self.go(collision.travel);
            self.touch(Surface::Floor, &collision);
        }
    }

    /// What the next walk needs to know.
    fn settle(&mut self) {
        self.slide.footing = self.floor.map(|floor| self.world.stand(self.passage.slot, floor));
        if let Some(platform) = self.platform.filter(|_| !self.slide.floor) {
            let velocity = self.world.bodies[usize::from(platform)].velocity.map(S::px_per_second);
            self.slide.velocity = self.slide.velocity.saturating_add(velocity);
        }
    }

    fn note(&mut self, collision: &Collision<S>) {
        // There is room for each meeting.
        let _ = self.slide.collisions.push(*collision);
    }

    /// Loses the velocity that leads into a surface.
    fn touch(&mut self, surface: Surface, collision: &Collision<S>) {
        self.slide.velocity = without::<S>(self.slide.velocity, collision.normal);
        match surface {
            Surface::Floor => {
                self.slide.floor = true;
                self.floor = Some(collision.collider);
            }
            Surface::Wall => self.slide.wall = true,
            Surface::Ceiling => self.slide.ceiling = true,
        }
    }

    fn surface(&self, normal: Vec2<S::Unit>) -> Surface {
        let level = S::real(px(LEVEL));
        let facing = self.up.map_or(S::Real::ZERO, |up| {
            along::<S>(normal.map(|component| S::length_times(S::real(px(SCALE)), component)), up)
        });
        if facing >= level {
            Surface::Floor
        } else if facing <= -level {
            Surface::Ceiling
        } else {
            Surface::Wall
        }
    }

    /// The part of a motion that pushes: level, or where nothing is up, along the normal.
    fn level(&self, motion: Vec2<S::Real>, normal: Vec2<S::Unit>) -> Vec2<S::Real> {
        let part_along = |direction: Vec2<S::Unit>| {
            let length = along::<S>(motion, direction);
            direction.map(|component| S::length_times(length, component))
        };
        self.up.map_or_else(|| part_along(normal), |up| motion.saturating_sub(part_along(up)))
    }
}
