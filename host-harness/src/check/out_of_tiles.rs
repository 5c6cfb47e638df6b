//! A body stays out of the solid tiles.

use fixed::types::I16F16;
use flat_physics::Vec2;

use super::body::{Body, Extent};
use super::penetration::overlap;
use super::worst::Worst;
use super::{Check, Finding, State};

/// The check.
#[derive(Debug)]
pub(super) struct OutOfTiles {
    slot: Option<usize>,
    number: u16,
    tiles: Vec<Body>,
    deepest: Worst,
}

impl OutOfTiles {
    /// The body by slot and by its number in the scene, two corners of each tile, and the limit, px.
    pub(super) fn new(
        slot: Option<usize>,
        number: u16,
        tiles: impl Iterator<Item = [Vec2<I16F16>; 2]>,
        at_most: I16F16,
    ) -> Self {
        let tiles = tiles.map(|[min, max]| {
            let (min, max) = (min.map(f64::from), max.map(f64::from));
            let half = [(max.x - min.x) / 2.0, (max.y - min.y) / 2.0];
            Body::at([min.x + half[0], min.y + half[1]], Extent::Box { half })
        });
        Self { slot, number, tiles: tiles.collect(), deepest: Worst::new(f64::from(at_most), "px") }
    }
}

impl Check for OutOfTiles {
    fn observe(&mut self, &State { step, bodies, .. }: &State<'_>) {
        let Some(body) = self.slot.and_then(|slot| bodies.get(slot)).filter(|body| body.present) else {
            return;
        };
        for tile in &self.tiles {
            let [x, y] = body.position;
            self.deepest.take(step, overlap(body, tile).max(0.0), || format!("deep at ({x:.3}, {y:.3})"));
        }
    }

    fn finding(&self) -> Finding {
        self.deepest.finding(
            format!("body {} stays out of the tiles", self.number),
            "at most as deep as this in any solid tile, at every step".into(),
            "the scene has no solid tile, or no such body",
        )
    }
}

#[cfg(test)]
mod tests {
    use flat_physics::scalar::{px, ratio};
    use flat_physics::vec2;

    use super::*;
    use crate::check::Outcome;

    fn outcome(position: [f64; 2]) -> Outcome {
        let tiles = [[vec2(px(16), px(0)), vec2(px(32), px(16))], [vec2(px(32), px(0)), vec2(px(48), px(16))]];
        let mut check = OutOfTiles::new(Some(0), 0, tiles.into_iter(), ratio(1, 10));
        let body = Body::at(position, Extent::Box { half: [5.0, 7.0] });
        check.observe(&State { step: 1, bodies: &[body], contacts: &[] });
        check.finding().outcome
    }

    #[test]
    fn touching_holds_and_reaching_in_fails_in_any_tile() {
        assert_eq!(outcome([32.0, -7.0]), Outcome::Held);
        assert_eq!(outcome([11.0, 8.0]), Outcome::Held);
        assert_eq!(outcome([32.0, -6.5]), Outcome::Failed);
        assert_eq!(outcome([52.0, 8.0]), Outcome::Failed);
    }

    #[test]
    fn a_scene_without_tiles_is_no_pass() {
        let check = OutOfTiles::new(Some(0), 0, [].into_iter(), px(0));
        assert_eq!(check.finding().outcome, Outcome::Untested);
    }
}
