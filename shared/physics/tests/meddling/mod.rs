//! Everything that a game may do to a pile of bodies between steps, in any order.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Error, Fixed, Handle, Kind, Material, Shape, World, vec2};
use proptest::prelude::*;

/// One thing that is done, and how many steps follow it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Act {
    /// Which body.
    slot: u16,
    what: u8,
    by: i16,
    /// Steps after it.
    pub(crate) steps: usize,
}

/// Up to 80 acts.
pub(crate) fn acts() -> impl Strategy<Value = Vec<Act>> {
    let act = (0u16..12, 0u8..16, -150i16..150, 0usize..4);
    prop::collection::vec(act.prop_map(|(slot, what, by, steps)| Act { slot, what, by, steps }), 1..80)
}

/// A floor and eight crates on it, in a world of at least 12 bodies.
pub(crate) fn build(world: &mut World<'_, Fixed>) {
    let shape = Shape::Box { half: vec2(px(100), px(5)) };
    world.spawn(&BodyDef::fixed(shape, vec2(px(0), px(5)))).unwrap();
    for n in 0..8 {
        world.spawn(&crate_at(n % 3 * 9 - 9, -6 - n * 9)).unwrap();
    }
}

fn crate_at(x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef::rigid(Shape::Box { half: vec2(px(5), px(5)) }, vec2(px(x), px(y)))
}

impl Act {
    /// Does it, if there is such a body; by how much the number of bodies has changed.
    pub(crate) fn perform(&self, world: &mut World<'_, Fixed>) -> i32 {
        let Some(handle) = world.bodies().map(|body| body.handle).find(|handle| handle.slot() == self.slot) else {
            return 0;
        };
        match (self.what, self.meddle(world, handle)) {
            (13, Ok(())) => -1,
            (14.., Ok(())) => 1,
            (_, Ok(()) | Err(Error::NotRigid { .. } | Error::Full { .. } | Error::OutOfRange { .. })) => 0,
            (_, Err(error)) => panic!("{self:?}: {error}"),
        }
    }

    fn meddle(&self, world: &mut World<'_, Fixed>, handle: Handle) -> Result<(), Error<Fixed>> {
        let by = self.by;
        let place = vec2(px(by % 40), px(-by.abs() % 60));
        let rough = Material { friction: ratio(1, 2), ..Material::DEFAULT };
        let kinds = [Kind::Rigid, Kind::Static, Kind::Kinematic];
        match self.what {
            0 => world.set_position(handle, place),
            1 => world.set_velocity(handle, vec2(px(by), px(-by))),
            2 => world.set_kind(handle, kinds[usize::from(by.unsigned_abs() % 3)]),
            3 if by < 0 => world.set_shape(handle, Shape::Box { half: vec2(px(3), px(6)) }),
            3 => world.set_shape(handle, Shape::Circle { radius: px(4) }),
            4 => world.set_mass(handle, px(1 + by.abs())),
            5 => world.set_material(handle, Material { bounce: by < 0, ..rough }),
            6 => world.set_layer(handle, by.unsigned_abs()),
            7 => world.set_mask(handle, by.unsigned_abs()),
            8 => world.set_sensor(handle, by < 0),
            9 => world.set_visible(handle, by < 0),
            10 => world.set_enabled(handle, by < 0),
            11 => world.apply_impulse(handle, vec2(px(by), px(by))),
            12 => world.apply_force(handle, vec2(px(by), px(by))),
            13 => world.despawn(handle),
            _ => world.spawn(&BodyDef { position: place, ..crate_at(0, 0) }).map(|_| ()),
        }
    }
}
