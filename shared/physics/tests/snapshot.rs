//! A copy of a world goes through the same states as the original.

mod meddling;

use flat_physics::scalar::px;
use flat_physics::{BodyDef, Effects, Error, Event, Fixed, Shape, Statistics, Storage, World, digest, step, vec2};
use proptest::prelude::*;

use meddling::Act;

/// Everything that can be told of the steps after some acts.
#[derive(Debug, PartialEq)]
struct Record {
    digests: Vec<u64>,
    events: Vec<Event<Fixed>>,
    statistics: Statistics,
    called_for: Effects,
}

fn play(world: &mut World<'_, Fixed>, acts: &[Act]) -> Record {
    let (mut digests, mut events) = (Vec::new(), Vec::new());
    for act in acts {
        act.perform(world);
        for _ in 0..act.steps {
            step(world, Effects::ALL);
            digests.push(digest(world));
            events.extend(world.events());
        }
    }
    Record { digests, events, statistics: world.statistics(), called_for: world.called_for() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, ..ProptestConfig::default() })]

    #[test]
    fn restored_worlds_repeat_themselves(before in meddling::acts(), after in meddling::acts()) {
        let [mut storage, mut other] = [Storage::<Fixed, 12, 64>::new(), Storage::new()];
        let (mut world, mut saved) = (storage.world(), other.world());
        // What the snapshot held before doesn't matter.
        meddling::build(&mut saved);
        play(&mut saved, &after);

        meddling::build(&mut world);
        play(&mut world, &before);
        saved.copy_from(&world).unwrap();
        let first = play(&mut world, &after);
        world.copy_from(&saved).unwrap();
        prop_assert_eq!(&play(&mut world, &after), &first);
        prop_assert_eq!(&play(&mut saved, &after), &first, "the copy itself");
    }
}

#[test]
fn a_copy_keeps_settings_declarations_and_handles() {
    let [mut storage, mut other] = [Storage::<Fixed, 4, 8>::new(), Storage::new()];
    let (mut world, mut saved) = (storage.world(), other.world());
    let def = BodyDef::rigid(Shape::Circle { radius: px(6) }, vec2(px(0), px(0)));
    let gone = world.spawn(&def).unwrap();
    world.despawn(gone).unwrap();
    let body = world.spawn(&def).unwrap();
    let config = flat_physics::Config { gravity: vec2(px(3), px(-5)), ..*world.config() };
    world.configure(config).unwrap();
    world.declare(world.called_for()).unwrap();
    saved.copy_from(&world).unwrap();
    assert_eq!(*saved.config(), config);
    assert_eq!(saved.definition(body), world.definition(body));
    assert_eq!(saved.body(gone), Err(Error::NoSuchBody { handle: gone }));
    assert!(matches!(saved.set_sensor(body, true), Err(Error::Undeclared { .. })));
    assert_eq!(saved.spawn(&def), world.spawn(&def));
}

#[test]
fn worlds_of_other_sizes_are_refused() {
    let mut storage = Storage::<Fixed, 4, 8>::new();
    let mut world = storage.world();
    world.spawn(&BodyDef::rigid(Shape::Circle { radius: px(6) }, vec2(px(0), px(0)))).unwrap();
    let before = digest(&world);
    let (mut fewer, mut flatter) = (Storage::<Fixed, 3, 8>::new(), Storage::<Fixed, 4, 7>::new());
    for other in [fewer.world(), flatter.world()] {
        assert!(matches!(world.copy_from(&other), Err(Error::Size { own: (4, 8), .. })));
    }
    let error = flatter.world().copy_from(&world).unwrap_err();
    assert_eq!(error.to_string(), "a world for 4 bodies and 7 contacts can't become a copy of one for 4 and 8");
    assert_eq!(digest(&world), before);
}
