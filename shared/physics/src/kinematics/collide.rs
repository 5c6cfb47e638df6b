//! One motion up to the first obstacle.

use super::sweep::{Obstacle, Passage};
use crate::error::{Error, Field, check};
use crate::geometry::{Outline, part};
use crate::handle::Handle;
use crate::scalar::{POSITION_LIMIT, Quantity, Scalar, px};
use crate::tiles::Tile;
use crate::vec2::Vec2;
use crate::world::World;

/// Longest component of a motion, px.
const MOTION_LIMIT: i16 = i16::MAX;

/// What can be in the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Collider {
    /// A body.
    Body(Handle),
    /// A tile of the map.
    Tile(Tile),
}

/// How a motion ended before its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collision<S: Scalar> {
    /// What was met first.
    pub collider: Collider,
    /// Its unit normal where it was met, towards the moving body.
    pub normal: Vec2<S::Unit>,
    /// Part of the motion that was done, 0..=1.
    pub time: S::Unit,
    /// That part, px.
    pub travel: Vec2<S::Real>,
    /// What is left of the motion, px.
    pub remainder: Vec2<S::Real>,
    /// How deep the two overlapped before the motion, which would have led deeper; otherwise 0.
    pub depth: S::Real,
}

impl<S: Scalar> Collision<S> {
    pub(super) fn new(obstacle: &Obstacle<S>, motion: Vec2<S::Real>) -> Self {
        let hit = &obstacle.hit;
        let travel = part::<S>(motion, hit.time);
        Self {
            collider: obstacle.collider,
            normal: hit.normal,
            time: hit.time,
            travel,
            remainder: motion - travel,
            depth: hit.depth,
        }
    }
}

impl<S: Scalar> World<'_, S> {
    /// Moves a kinematic body by `motion` px, or until it first meets something. None if it got to the end.
    ///
    /// Sweeps exactly, whatever the length. A one-way body stops it only if it comes from above. A disabled body stays where it
    /// is.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`]; [`Error::NotKinematic`]; [`Error::OutOfRange`] if the motion is longer than 32767 px along an axis
    /// or would end outside the coordinate range. Nothing changes then.
    pub fn move_and_collide(
        &mut self,
        handle: Handle,
        motion: Vec2<S::Real>,
    ) -> Result<Option<Collision<S>>, Error<S>> {
        let slot = self.kinematic(handle)?;
        check(Field::MotionX, motion.x, -MOTION_LIMIT, MOTION_LIMIT)?;
        check(Field::MotionY, motion.y, -MOTION_LIMIT, MOTION_LIMIT)?;
        let end = self.bodies[usize::from(slot)].position.saturating_add(motion);
        check(Field::PositionX, end.x, -POSITION_LIMIT, POSITION_LIMIT)?;
        check(Field::PositionY, end.y, -POSITION_LIMIT, POSITION_LIMIT)?;
        if !self.can_move(slot) {
            return Ok(None);
        }
        let collision =
            self.first_obstacle(&Passage::of(slot), motion).map(|obstacle| Collision::new(&obstacle, motion));
        self.shift(slot, collision.as_ref().map_or(motion, |collision| collision.travel));
        Ok(collision)
    }

    /// The slot of a kinematic body.
    pub(super) fn kinematic(&self, handle: Handle) -> Result<u16, Error<S>> {
        let slot = self.slot(handle)?;
        if self.bodies[slot].status.is_kinematic() { Ok(slot as u16) } else { Err(Error::NotKinematic { handle }) }
    }

    pub(super) fn outline(&self, slot: u16) -> Outline<S> {
        Outline::of(&self.bodies[usize::from(slot)])
    }

    /// Whether a body takes part and is where bodies may be.
    pub(super) fn can_move(&self, slot: u16) -> bool {
        let body = &self.bodies[usize::from(slot)];
        let limit = S::real(px(POSITION_LIMIT));
        body.status.is_enabled() && body.position.x.abs() <= limit && body.position.y.abs() <= limit
    }

    /// Moves a body, whatever is in the way. A body that gets beyond the coordinate range is held a little behind it, where the
    /// next step finds and disables it.
    pub(super) fn shift(&mut self, slot: u16, motion: Vec2<S::Real>) {
        let limit = S::real(px(POSITION_LIMIT + 1));
        let body = &mut self.bodies[usize::from(slot)];
        let start = body.position;
        body.position = start.saturating_add(motion).map(|coordinate| coordinate.held(limit));
        let travel = body.position.saturating_sub(start);
        self.moved(slot, travel);
    }
}
