//! Any bodies, any motions: nothing is entered, nothing overflows.

use flat_physics::geometry::{Outline, overlaps, penetration};
use flat_physics::scalar::px;
use flat_physics::{BodyDef, Fixed, Shape, SlideOptions, Storage, Vec2, vec2};
use proptest::prelude::*;

use crate::{Real, at};

/// A shape of some px, not always whole.
fn shape() -> impl Strategy<Value = Shape<Fixed>> {
    (1 << 14..20 << 16, 1 << 14..20 << 16, any::<bool>()).prop_map(|(w, h, circle)| {
        let (w, h) = (Real::from_bits(w), Real::from_bits(h));
        if circle { Shape::Circle { radius: w } } else { Shape::Box { half: vec2(w, h) } }
    })
}

fn spot(spread: i32) -> impl Strategy<Value = Vec2<Real>> {
    let coordinate = move || prop_oneof![-spread..spread, (-spread >> 16..spread >> 16).prop_map(|whole| whole << 16)];
    (coordinate(), coordinate()).prop_map(|(x, y)| vec2(Real::from_bits(x), Real::from_bits(y)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn nothing_solid_is_ever_entered(
        hero in shape(),
        solids in prop::collection::vec((shape(), spot(150 << 16)), 1..20),
        velocities in prop::collection::vec(spot(4000 << 16), 1..30),
    ) {
        let mut storage = Box::new(Storage::<Fixed, 32, 64>::new());
        let mut world = storage.world();
        let body = world.spawn(&BodyDef::kinematic(hero, at(0, 0))).unwrap();
        let start = Outline::new(&hero, at(0, 0));
        let solids: Vec<_> = solids.iter().map(|(shape, at)| Outline::new(shape, *at)).filter(|solid| !overlaps(&start, solid)).collect();
        for solid in &solids {
            let shape = if solid.circle { Shape::Circle { radius: solid.half.x } } else { Shape::Box { half: solid.half } };
            world.spawn(&BodyDef::fixed(shape, solid.centre)).unwrap();
        }
        // The same, the other way round.
        let mut other_storage = Box::new(Storage::<Fixed, 32, 64>::new());
        let mut other_world = other_storage.world();
        for solid in solids.iter().rev() {
            let shape = if solid.circle { Shape::Circle { radius: solid.half.x } } else { Shape::Box { half: solid.half } };
            other_world.spawn(&BodyDef::fixed(shape, solid.centre)).unwrap();
        }
        let other_body = other_world.spawn(&BodyDef::kinematic(hero, at(0, 0))).unwrap();
        let (mut options, mut other_options) = (SlideOptions::default(), SlideOptions::default());
        for velocity in velocities {
            let slide = world.move_and_slide(body, velocity, &options).unwrap();
            let other = other_world.move_and_slide(other_body, velocity, &other_options).unwrap();
            other_options.footing = other.footing;
            prop_assert_eq!((slide.travel, slide.velocity), (other.travel, other.velocity), "order matters");
            options.footing = slide.footing;
            let position = world.body(body).unwrap().position;
            for solid in &solids {
                // A place beside the way, rounded, may be off by the last place; so may the direction out.
                let depth = penetration(&start.at(position), solid).map_or(px(0), |overlap| overlap.depth);
                prop_assert!(depth <= Real::from_bits(2), "{depth} deep in {solid:?} at {position:?}");
            }
            // What is left of the velocity leads nowhere in.
            let longer = slide.velocity.x.abs() > velocity.x.abs() + velocity.y.abs() || slide.velocity.y.abs() > velocity.x.abs() + velocity.y.abs();
            prop_assert!(!longer, "{velocity:?} became {:?}", slide.velocity);
        }
    }
}

prop_compose! {
    /// Any body at all: small and huge, in the middle and at the ends of the world.
    fn anything()(
        kind in 0..4u8, x in edgy(16_384), y in edgy(16_384), w in edgy(4096), h in edgy(4096), circle: bool, flags in 0..16u8,
    ) -> BodyDef<Fixed> {
        let [w, h] = [w, h].map(|extent| extent.abs().max(Real::from_bits(1)));
        let shape = if circle { Shape::Circle { radius: w } } else { Shape::Box { half: vec2(w, h) } };
        let def = match kind {
            0 => BodyDef::rigid(shape, vec2(x, y)),
            1 => BodyDef::fixed(shape, vec2(x, y)),
            _ => BodyDef::kinematic(shape, vec2(x, y)),
        };
        BodyDef { sensor: flags % 4 == 0, one_way: kind > 0 && flags & 4 != 0, visible: flags != 15, ..def }
    }
}

/// A number up to a limit, often the limit itself or close to 0.
fn edgy(limit: i16) -> impl Strategy<Value = Real> {
    let most = i32::from(limit) << 16;
    prop_oneof![Just(most), Just(-most), -most..=most, (-(8 << 16)..8 << 16), (0u32..30).prop_map(move |n| most >> n)]
        .prop_map(Real::from_bits)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_walk_overflows_at_the_ends_of_the_world(
        defs in prop::collection::vec(anything(), 2..12),
        walks in prop::collection::vec(
            (any::<usize>(), edgy(7620), edgy(7620), edgy(16_384), edgy(16_384), edgy(64), any::<[bool; 2]>()), 1..20,
        ),
    ) {
        let mut storage = Box::new(Storage::<Fixed, 16, 64>::new());
        let mut world = storage.world();
        let bodies: Vec<_> = defs.iter().map(|def| world.spawn(def).unwrap()).collect();
        let mut footing = None;
        for (who, vx, vy, ux, uy, snap, [push, drop_through]) in walks {
            let body = bodies[who % bodies.len()];
            let options = SlideOptions { up: vec2(ux, uy), snap: snap.abs(), push, drop_through, footing };
            if let Ok(slide) = world.move_and_slide(body, vec2(vx, vy), &options) {
                footing = slide.footing;
            }
            let _ = world.move_and_collide(body, vec2(ux, uy));
        }
    }
}
