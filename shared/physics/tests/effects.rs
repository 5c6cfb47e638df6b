//! A world knows which effects its data call for; one that has declared its effects refuses what calls for more; and what is off
//! acts as if its inputs were neutral.

use flat_physics::scalar::{px, ratio};
use flat_physics::tiles::{BehaviorLayer, TileFlags};
use flat_physics::world::Terrain;
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

/// Bodies as numbers: where they are, how fast, and whether they are round.
type Heap = [(i16, i16, i16, bool)];

/// Builds a heap with settings and bodies changed, lets something happen before each of its steps, and looks at it after each.
fn run_with<T>(
    heap: &Heap,
    effects: Effects,
    config: impl Fn(&mut Config<Fixed>),
    body: impl Fn(&mut BodyDef<Fixed>),
    before: impl Fn(u32, &mut World<'_, Fixed>),
    look: impl Fn(&World<'_, Fixed>) -> T,
) -> Vec<T> {
    let mut storage = Storage::<Fixed, 24, 256, 16>::new();
    let mut world = storage.world();
    let mut settings = Config::default();
    config(&mut settings);
    world.configure(settings).unwrap();
    let material = Material { restitution: ratio(1, 2), bounce: true, friction: ratio(1, 4) };
    let floor = BodyDef::fixed(Shape::Box { half: vec2(px(100), px(5)) }, vec2(px(0), px(60)));
    let defs = heap.iter().map(|&(x, y, v, circle)| {
        let shape = if circle { Shape::Circle { radius: px(4) } } else { Shape::Box { half: vec2(px(4), px(3)) } };
        BodyDef { velocity: vec2(px(v), px(-v / 2)), ..BodyDef::rigid(shape, vec2(px(x), px(y))) }
    });
    for def in core::iter::once(floor).chain(defs) {
        let mut def = BodyDef { material, ..def };
        body(&mut def);
        world.spawn(&def).unwrap();
    }
    let steps = (0..90).map(|number| {
        before(number, &mut world);
        step(&mut world, effects);
        look(&world)
    });
    steps.collect()
}

/// The digests of a heap.
fn run(
    heap: &Heap,
    effects: Effects,
    config: impl Fn(&mut Config<Fixed>),
    body: impl Fn(&mut BodyDef<Fixed>),
) -> Vec<u64> {
    run_with(heap, effects, config, body, |_, _| (), digest)
}

/// Where the bodies of a heap are and how fast: for comparing bodies that are defined differently.
fn moves(
    heap: &Heap,
    effects: Effects,
    body: impl Fn(&mut BodyDef<Fixed>),
    before: impl Fn(u32, &mut World<'_, Fixed>),
) -> Vec<impl PartialEq + core::fmt::Debug> {
    run_with(
        heap,
        effects,
        |_| (),
        body,
        before,
        |world| {
            let bodies = world.bodies().filter(|body| body.enabled);
            bodies.map(|body| (body.position, body.velocity, body.remainder)).collect::<Vec<_>>()
        },
    )
}

fn heap() -> impl Strategy<Value = Vec<(i16, i16, i16, bool)>> {
    prop::collection::vec((-40i16..40, -40i16..50, -900i16..900, any::<bool>()), 1..15)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, ..ProptestConfig::default() })]

    #[test]
    fn an_effect_that_is_off_acts_as_if_its_inputs_were_neutral(heap in heap()) {
        let as_is = |_: &mut Config<Fixed>| ();
        let whole = |_: &mut BodyDef<Fixed>| ();
        let all = Effects::ALL;
        let off = |effect| run(&heap, all.without(effect), as_is, whole);
        let weightless = run(&heap, all, |config| config.gravity = Vec2::default(), whole);
        let sideways = |config: &mut Config<Fixed>| config.gravity = vec2(px(-300), px(0));
        prop_assert_eq!(&off(Effects::GRAVITY), &weightless);
        prop_assert_eq!(&run(&heap, all.without(Effects::GRAVITY), sideways, whole), &weightless);
        prop_assert_eq!(off(Effects::DAMPING), run(&heap, all, |config| config.damping = px(1), whole));
        prop_assert_eq!(off(Effects::FRICTION), run(&heap, all, as_is, |def| def.material.friction = px(0)));
        prop_assert_eq!(off(Effects::BOUNCE), run(&heap, all, as_is, |def| def.material.bounce = false));
        prop_assert_eq!(off(Effects::SPEED_CAP), run(&heap, all, |config| config.speed_cap = px(7620), whole));
        prop_assert_eq!(off(Effects::CCD), run(&heap, all, |config| config.ccd_threshold = px(16), whole));
        prop_assert_eq!(off(Effects::EVENTS), run(&heap, all, as_is, whole));
        let driven = |moves: bool| move |def: &mut BodyDef<Fixed>| {
            if def.velocity.x > 0 {
                def.kind = Kind::Kinematic;
                def.velocity = if moves { def.velocity } else { Vec2::default() };
            }
        };
        prop_assert_eq!(run(&heap, all.without(Effects::KINEMATIC), as_is, driven(true)), run(&heap, all, as_is, driven(false)));
    }

    #[test]
    fn bodies_are_plain_where_what_makes_them_special_is_off(heap in heap()) {
        let all = Effects::ALL;
        let sensing = |sensor: bool| move |def: &mut BodyDef<Fixed>| def.sensor = sensor && def.velocity.x > 0;
        let untouched = |_: u32, _: &mut World<'_, Fixed>| ();
        prop_assert_eq!(
            moves(&heap, all.without(Effects::SENSORS), sensing(true), untouched),
            moves(&heap, all, sensing(false), untouched)
        );
        let holding = |one_way: bool| move |def: &mut BodyDef<Fixed>| {
            if def.velocity.x > 0 {
                *def = BodyDef { kind: Kind::Static, velocity: Vec2::default(), one_way, ..*def };
            }
        };
        prop_assert_eq!(
            moves(&heap, all.without(Effects::ONE_WAY), holding(true), untouched),
            moves(&heap, all, holding(false), untouched)
        );
    }

    #[test]
    fn a_map_of_tiles_is_empty_as_far_as_its_effects_are_off(heap in heap()) {
        let lay = |solid: u8, one_way: u8, sensor: u8| move |number: u32, world: &mut World<'_, Fixed>| {
            if number == 0 {
                // Beside a solid tile, a one-way tile would also make its corner a seam.
                let tiles = [solid, 0, one_way, sensor, one_way, 0, solid, sensor];
                let terrain = Terrain { origin: vec2(-64, 10), ..Terrain::DEFAULT };
                world.set_tiles(&BehaviorLayer::new(&tiles, 8, 1).unwrap(), &terrain).unwrap();
            }
        };
        let [solid, one_way, sensor] = [TileFlags::SOLID, TileFlags::ONE_WAY, TileFlags::SENSOR].map(TileFlags::bits);
        let (all, whole) = (Effects::ALL, |_: &mut BodyDef<Fixed>| ());
        let there = lay(solid, one_way, sensor);
        let without = |effect| moves(&heap, all.without(effect), whole, there);
        prop_assert_eq!(without(Effects::TILES), moves(&heap, all, whole, lay(0, 0, 0)));
        prop_assert_eq!(without(Effects::ONE_WAY), moves(&heap, all, whole, lay(solid, 0, sensor)));
        prop_assert_eq!(without(Effects::SENSORS), moves(&heap, all, whole, lay(solid, one_way, 0)));
    }

    #[test]
    fn nothing_sleeps_that_never_rests(heap in heap()) {
        // A floor that carries everything along.
        let belt = |def: &mut BodyDef<Fixed>| {
            def.material.friction = px(1);
            if def.kind == Kind::Static {
                *def = BodyDef { kind: Kind::Kinematic, velocity: vec2(px(10), px(0)), ..*def };
            }
        };
        let as_is = |_: &mut Config<Fixed>| ();
        prop_assert_eq!(run(&heap, Effects::ALL.without(Effects::SLEEP), as_is, belt), run(&heap, Effects::ALL, as_is, belt));
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
