//! A world knows which effects its data call for; one that has declared its effects refuses what calls for more; and what is off
//! acts as if its inputs were neutral.

use flat_physics::scalar::{px, ratio};
use flat_physics::{
    BodyDef, Config, Effects, Error, Fixed, Kind, Level, Material, Only, Shape, Storage, Switches, Vec2, World, digest,
    step, vec2,
};
use proptest::prelude::*;

const DULL: Material<Fixed> = Material { bounce: false, ..Material::DEFAULT };
const ROUGH: Material<Fixed> = Material { friction: ratio(1, 2), ..DULL };

/// A body that calls for nothing.
fn plain() -> BodyDef<Fixed> {
    BodyDef { material: DULL, ..BodyDef::rigid(Shape::Circle { radius: px(4) }, vec2(px(0), px(0))) }
}

/// Bodies that each call for one effect.
fn calling() -> [(Effects, BodyDef<Fixed>); 5] {
    [
        (Effects::BOUNCE, BodyDef { material: Material::DEFAULT, ..plain() }),
        (Effects::FRICTION, BodyDef { material: ROUGH, ..plain() }),
        (Effects::SENSORS, BodyDef { sensor: true, ..plain() }),
        (Effects::ONE_WAY, BodyDef { one_way: true, ..plain() }),
        (Effects::KINEMATIC, BodyDef { kind: Kind::Kinematic, ..plain() }),
    ]
}

/// Turns the body in slot 0 into what a definition says.
fn become_like(world: &mut World<'_, Fixed>, def: &BodyDef<Fixed>) -> Result<(), Error<Fixed>> {
    let body = world.bodies().next().unwrap().handle;
    world.set_material(body, def.material)?;
    world.set_sensor(body, def.sensor)?;
    world.set_one_way(body, def.one_way)?;
    world.set_kind(body, def.kind)
}

/// Settings that each call for one effect besides those in force.
fn settings() -> [(Effects, Config<Fixed>); 4] {
    let calm = Config { gravity: Vec2::default(), ..Config::default() };
    [
        (Effects::GRAVITY, Config::default()),
        (Effects::DAMPING, Config { damping: ratio(1, 2), ..calm }),
        (Effects::SPEED_CAP, Config { speed_cap: px(499), ..calm }),
        (Effects::CCD, Config { ccd_threshold: px(2), ..calm }),
    ]
}

fn calm(storage: &mut Storage<Fixed, 3, 8>) -> World<'_, Fixed> {
    let mut world = storage.world();
    world.configure(Config { gravity: Vec2::default(), ..Config::default() }).unwrap();
    world.spawn(&plain()).unwrap();
    assert_eq!(world.called_for(), Effects::NONE);
    world
}

#[test]
fn every_property_calls_for_its_effect_when_spawned_and_when_set() {
    for (effect, def) in calling() {
        let mut storage = Storage::new();
        let mut world = calm(&mut storage);
        let other = world.spawn(&def).unwrap();
        assert_eq!(world.called_for(), effect);
        world.despawn(other).unwrap();
        assert_eq!(world.called_for(), effect, "what was called for stays");

        let mut world = calm(&mut storage);
        become_like(&mut world, &def).unwrap();
        assert_eq!(world.called_for(), effect);
    }
    for (effect, config) in settings() {
        let mut storage = Storage::new();
        let mut world = calm(&mut storage);
        world.configure(config).unwrap();
        assert_eq!(world.called_for(), effect);
    }
}

#[test]
fn no_level_calls_for_anything_by_itself() {
    for level in [Level::Flat, Level::Grounded, Level::Exact] {
        assert_eq!(Config::<Fixed>::at(level).called_for(), Effects::GRAVITY);
    }
}

#[test]
fn what_is_not_declared_is_refused_by_name_and_changes_nothing() {
    let mut storage = Storage::new();
    for (effect, def) in calling() {
        let mut world = calm(&mut storage);
        let declared = Effects::ALL.without(effect);
        world.declare(declared).unwrap();
        let before = (digest(&world), world.definition(world.bodies().next().unwrap().handle));
        let refused = |slot| Error::Undeclared { slot: Some(slot), missing: effect, declared };
        assert_eq!(world.spawn(&def), Err(refused(1)));
        assert_eq!(become_like(&mut world, &def), Err(refused(0)));
        assert_eq!((digest(&world), world.definition(world.bodies().next().unwrap().handle)), before);
        assert_eq!(world.called_for(), Effects::NONE);
        world.spawn(&plain()).unwrap();

        world.clear();
        world.spawn(&def).unwrap();
    }
    for (effect, config) in settings() {
        let mut world = calm(&mut storage);
        let declared = Effects::ALL.without(effect);
        world.declare(declared).unwrap();
        let before = *world.config();
        assert_eq!(world.configure(config), Err(Error::Undeclared { slot: None, missing: effect, declared }));
        assert_eq!(*world.config(), before);
    }
}

#[test]
fn nothing_is_declared_that_the_world_calls_for_already() {
    let mut storage = Storage::new();
    for (effect, def) in calling() {
        let mut world = calm(&mut storage);
        let other = world.spawn(&def).unwrap();
        let declared = Effects::ALL.without(effect);
        assert_eq!(world.declare(declared), Err(Error::Undeclared { slot: Some(1), missing: effect, declared }));
        world.spawn(&def).map(|another| world.despawn(another)).unwrap().unwrap();
        world.declare(effect).unwrap();
        world.despawn(other).unwrap();
        world.declare(declared).unwrap();
        assert_eq!(world.called_for(), Effects::NONE, "nobody calls for it any more");
    }
    for (effect, config) in settings() {
        let mut world = calm(&mut storage);
        world.configure(config).unwrap();
        let error = world.declare(Effects::NONE).unwrap_err();
        let expected =
            format!("the settings call for {effect}, but only none is declared: declare {effect} too, or do without");
        assert_eq!(error.to_string(), expected);
    }
}

#[test]
fn sets_are_what_their_bits_say() {
    const SET: Only<{ Effects::GRAVITY.and(Effects::CCD).bits() }> = Only;
    assert_eq!((SET.effects(), SET.level()), (Effects::GRAVITY | Effects::CCD, None));
    assert_eq!(Only::<0, { Level::Exact as u8 }>.level(), Some(Level::Exact));
    assert_eq!(Effects::from_bits(Effects::ALL.bits()), Some(Effects::ALL));
    assert_eq!(Effects::from_bits(Effects::ALL.bits() + 1), None);
    assert_eq!((Effects::GRAVITY | Effects::TILES).to_string(), "gravity + tiles");
    assert_eq!(Effects::NONE.to_string(), "none");
}

/// Builds a heap from numbers and tells its digests, with settings and bodies changed.
fn run(
    bodies: &[(i16, i16, i16, bool)],
    effects: Effects,
    config: impl Fn(&mut Config<Fixed>),
    body: impl Fn(&mut BodyDef<Fixed>),
) -> Vec<u64> {
    let mut storage = Storage::<Fixed, 16, 128>::new();
    let mut world = storage.world();
    let mut settings = Config::default();
    config(&mut settings);
    world.configure(settings).unwrap();
    let material = Material { restitution: ratio(1, 2), bounce: true, friction: ratio(1, 4) };
    let floor = BodyDef::fixed(Shape::Box { half: vec2(px(100), px(5)) }, vec2(px(0), px(60)));
    let defs = bodies.iter().map(|&(x, y, v, circle)| {
        let shape = if circle { Shape::Circle { radius: px(4) } } else { Shape::Box { half: vec2(px(4), px(3)) } };
        BodyDef { velocity: vec2(px(v), px(-v / 2)), ..BodyDef::rigid(shape, vec2(px(x), px(y))) }
    });
    for def in core::iter::once(floor).chain(defs) {
        let mut def = BodyDef { material, ..def };
        body(&mut def);
        world.spawn(&def).unwrap();
    }
    (0..90).map(|_| (step(&mut world, effects), digest(&world)).1).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, ..ProptestConfig::default() })]

    #[test]
    fn an_effect_that_is_off_acts_as_if_its_inputs_were_neutral(
        bodies in prop::collection::vec((-40i16..40, -40i16..50, -900i16..900, any::<bool>()), 1..15),
    ) {
        let as_is = |_: &mut Config<Fixed>| ();
        let whole = |_: &mut BodyDef<Fixed>| ();
        let all = Effects::ALL;
        let off = |effect| run(&bodies, all.without(effect), as_is, whole);
        let weightless = run(&bodies, all, |config| config.gravity = Vec2::default(), whole);
        let sideways = |config: &mut Config<Fixed>| config.gravity = vec2(px(-300), px(0));
        prop_assert_eq!(&off(Effects::GRAVITY), &weightless);
        prop_assert_eq!(&run(&bodies, all.without(Effects::GRAVITY), sideways, whole), &weightless);
        prop_assert_eq!(off(Effects::DAMPING), run(&bodies, all, |config| config.damping = px(1), whole));
        prop_assert_eq!(off(Effects::FRICTION), run(&bodies, all, as_is, |def| def.material.friction = px(0)));
        prop_assert_eq!(off(Effects::BOUNCE), run(&bodies, all, as_is, |def| def.material.bounce = false));
        prop_assert_eq!(off(Effects::EVENTS), run(&bodies, all, as_is, whole));
        let driven = |moves: bool| move |def: &mut BodyDef<Fixed>| {
            if def.velocity.x > 0 {
                def.kind = Kind::Kinematic;
                def.velocity = if moves { def.velocity } else { Vec2::default() };
            }
        };
        prop_assert_eq!(run(&bodies, all.without(Effects::KINEMATIC), as_is, driven(true)), run(&bodies, all, as_is, driven(false)));
        // These find nothing to do here.
        for effect in [Effects::SENSORS, Effects::ONE_WAY, Effects::TILES] {
            prop_assert_eq!(off(effect), run(&bodies, all, as_is, whole), "{}", effect);
        }
    }
}

#[test]
fn a_declared_level_is_the_only_one() {
    const GROUNDED: Only<{ Effects::GRAVITY.bits() }, { Level::Grounded as u8 }> = Only;
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.declare(GROUNDED).unwrap();
    let error = world.configure(Config::at(Level::Flat)).unwrap_err();
    assert_eq!(error, Error::OtherLevel { configured: Level::Flat, declared: Level::Grounded });
    assert!(error.to_string().contains("level Flat, but only Grounded is declared"), "{error}");
    world.configure(Config { gravity: vec2(px(0), px(100)), ..Config::default() }).unwrap();
    world.clear();
    world.configure(Config::at(Level::Exact)).unwrap();
    assert_eq!(
        world.declare(GROUNDED).unwrap_err(),
        Error::OtherLevel { configured: Level::Exact, declared: Level::Grounded }
    );
}
