//! Every scene builds, fits the room that it asks for, and ends in the same bits everywhere.

use fixed::types::I16F16;
use flat_physics::{Effects, Error, Fixed, Level, Quantity, Scalar, Statistics, Storage, Vec2, World, digest, step};
use flat_scenes::{BuildError, Capacity, Cue, Memory, Mix, Order, Parameters, SCENES, Scene, Variant, find};

/// Steps that tell one solver from another.
const SHORT: u32 = 600;

/// A scene as it was built.
fn built<'a, S: Scalar, const BODIES: usize, const CONTACTS: usize, const TILES: usize>(
    storage: &'a mut Storage<S, BODIES, CONTACTS, TILES>,
    scene: &Scene,
    parameters: &Parameters,
    level: Level,
) -> World<'a, S> {
    let mut world = storage.world();
    scene.build(parameters, level, &mut world).unwrap_or_else(|error| panic!("{}: {error}", scene.name));
    world
}

fn advance<S: Scalar>(world: &mut World<'_, S>, scene: &Scene, parameters: &Parameters, steps: u32) {
    let mut memory = Memory::default();
    for number in 1..=steps {
        let directed = scene.direct(parameters, Cue::unattended(number), &mut memory, world);
        directed.unwrap_or_else(|error| panic!("{} step {number}: {error}", scene.name));
        step(world, scene.effects);
    }
}

/// Runs a scene; its digest at the end and the world's counters.
fn run<S: Scalar>(scene: &Scene, parameters: &Parameters, level: Level) -> (u64, Statistics) {
    let mut storage = Box::new(Storage::<S, 512, 4096, 2048>::new());
    let mut world = built(&mut storage, scene, parameters, level);
    advance(&mut world, scene, parameters, scene.steps.min(SHORT));
    (digest(&world), world.statistics())
}

/// Bits of all bodies by their number, with the scene's shift taken off.
fn state(scene: &Scene, parameters: &Parameters, steps: u32) -> Vec<(u32, [i64; 4], Vec2<i16>)> {
    let mut storage = Box::new(Storage::<Fixed, 512, 4096, 2048>::new());
    let mut world = built(&mut storage, scene, parameters, Level::Grounded);
    advance(&mut world, scene, parameters, steps);
    let origin = parameters.variant.origin();
    let mut bodies: Vec<_> = world
        .bodies()
        // All but what stands for the tiles.
        .filter(|body| body.enabled)
        .map(|body| {
            let (position, velocity) = (body.position - origin, body.velocity);
            let bits = [position.x.bits(), position.y.bits(), velocity.x.bits(), velocity.y.bits()];
            (body.user_data, bits, body.remainder)
        })
        .collect();
    bodies.sort_unstable_by_key(|(number, ..)| *number);
    bodies
}

/// The digests after a usual run, or the first ten seconds of one, as computed on x86-64 and on rv32imc. A change of the
/// solver changes them.
#[test]
fn usual_runs_end_in_the_known_digests() {
    let lines = SCENES.iter().map(|scene| {
        let parameters = &scene.defaults;
        let (fixed, _) = run::<Fixed>(scene, parameters, Level::Grounded);
        let (f32, _) = run::<f32>(scene, parameters, Level::Grounded);
        let (f64, _) = run::<f64>(scene, parameters, Level::Grounded);
        format!("{:16} {fixed:016x} {f32:016x} {f64:016x}", scene.name)
    });
    let table = lines.collect::<Vec<_>>().join("\n") + "\n";
    let title = "Scene, and the digest of its state in fixed point, binary32 and binary64\n";
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/digests.txt");
    if std::env::var_os("FLAT_BLESS").is_some() {
        std::fs::write(path, format!("{title}{table}")).unwrap();
    }
    let known = std::fs::read_to_string(path).unwrap();
    assert_eq!(known, format!("{title}{table}"), "FLAT_BLESS=1 cargo test -p flat-scenes writes the new table");
}

#[test]
fn the_room_that_a_scene_asks_for_is_enough() {
    for scene in SCENES {
        for bodies in [*scene.bodies.start(), 7, 60, 200].into_iter().filter(|bodies| scene.bodies.contains(bodies)) {
            for (level, order) in [
                (Level::Flat, Order::Forward),
                (Level::Grounded, Order::Forward),
                (Level::Grounded, Order::Shuffled),
                (Level::Exact, Order::Forward),
            ] {
                let parameters = scene.parameters(Some(bodies), Some(3), order).unwrap();
                let Capacity { bodies, contacts } = scene.capacity(&parameters, level);
                let (_, statistics) = run::<Fixed>(scene, &parameters, level);
                assert_eq!(statistics.bodies, bodies, "{} {parameters:?}", scene.name);
                assert!(
                    statistics.contacts_peak <= contacts,
                    "{} {level:?} {parameters:?}: {statistics:?}",
                    scene.name
                );
                assert_eq!((statistics.contacts_lost, statistics.escaped, statistics.saturations), (0, 0, 0));
            }
        }
    }
}

#[test]
fn a_scene_calls_for_what_its_bodies_need_and_for_what_bodies_cannot_say() {
    // No body and no setting tells whether the game wants these.
    let unsaid = [Effects::DAMPING, Effects::SPEED_CAP, Effects::CCD, Effects::SLEEP, Effects::EVENTS]
        .into_iter()
        .reduce(Effects::and);
    for scene in SCENES {
        let mut storage = Box::new(Storage::<Fixed, 512, 4096, 2048>::new());
        let world = built(&mut storage, scene, &scene.defaults, Level::Grounded);
        assert_eq!(world.called_for(), scene.effects.without(unsaid.unwrap()), "{}", scene.name);
    }
}

#[test]
fn an_order_changes_no_bit_of_any_scene() {
    // Nothing but their slots tells coincident bodies from each other.
    let coincident = ["coincident", "overlapping"];
    for scene in SCENES.iter().filter(|scene| !coincident.contains(&scene.name)) {
        let end = |order| {
            let parameters = scene.parameters(None, Some(3), order).unwrap();
            state(scene, &parameters, 200)
        };
        let forward = end(Order::Forward);
        assert_eq!(forward, end(Order::Reverse), "{}", scene.name);
        assert_eq!(forward, end(Order::Shuffled), "{}", scene.name);
    }
}

#[test]
fn a_shift_by_whole_px_changes_no_bit_of_any_scene() {
    for scene in SCENES {
        let end = |shift| {
            let parameters = scene.vary(scene.defaults, Variant { shift, ..Variant::NONE }).unwrap();
            state(scene, &parameters, 200)
        };
        let here = end([0, 0]);
        for shift in [[1, -1], [-7_411, 5_333], [9_000, -11_111], [-12_345, 14_000]] {
            assert_eq!(here, end(shift), "{} shifted by {shift:?}", scene.name);
        }
    }
}

#[test]
fn what_a_world_held_before_changes_no_bit_of_any_scene() {
    for level in [Level::Flat, Level::Grounded, Level::Exact] {
        for scene in SCENES {
            let mut storage = Box::new(Storage::<Fixed, 512, 4096, 2048>::new());
            let fresh = {
                let mut world = built(&mut storage, scene, &scene.defaults, level);
                advance(&mut world, scene, &scene.defaults, 60);
                digest(&world)
            };
            // Fast bodies in every slot.
            let shots = find("tile_shots").unwrap();
            let mut world =
                built(&mut storage, shots, &shots.parameters(Some(64), None, Order::Forward).unwrap(), level);
            advance(&mut world, shots, &shots.defaults, 7);
            scene.build(&scene.defaults, level, &mut world).unwrap();
            advance(&mut world, scene, &scene.defaults, 60);
            assert_eq!(fresh, digest(&world), "{} at {level:?}", scene.name);
        }
    }
}

#[test]
fn every_scene_goes_on_from_a_snapshot_as_it_went_on_before() {
    const HALF: u32 = 100;
    let mut moving = 0;
    for scene in SCENES {
        let parameters = &scene.defaults;
        let [mut storage, mut other] = [(); 2].map(|()| Box::new(Storage::<Fixed, 512, 4096, 2048>::new()));
        let (mut world, mut saved) = (built(&mut storage, scene, parameters, Level::Grounded), other.world());
        let mut memory = Memory::default();
        let advance = |world: &mut World<'_, Fixed>, memory: &mut Memory, from: u32| {
            for number in from + 1..=from + HALF {
                scene.direct(parameters, Cue::unattended(number), memory, world).unwrap();
                step(world, scene.effects);
            }
            digest(world)
        };
        advance(&mut world, &mut memory, 0);
        saved.copy_from(&world).unwrap();
        let (kept, before) = (memory, digest(&world));
        let after = advance(&mut world, &mut memory, HALF);
        moving += usize::from(after != before);
        world.copy_from(&saved).unwrap();
        memory = kept;
        assert_eq!(advance(&mut world, &mut memory, HALF), after, "{}", scene.name);
    }
    assert!(moving > SCENES.len() / 2, "most still move then: {moving}");
}

#[test]
fn a_seed_changes_a_pit() {
    let pit = find("ball_pit").unwrap();
    let end = |seed| state(pit, &pit.parameters(Some(40), Some(seed), Order::Forward).unwrap(), 200);
    assert_ne!(end(1), end(2));
}

#[test]
fn bodies_start_apart_unless_that_is_the_point() {
    // In a pit, balls of 7 px start on a lattice of 14 px, give or take one.
    let pressed = ["coincident", "overlapping", "projectile", "ball_pit_mixed"];
    for scene in SCENES.iter().filter(|scene| !pressed.contains(&scene.name)) {
        for parameters in scene.battery().iter().filter(|parameters| parameters.variant.mix != Mix::Sizes) {
            let mut storage = Box::new(Storage::<Fixed, 512, 4096, 2048>::new());
            let mut world = built(&mut storage, scene, parameters, Level::Flat);
            flat_physics::Stage::Detect.run(&mut world, scene.effects);
            let deepest = world.contacts().map(|contact| contact.penetration).max().unwrap_or_default();
            assert!(deepest <= I16F16::ZERO, "{} {parameters:?}: {deepest}", scene.name);
        }
    }
}

#[test]
fn a_battery_has_room_for_all_its_runs_and_none_runs_twice() {
    for scene in SCENES {
        let battery = scene.battery();
        assert!(!battery.is_full(), "{}", scene.name);
        for (place, parameters) in battery.iter().enumerate() {
            assert!(!battery[..place].contains(parameters), "{} {parameters:?}", scene.name);
        }
    }
}

#[test]
fn what_a_scene_cannot_be_varied_by_is_refused_in_words() {
    let cradle = find("cradle").unwrap();
    let refused = |variant| cradle.vary(cradle.defaults, variant).unwrap_err().to_string();
    assert_eq!(refused(Variant { gravity: Some(100), ..Variant::NONE }), "cradle: its gravity is fixed");
    assert_eq!(refused(Variant { mix: Mix::Sizes, ..Variant::NONE }), "cradle: its bodies cannot be mixed that way");
    let drop = find("drop").unwrap();
    let error = drop.vary(drop.defaults, Variant { gap: 1, ..Variant::NONE }).unwrap_err();
    assert_eq!(error.to_string(), "drop: there is no room for a gap");
}

#[test]
fn a_shift_out_of_the_world_is_refused_by_body() {
    let drop = find("drop").unwrap();
    let far = drop.vary(drop.defaults, Variant { shift: [i16::MAX, 0], ..Variant::NONE }).unwrap();
    let mut storage = Storage::<Fixed, 8, 16>::new();
    let error = drop.build(&far, Level::Grounded, &mut storage.world()).unwrap_err();
    assert!(error.to_string().starts_with("body 0: position.x is 32"), "{error}");
}

#[test]
fn a_world_that_is_too_small_keeps_what_it_has() {
    let mut storage = Storage::<Fixed, 8, 8>::new();
    let mut world = storage.world();
    let drop = find("drop").unwrap();
    let one = drop.parameters(Some(1), None, Order::Forward).unwrap();
    assert_eq!(
        drop.build(&one, Level::Flat, &mut world),
        Err(BuildError::Capacity {
            needed: Capacity { bodies: 2, contacts: 25 },
            available: Capacity { bodies: 8, contacts: 8 },
        })
    );
    let def = drop.body(&one, 1);
    world.spawn(&def).unwrap();
    let before = digest(&world);
    drop.build(&one, Level::Flat, &mut world).unwrap_err();
    assert_eq!(digest(&world), before);
}

#[test]
fn a_body_count_outside_the_range_is_refused_by_name() {
    let drop = find("drop").unwrap();
    let error = drop.parameters(Some(201), None, Order::Forward).unwrap_err();
    assert_eq!(error.to_string(), "drop: bodies is 201, must be 1..=200");
    assert!(find("Drop").is_none());
}

#[test]
fn build_errors_name_the_body() {
    let error = BuildError::<Fixed>::Body { number: 3, error: Error::Full { capacity: 2 } };
    assert_eq!(error.to_string(), "body 3: all 2 body slots are taken");
}
