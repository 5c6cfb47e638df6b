//! Any change of any property at any time.

use flat_physics::{Effects, Fixed, Storage, digest, step};
use proptest::prelude::*;

use crate::meddling;

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// Nothing that a game does to its bodies panics, loses a body or makes two runs differ.
    #[test]
    fn any_meddling_ends_the_same_twice(acts in meddling::acts()) {
        let run = || {
            let mut storage = Storage::<Fixed, 12, 64>::new();
            let mut world = storage.world();
            meddling::build(&mut world);
            for act in &acts {
                let count = world.statistics().bodies;
                let change = act.perform(&mut world);
                assert_eq!(i32::from(world.statistics().bodies) - i32::from(count), change);
                (0..act.steps).for_each(|_| step(&mut world, Effects::ALL));
            }
            assert_eq!(world.bodies().count(), usize::from(world.statistics().bodies));
            digest(&world)
        };
        prop_assert_eq!(run(), run());
    }
}
