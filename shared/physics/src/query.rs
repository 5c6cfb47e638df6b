//! What is where: questions to a world that change nothing.
//!
//! Answers come one by one, without a heap: an iterator looks for the answer that follows its last one. So all answers cost as
//! many looks at the neighbourhood as there are answers.
//!
//! Bodies that collide are found as they are between steps; hidden and disabled ones aren't. Touching counts as overlapping.
//! One-way bodies are found from all sides. Tiles are found where they are active and do anything.

use core::iter;

use crate::error::{Error, Field, check};
use crate::geometry::{Bounds, Hit, Outline, cast, part, touches};
use crate::handle::Handle;
use crate::kinematics::Collider;
use crate::scalar::{EXTENT_LIMIT, POSITION_LIMIT, Scalar};
use crate::tiles::{Tile, TileHit, TileMap};
use crate::vec2::Vec2;
use crate::world::World;

/// What a question is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    /// Layers of the bodies that count, and of the map. Default all.
    pub mask: u16,
    /// Whether sensors count, tiles too. Default false.
    pub sensors: bool,
    /// Whether tiles count. Default true.
    pub tiles: bool,
    /// A body that doesn't count, such as the one that asks. Default none.
    pub except: Option<Handle>,
}

impl Default for Filter {
    fn default() -> Self {
        Self { mask: u16::MAX, sensors: false, tiles: true, except: None }
    }
}

/// What a ray or a moving shape meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CastHit<S: Scalar> {
    /// What.
    pub collider: Collider,
    /// Part of the way that is free, 0..=1, rounded down.
    pub time: S::Unit,
    /// Where the ray, or the shape's centre, is then, px.
    pub place: Vec2<S::Real>,
    /// Unit normal of what is met.
    pub normal: Vec2<S::Unit>,
    /// How deep the start lay in it, px; otherwise 0.
    pub depth: S::Real,
}

/// Orders answers: of several at once, bodies by slot, then tiles row by row.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Key<T>(T, Place);

/// A body's slot or a tile's row and column.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Place {
    Body(u16),
    Tile(u16, u16),
}

impl Place {
    fn of(tile: Tile) -> Self {
        Self::Tile(tile.row, tile.column)
    }
}

impl Filter {
    fn counts(&self, tile: Tile) -> bool {
        self.tiles
            && if tile.flags.is_sensor() { self.sensors } else { tile.flags.is_solid() || tile.flags.is_one_way() }
    }
}

impl<S: Scalar> World<'_, S> {
    /// The bodies at a point, edges included, by slot.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the point lies outside the coordinate range.
    pub fn at_point(&self, point: Vec2<S::Real>, filter: Filter) -> Result<impl Iterator<Item = Collider>, Error<S>> {
        self.overlapping(Outline::point(point), filter)
    }

    /// The bodies that a shape overlaps or touches, by slot.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the shape's centre lies outside the coordinate range or its half extents are not 0..=4096.
    pub fn overlapping(&self, outline: Outline<S>, filter: Filter) -> Result<impl Iterator<Item = Collider>, Error<S>> {
        check_outline(&outline)?;
        let bounds = Bounds::of(&outline);
        let mut last = None;
        Ok(iter::from_fn(move || {
            let mut next: Option<(Place, Collider)> = None;
            let mut offer = |place: Place, collider| {
                if last.is_none_or(|last| place > last) && next.is_none_or(|(next, _)| place < next) {
                    next = Some((place, collider));
                }
            };
            self.visit_counting(&filter, &bounds, &mut |slot, other| {
                if touches(&outline, other) {
                    offer(Place::Body(slot), Collider::Body(self.handle(slot)));
                }
            });
            if let Some(tiles) = self.counting_terrain(&filter) {
                for tile in tiles.tiles_in(&bounds).filter(|&tile| filter.counts(tile)) {
                    if touches(&outline, &tiles.bounds(tile).into()) {
                        offer(Place::of(tile), Collider::Tile(tile));
                    }
                }
            }
            let (place, collider) = next?;
            last = Some(place);
            Some(collider)
        }))
    }

    /// What a ray from `origin` to `origin + way` meets first.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the origin lies outside the coordinate range or a component of `way` outside +-32767 px.
    pub fn ray(
        &self,
        origin: Vec2<S::Real>,
        way: Vec2<S::Real>,
        filter: Filter,
    ) -> Result<Option<CastHit<S>>, Error<S>> {
        Ok(self.cast_all(Outline::point(origin), way, filter)?.next())
    }

    /// All that a ray meets, in the order in which it does: of several at once, by slot.
    ///
    /// # Errors
    /// As for [`ray`](Self::ray).
    pub fn ray_all(
        &self,
        origin: Vec2<S::Real>,
        way: Vec2<S::Real>,
        filter: Filter,
    ) -> Result<impl Iterator<Item = CastHit<S>>, Error<S>> {
        self.cast_all(Outline::point(origin), way, filter)
    }

    /// All that a shape would meet that moves along `way` through everything, in the order in which it would: of several at
    /// once, by slot. Touching and grazing isn't meeting.
    ///
    /// # Errors
    /// As for [`overlapping`](Self::overlapping) and [`ray`](Self::ray).
    pub fn cast_all(
        &self,
        outline: Outline<S>,
        way: Vec2<S::Real>,
        filter: Filter,
    ) -> Result<impl Iterator<Item = CastHit<S>>, Error<S>> {
        check_outline(&outline)?;
        check(Field::MotionX, way.x, -i16::MAX, i16::MAX)?;
        check(Field::MotionY, way.y, -i16::MAX, i16::MAX)?;
        let swept = Bounds::swept(&outline, way);
        let at = move |time| outline.centre.saturating_add(part::<S>(way, time));
        let mut last = None;
        Ok(iter::from_fn(move || {
            let is_new = |key: Key<S::Unit>| last.is_none_or(|last| key > last);
            let mut next: Option<(Key<S::Unit>, Hit<S>, Collider)> = None;
            let mut offer = |hit: Hit<S>, place, collider| {
                let key = Key(hit.time, place);
                if is_new(key) && next.is_none_or(|(next, ..)| key < next) {
                    next = Some((key, hit, collider));
                }
            };
            self.visit_counting(&filter, &swept, &mut |slot, other| {
                if let Some(hit) = cast(&outline, way, other) {
                    offer(hit, Place::Body(slot), Collider::Body(self.handle(slot)));
                }
            });
            if let Some(tiles) = self.counting_terrain(&filter) {
                let met_at = |tile: Tile| cast(&outline, way, &tiles.bounds(tile).into());
                let counts = |tile: Tile| {
                    filter.counts(tile) && met_at(tile).is_some_and(|hit| is_new(Key(hit.time, Place::of(tile))))
                };
                if let Some(TileHit { hit, .. }) = tiles.cast(&outline, way, counts) {
                    // Of several that are met then, each in its turn.
                    let near = Bounds::of(&outline.at(at(hit.time))).grown(S::ONE);
                    for tile in tiles.tiles_in(&near).filter(|&tile| counts(tile)) {
                        let met = tiles.cast(&outline, way, |other| other == tile);
                        if let Some(met) = met.filter(|met| met.hit.time == hit.time) {
                            offer(met.hit, Place::of(tile), Collider::Tile(tile));
                        }
                    }
                }
                if filter.sensors && tiles.sensors() > 0 {
                    for tile in tiles.tiles_in(&swept).filter(|&tile| tile.flags.is_sensor() && counts(tile)) {
                        if let Some(hit) = met_at(tile) {
                            offer(hit, Place::of(tile), Collider::Tile(tile));
                        }
                    }
                }
            }
            let (key, hit, collider) = next?;
            last = Some(key);
            Some(CastHit { collider, time: hit.time, place: at(hit.time), normal: hit.normal, depth: hit.depth })
        }))
    }

    /// Visits the bodies that touch some bounds and count.
    fn visit_counting(&self, filter: &Filter, bounds: &Bounds<S>, visit: &mut dyn FnMut(u16, &Outline<S>)) {
        self.visit_near(bounds, &mut |slot| {
            let (body, profile) = (&self.bodies[usize::from(slot)], &self.profiles[usize::from(slot)]);
            let counts = profile.layer & filter.mask != 0 && (filter.sensors || !body.status.is_sensor());
            if counts && filter.except != Some(self.handle(slot)) {
                visit(slot, &Outline::of(body));
            }
        });
    }

    /// The map of tiles, if it counts.
    fn counting_terrain(&self, filter: &Filter) -> Option<&TileMap<'_>> {
        let terrain = self.profiles.get(usize::from(self.terrain))?;
        (filter.tiles && terrain.layer & filter.mask != 0).then_some(&self.tiles)
    }

    /// Visits the slots of all bodies that collide and whose bounding boxes touch `bounds`, each once.
    pub(crate) fn visit_near(&self, bounds: &Bounds<S>, visit: &mut dyn FnMut(u16)) {
        let Bounds { min, max } = *bounds;
        let mut offer = |slot: u16| {
            let body = &self.bodies[usize::from(slot)];
            let is_near =
                body.left() <= max.x && body.right() >= min.x && body.top() <= max.y && body.bottom() >= min.y;
            if is_near && body.status.collides() {
                visit(slot);
            }
        };
        if let Some((dynamics, statics)) = self.layers.up_to_date() {
            dynamics.iter().copied().for_each(&mut offer);
            statics.visit(&Bounds { min, max }, self.bodies, &mut offer);
        } else {
            self.slots_from(0).for_each(|(slot, _)| offer(slot));
        }
    }
}

fn check_outline<S: Scalar>(outline: &Outline<S>) -> Result<(), Error<S>> {
    check(Field::PositionX, outline.centre.x, -POSITION_LIMIT, POSITION_LIMIT)?;
    check(Field::PositionY, outline.centre.y, -POSITION_LIMIT, POSITION_LIMIT)?;
    let (width, height) =
        if outline.circle { (Field::Radius, Field::Radius) } else { (Field::HalfWidth, Field::HalfHeight) };
    check(width, outline.half.x, 0, EXTENT_LIMIT)?;
    check(height, outline.half.y, 0, EXTENT_LIMIT)
}
