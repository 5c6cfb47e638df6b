//! Every scene builds, fits the room that it asks for, and ends in the same bits everywhere.

use fixed::types::I16F16;
use flat_physics::{Error, Fixed, Level, Scalar, Statistics, Storage, digest, step};
use flat_scenes::{BuildError, Capacity, Order, Parameters, Promise, SCENES, Scene, find};

/// Runs a scene; its digest at the end and the world's counters.
fn run<S: Scalar>(scene: &Scene, parameters: &Parameters, steps: u32) -> (u64, Statistics) {
    let mut storage = Box::new(Storage::<S, 512, 4096>::new());
    let mut world = storage.world();
    scene.build(parameters, &mut world).unwrap_or_else(|error| panic!("{}: {error}", scene.name));
    for _ in 0..steps {
        step(&mut world, scene.effects);
    }
    (digest(&world), world.statistics())
}

/// The digests after a usual run, as computed on x86-64 and on rv32imc. A change of the solver changes them: then the
/// failure prints the new line.
#[test]
fn usual_runs_end_in_the_known_digests() {
    let known = [
        ("drop", [0x4fc5_83a9_8a11_9e3b, 0x7e3b_1f24_32e6_1f8c, 0x8ab0_fc7e_d7d3_0279]),
        ("bounce", [0xc0f1_586d_9253_6334, 0xda0f_11f9_d3a5_379a, 0xca25_b215_5648_6224]),
        ("ball_pit", [0x431a_1790_b012_2040, 0xce58_d4f2_1f34_7259, 0x7fce_cb82_ca5c_709e]),
        ("crate_columns", [0x656f_6056_00a8_c4f6, 0x683e_a1a6_2b45_c516, 0xbd82_6604_1852_1906]),
    ];
    assert_eq!(known.map(|(name, _)| name).to_vec(), SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>());
    let mut wrong = Vec::new();
    for (name, expected) in known {
        let scene = find(name).unwrap();
        let (parameters, steps) = (&scene.defaults, scene.steps);
        let got = [
            run::<Fixed>(scene, parameters, steps),
            run::<f32>(scene, parameters, steps),
            run::<f64>(scene, parameters, steps),
        ]
        .map(|(digest, _)| digest);
        if got != expected {
            wrong.push(format!("(\"{name}\", {got:#018x?}),"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_room_that_a_scene_asks_for_is_enough() {
    for scene in SCENES {
        for bodies in [*scene.bodies.start(), 7, 60, 200].into_iter().filter(|bodies| scene.bodies.contains(bodies)) {
            for order in [Order::Forward, Order::Shuffled] {
                let parameters = scene.parameters(Some(bodies), Some(3), order).unwrap();
                let Capacity { bodies, contacts } = (scene.capacity)(&parameters);
                let (_, statistics) = run::<Fixed>(scene, &parameters, 600);
                assert_eq!(statistics.bodies, bodies, "{} {parameters:?}", scene.name);
                assert!(statistics.contacts_peak <= contacts, "{} {parameters:?}: {statistics:?}", scene.name);
                assert_eq!((statistics.contacts_lost, statistics.escaped, statistics.saturations), (0, 0, 0));
            }
        }
    }
}

#[test]
fn a_scene_calls_for_what_its_bodies_need_and_for_nothing_else() {
    for scene in SCENES {
        let mut storage = Box::new(Storage::<Fixed, 512, 4096>::new());
        let mut world = storage.world();
        scene.build(&scene.defaults, &mut world).unwrap();
        assert_eq!(world.called_for(), scene.effects, "{}", scene.name);
    }
}

#[test]
fn a_seed_changes_a_pit_and_an_order_does_not() {
    let pit = find("ball_pit").unwrap();
    let end = |seed, order| {
        let parameters = pit.parameters(Some(40), Some(seed), order).unwrap();
        let mut storage = Box::new(Storage::<Fixed, 64, 512>::new());
        let mut world = storage.world();
        pit.build(&parameters, &mut world).unwrap();
        for _ in 0..200 {
            step(&mut world, pit.effects);
        }
        let mut places: Vec<_> = pit
            .spawn_order(&parameters)
            .zip(world.bodies())
            .map(|(number, body)| (number, body.position.x, body.position.y))
            .collect();
        places.sort_unstable();
        places
    };
    assert_ne!(end(1, Order::Forward), end(2, Order::Forward));
    assert_eq!(end(1, Order::Forward), end(1, Order::Reverse));
    assert_eq!(end(1, Order::Forward), end(1, Order::Shuffled));
}

#[test]
fn bodies_start_apart_and_inside_the_promised_room() {
    for scene in SCENES {
        let parameters = scene.parameters(None, Some(9), Order::Forward).unwrap();
        let mut storage = Box::new(Storage::<Fixed, 512, 4096>::new());
        let mut world = storage.world();
        scene.build(&parameters, &mut world).unwrap();
        flat_physics::Stage::Detect.run(&mut world, scene.effects);
        let deepest = world.contacts().map(|contact| contact.penetration).max().unwrap_or_default();
        assert_eq!(deepest, I16F16::ZERO, "{}", scene.name);
        let promises = scene.promises(&parameters, Level::Flat);
        assert!(promises.iter().any(|promise| matches!(promise, Promise::Within { .. })), "{}", scene.name);
    }
}

#[test]
fn a_world_that_is_too_small_keeps_what_it_has() {
    let mut storage = Storage::<Fixed, 8, 8>::new();
    let mut world = storage.world();
    let drop = find("drop").unwrap();
    let one = drop.parameters(Some(1), None, Order::Forward).unwrap();
    assert_eq!(
        drop.build(&one, &mut world),
        Err(BuildError::Capacity {
            needed: Capacity { bodies: 2, contacts: 10 },
            available: Capacity { bodies: 8, contacts: 8 },
        })
    );
    let def = drop.body(&one, 1);
    world.spawn(&def).unwrap();
    let before = digest(&world);
    drop.build(&one, &mut world).unwrap_err();
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
    let missing = flat_physics::Effects::FRICTION;
    let error = BuildError::<Fixed>::Effect { number: 3, missing };
    assert_eq!(error.to_string(), "body 3 needs friction, which the scene does not call for");
}
