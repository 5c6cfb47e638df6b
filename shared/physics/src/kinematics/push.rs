//! Moving rigid bodies out of a kinematic one's way.

use super::sweep::Passage;
use crate::geometry::part;
use crate::scalar::Scalar;
use crate::vec2::Vec2;
use crate::world::World;

/// Most bodies in a row that are pushed by each other.
const ROW: u8 = 8;

impl<S: Scalar> World<'_, S> {
    /// Pushes a rigid body along a motion as far as what is behind it gives way, and that as far as it can. Velocities stay.
    pub(super) fn shove(&mut self, slot: u16, motion: Vec2<S::Real>) {
        self.shove_row(slot, motion, ROW);
    }

    fn shove_row(&mut self, slot: u16, motion: Vec2<S::Real>, row: u8) {
        let passage = Passage::of(slot);
        let mut obstacle = self.first_obstacle(&passage, motion);
        if let Some(next) = obstacle.as_ref().and_then(|met| met.body)
            && row > 1
            && self.bodies[usize::from(next)].status.is_rigid()
        {
            let free = obstacle.map_or(motion, |met| part::<S>(motion, met.hit.time));
            self.shove_row(next, motion - free, row - 1);
            obstacle = self.first_obstacle(&passage, motion);
        }
        let free = obstacle.map_or(motion, |met| part::<S>(motion, met.hit.time));
        self.shift(slot, free);
    }
}
