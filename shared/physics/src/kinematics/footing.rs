//! What a body stands on: riding it, and the rule of one-way platforms.
//!
//! A one-way body stops what comes from above: before the motion the mover's lower edge was not below the platform's upper one,
//! the way between the two being counted against each other if the platform rose in the last step; and the surface that is met
//! faces up. A mover that stands on the platform already is held at any depth. Up is where y falls.

use super::collide::Collider;
use super::sweep::Passage;
use crate::body::Body;
use crate::geometry::{Hit, Outline};
use crate::scalar::{Quantity, Scalar, ratio};
use crate::vec2::{Vec2, vec2};
use crate::world::World;

/// What a body stands on, and where: [`Slide::footing`](super::Slide::footing) of one walk, to be handed to the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footing<S: Scalar> {
    /// The floor.
    pub collider: Collider,
    /// From the floor body's centre to the standing one's, px; 0 for tiles.
    pub offset: Vec2<S::Real>,
}

impl<S: Scalar> World<'_, S> {
    /// What a body in a slot stands on, from now on.
    pub(super) fn stand(&self, slot: u16, collider: Collider) -> Footing<S> {
        let offset = self.floor_slot(collider).map_or(Vec2::default(), |floor| {
            self.bodies[usize::from(slot)].position.saturating_sub(self.bodies[usize::from(floor)].position)
        });
        Footing { collider, offset }
    }

    /// The slot of a floor that is a body and still one to stand on.
    pub(super) fn floor_slot(&self, collider: Collider) -> Option<u16> {
        match collider {
            Collider::Body(handle) => {
                let slot = self.slot(handle).ok()?;
                self.bodies[slot].status.collides().then_some(handle.slot)
            }
            Collider::Tile(_) => None,
        }
    }

    /// Where the floor has carried a body that stands on it.
    pub(super) fn carried(&self, slot: u16, floor: u16, footing: &Footing<S>) -> Vec2<S::Real> {
        let place = self.bodies[usize::from(floor)].position.saturating_add(footing.offset);
        place.saturating_sub(self.bodies[usize::from(slot)].position)
    }
}

/// How a one-way body is met, if it is met at all.
pub(super) fn lands<S: Scalar>(
    passage: &Passage,
    mover: &Outline<S>,
    platform: &Body<S>,
    slot: u16,
    hit: Hit<S>,
) -> Option<Hit<S>> {
    let zero = S::Real::ZERO;
    if passage.drops {
        return None;
    }
    let depth = (mover.centre.y + mover.half.y).saturating_sub(platform.top());
    let risen = (-S::in_a_step(platform.velocity.y)).greater(zero);
    let stands = passage.footing == Some(slot);
    if depth > risen && !stands {
        return None;
    }
    if hit.depth > zero {
        return Some(Hit { normal: vec2(S::Unit::ZERO, -S::UNIT), depth, ..hit });
    }
    // Steeper is the platform's side.
    let faces_up = -S::length_times(S::ONE, hit.normal.y) >= S::real(ratio(1, 10));
    faces_up.then_some(hit)
}
