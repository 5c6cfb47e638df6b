//! Bodies at rest fall asleep in islands, cost nothing then, and wake when, and only when, something happens to them.

mod meddling;

use flat_physics::scalar::{px, ratio};
use flat_physics::tiles::{BehaviorLayer, TileFlags};
use flat_physics::world::Terrain;
use flat_physics::{
    BodyDef, Config, Effects, Fixed, Handle, Kind, Level, Material, Phase, Shape, Storage, World, digest, step, vec2,
};
use proptest::prelude::*;

const ON: Effects = Effects::ALL.without(Effects::DAMPING).without(Effects::SPEED_CAP);
const DULL: Material<Fixed> = Material { bounce: false, friction: ratio(3, 10), ..Material::DEFAULT };

type Room = Storage<Fixed, 20, 64, 8>;

fn floor(x: i16) -> BodyDef<Fixed> {
    BodyDef { material: DULL, ..BodyDef::fixed(Shape::Box { half: vec2(px(40), px(8)) }, vec2(px(x), px(8))) }
}

fn block(x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { material: DULL, ..BodyDef::rigid(Shape::Box { half: vec2(px(5), px(5)) }, vec2(px(x), px(y))) }
}

fn steps(world: &mut World<'_, Fixed>, count: usize) {
    (0..count).for_each(|_| step(world, ON));
}

fn sleeps(world: &World<'_, Fixed>, handle: Handle) -> bool {
    world.body(handle).unwrap().asleep
}

fn asleep(world: &World<'_, Fixed>) -> usize {
    world.bodies().filter(|body| body.asleep).count()
}

/// Two floors 200 px apart with a stack of three crates on each, all asleep.
fn two_stacks(storage: &mut Room) -> (World<'_, Fixed>, [Handle; 8]) {
    let mut world = storage.world();
    let bodies = [0, 200].map(|x| [floor(x), block(x, -5), block(x, -15), block(x, -25)]);
    let handles = bodies.map(|stack| stack.map(|def| world.spawn(&def).unwrap()));
    let handles = handles.concat().try_into().unwrap();
    steps(&mut world, 60);
    assert_eq!(asleep(&world), 6);
    (world, handles)
}

#[test]
fn a_stack_falls_asleep_where_it_stands_and_its_contacts_stay() {
    let mut storage = Room::new();
    let (mut world, _) = two_stacks(&mut storage);
    let before = digest(&world);
    assert_eq!(world.statistics().contacts, 6);
    steps(&mut world, 600);
    assert_eq!(digest(&world), before);
    assert!(world.events().all(|event| event.phase == Phase::Stay));
    assert_eq!(world.events().count(), 6);
}

#[test]
fn whatever_happens_to_a_body_wakes_its_island_and_no_other() {
    type Change = fn(&mut World<'_, Fixed>, [Handle; 4]);
    let changes: [(&str, Change); 21] = [
        ("impulse", |world, [_, body, ..]| world.apply_impulse(body, vec2(px(1), px(0))).unwrap()),
        ("force", |world, [_, body, ..]| world.apply_force(body, vec2(px(1), px(0))).unwrap()),
        ("velocity", |world, [_, .., body]| world.set_velocity(body, vec2(px(1), px(0))).unwrap()),
        ("position", |world, [_, .., body]| world.set_position(body, vec2(px(0), px(-30))).unwrap()),
        ("mass", |world, [_, _, body, _]| world.set_mass(body, px(2)).unwrap()),
        ("shape", |world, [_, _, body, _]| {
            world.set_shape(body, Shape::Circle { radius: px(4) }).unwrap();
        }),
        ("material", |world, [_, _, body, _]| world.set_friction(body, px(1)).unwrap()),
        ("mask", |world, [_, _, body, _]| world.set_mask(body, 2).unwrap()),
        ("gravity scale", |world, [_, _, body, _]| world.set_gravity_scale(body, px(2)).unwrap()),
        ("asking", |world, [_, _, body, _]| world.wake(body).unwrap()),
        ("a body gone", |world, [_, body, ..]| world.despawn(body).unwrap()),
        ("a body hidden", |world, [_, body, ..]| world.set_visible(body, false).unwrap()),
        ("a body disabled", |world, [_, body, ..]| world.set_enabled(body, false).unwrap()),
        ("a body fixed", |world, [_, _, body, _]| world.set_kind(body, Kind::Static).unwrap()),
        ("support gone", |world, [floor, ..]| world.despawn(floor).unwrap()),
        ("support moved", |world, [floor, ..]| world.set_position(floor, vec2(px(0), px(18))).unwrap()),
        ("support hidden", |world, [floor, ..]| world.set_visible(floor, false).unwrap()),
        ("support off", |world, [floor, ..]| world.set_enabled(floor, false).unwrap()),
        ("support on its way", |world, [floor, ..]| {
            world.set_kind(floor, Kind::Kinematic).unwrap();
            world.set_velocity(floor, vec2(px(0), px(-10))).unwrap();
        }),
        ("a wall spawned into it", |world, _| {
            world.spawn(&BodyDef { position: vec2(px(8), px(-5)), ..floor(0) }).unwrap();
        }),
        ("a body spawned onto it", |world, _| {
            world.spawn(&block(0, -35)).unwrap();
        }),
    ];
    for (what, change) in changes {
        let mut storage = Room::new();
        let (mut world, handles) = two_stacks(&mut storage);
        change(&mut world, handles[..4].try_into().unwrap());
        steps(&mut world, 3);
        let own = handles[1..4].iter().filter(|&&body| world.body(body).is_ok_and(|body| body.asleep)).count();
        assert_eq!(own, 0, "{what}");
        assert!(handles[5..].iter().all(|&body| sleeps(&world, body)), "{what} wakes the other stack");
        assert!(asleep(&world) == 3, "{what}");
    }
}

#[test]
fn gravity_and_new_settings_wake_all() {
    let mut storage = Room::new();
    let (mut world, _) = two_stacks(&mut storage);
    world.configure(Config { gravity: vec2(px(200), px(0)), ..*world.config() }).unwrap();
    steps(&mut world, 2);
    assert_eq!(asleep(&world), 0);
    assert!(world.bodies().filter(|body| body.kind == Kind::Rigid).all(|body| body.velocity.x > 0));
}

#[test]
fn what_hits_a_stack_wakes_it_and_what_passes_by_does_not() {
    let mut storage = Room::new();
    let (mut world, handles) = two_stacks(&mut storage);
    let flies =
        |x: i16, vx: i16, vy: i16| BodyDef { gravity_scale: px(0), velocity: vec2(px(vx), px(vy)), ..block(x, -20) };
    let passer = world.spawn(&flies(-12, 0, -60)).unwrap(); // 2 px beside the stack
    steps(&mut world, 20);
    assert_eq!(asleep(&world), 6);
    world.despawn(passer).unwrap();
    world.spawn(&flies(-60, 120, 0)).unwrap();
    steps(&mut world, 20); // 40 px, of 50
    assert_eq!(asleep(&world), 6);
    steps(&mut world, 10);
    assert!(!sleeps(&world, handles[1]) && sleeps(&world, handles[5]));
    assert!(world.body(handles[2]).unwrap().velocity.x > 0);
}

#[test]
fn a_kinematic_body_wakes_what_it_comes_to_only_when_it_moves() {
    let mut storage = Room::new();
    let mut world = storage.world();
    world.spawn(&floor(0)).unwrap();
    let body = world.spawn(&block(0, -5)).unwrap();
    let paddle =
        BodyDef { position: vec2(px(11), px(-5)), ..BodyDef::kinematic(block(0, 0).shape, vec2(px(0), px(0))) };
    let paddle = world.spawn(&paddle).unwrap();
    steps(&mut world, 60);
    assert!(sleeps(&world, body), "a paddle that stands by keeps nobody awake");
    world.set_velocity(paddle, vec2(px(-60), px(0))).unwrap();
    steps(&mut world, 11);
    assert!(!sleeps(&world, body) && world.body(body).unwrap().position.x <= px(-9));
    world.set_velocity(paddle, vec2(px(0), px(0))).unwrap();
    steps(&mut world, 120);
    let beside = world.body(body).unwrap().position + vec2(px(11), px(0));
    world.set_position(paddle, beside).unwrap();
    steps(&mut world, 60);
    assert!(sleeps(&world, body));
    world.move_and_slide(paddle, vec2(px(-120), px(0)), &flat_physics::SlideOptions::default()).unwrap();
    steps(&mut world, 1);
    assert!(!sleeps(&world, body));
}

#[test]
fn a_moving_platform_keeps_its_load_awake() {
    let mut storage = Room::new();
    let mut world = storage.world();
    let lift = BodyDef { kind: Kind::Kinematic, velocity: vec2(px(0), ratio(-1, 100)), ..floor(0) };
    world.spawn(&lift).unwrap();
    let body = world.spawn(&block(0, -5)).unwrap();
    steps(&mut world, 200);
    assert!(!sleeps(&world, body));
}

#[test]
fn in_free_fall_nobody_sleeps_however_slow() {
    let mut storage = Room::new();
    let mut world = storage.world();
    let balloon = world.spawn(&BodyDef { gravity_scale: ratio(1, 10_000), ..block(0, -100) }).unwrap();
    steps(&mut world, 300);
    assert!(!sleeps(&world, balloon) && world.body(balloon).unwrap().velocity.y > 0);
    let mut other = Room::new();
    let mut world = other.world();
    world.configure(Config { gravity: vec2(px(0), px(0)), ..Config::default() }).unwrap();
    let rock = world.spawn(&block(0, 0)).unwrap();
    let comet = world.spawn(&BodyDef { velocity: vec2(ratio(1, 20), px(0)), ..block(100, 0) }).unwrap();
    steps(&mut world, 60);
    assert!(sleeps(&world, rock) && !sleeps(&world, comet), "only what doesn't move at all rests on nothing");
}

#[test]
fn a_tile_that_goes_wakes_what_stood_on_it() {
    let mut storage = Room::new();
    let mut world = storage.world();
    let tiles = [TileFlags::SOLID.bits(); 8];
    let layer = BehaviorLayer::new(&tiles, 8, 1).unwrap();
    world.set_tiles(&layer, &Terrain { material: DULL, ..Terrain::default() }).unwrap();
    let body = world.spawn(&block(24, -5)).unwrap();
    steps(&mut world, 60);
    assert!(sleeps(&world, body));
    world.set_tile_active(1, 0, false).unwrap();
    steps(&mut world, 10);
    assert!(!sleeps(&world, body) && world.body(body).unwrap().position.y > px(-5));
}

#[test]
fn a_contact_that_slept_ends_once_its_bodies_part() {
    let mut storage = Room::new();
    let (mut world, handles) = two_stacks(&mut storage);
    world.despawn(handles[3]).unwrap();
    steps(&mut world, 1);
    let ends: Vec<_> = world.events().filter(|event| event.phase == Phase::End).collect();
    assert_eq!(ends.len(), 1);
    assert!(ends[0].of(handles[3]).is_some() && ends[0].of(handles[2]).is_some());
}

#[test]
fn without_the_effect_nobody_sleeps_any_more() {
    let mut storage = Room::new();
    let (mut world, _) = two_stacks(&mut storage);
    step(&mut world, ON.without(Effects::SLEEP));
    assert_eq!(asleep(&world), 0);
    for _ in 0..100 {
        step(&mut world, ON.without(Effects::SLEEP));
    }
    assert_eq!((asleep(&world), world.statistics().contacts), (0, 6));
}

#[test]
fn slow_is_what_the_settings_say() {
    let mut storage = Room::new();
    let mut world = storage.world();
    let smooth = Material { friction: px(0), ..DULL };
    world.spawn(&BodyDef { material: smooth, ..floor(0) }).unwrap();
    let slider = BodyDef { velocity: vec2(ratio(1, 8), px(0)), material: smooth, ..block(0, -5) };
    let slider = world.spawn(&slider).unwrap();
    steps(&mut world, 100);
    assert!(!sleeps(&world, slider));
    world.configure(Config { sleep_speed: ratio(1, 4), ..*world.config() }).unwrap();
    steps(&mut world, 100);
    assert!(sleeps(&world, slider));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// Whatever a game does: two worlds of equal history stay equal, also if one was restored from a snapshot that slept; nobody
    /// who is awake leans on somebody who sleeps; none is pressed into the floor by what slept on it.
    #[test]
    fn sleeping_worlds_are_as_certain_as_others(acts in meddling::acts(), pause in 0usize..80) {
        let mut rooms = [Room::new(), Room::new(), Room::new()];
        let [first, second, third] = &mut rooms;
        let (mut world, mut twin, mut saved) = (first.world(), second.world(), third.world());
        meddling::build(&mut world);
        steps(&mut world, pause);
        saved.copy_from(&world).unwrap();
        twin.copy_from(&saved).unwrap();
        for act in &acts {
            for world in [&mut world, &mut twin] {
                act.perform(world);
                steps(world, act.steps * 16);
            }
            prop_assert_eq!(digest(&world), digest(&twin));
            for contact in world.contacts() {
                let [a, b] = contact.bodies.map(|handle| world.body(handle).unwrap());
                if act.steps > 0 && a.kind == Kind::Rigid && b.kind == Kind::Rigid && contact.impulse.x > 0 {
                    prop_assert_eq!(a.asleep, b.asleep);
                }
            }
        }
        prop_assert_eq!(world.statistics().contacts_lost, 0);
    }
}

#[test]
fn all_levels_let_a_stack_sleep_that_stands() {
    for level in [Level::Grounded, Level::Exact] {
        let mut storage = Room::new();
        let mut world = storage.world();
        world.configure(Config::at(level)).unwrap();
        world.spawn(&floor(0)).unwrap();
        let body = world.spawn(&block(0, -5)).unwrap();
        steps(&mut world, 60);
        assert!(sleeps(&world, body), "{level:?}");
    }
}

#[test]
fn nobody_falls_asleep_on_what_has_just_gone() {
    type Change = fn(&mut World<'_, Fixed>, Handle, Handle);
    let changes: [Change; 5] = [
        |world, floor, _| world.despawn(floor).unwrap(),
        |world, floor, _| world.set_visible(floor, false).unwrap(),
        |world, floor, _| world.set_position(floor, vec2(px(0), px(100))).unwrap(),
        |world, _, body| world.set_visible(body, false).unwrap(),
        |world, floor, body| {
            world.set_mask(floor, 0).unwrap();
            world.set_mask(body, 0).unwrap();
        },
    ];
    for kind in [Kind::Static, Kind::Kinematic] {
        for change in changes {
            for wait in 20..60 {
                let mut storage = Room::new();
                let mut world = storage.world();
                let floor = world.spawn(&BodyDef { kind, ..floor(0) }).unwrap();
                let body = world.spawn(&block(0, -5)).unwrap();
                steps(&mut world, wait);
                change(&mut world, floor, body);
                steps(&mut world, 20);
                assert!(world.body(body).unwrap().position.y > px(0), "after {wait} steps");
            }
        }
    }
}

#[test]
fn a_settled_pit_that_is_woken_goes_the_same_way_each_time_and_settles_again() {
    let material = Material { restitution: ratio(1, 5), friction: ratio(3, 10), ..Material::DEFAULT };
    let wall = |x: i16, y: i16, w: i16, h: i16| {
        let def = BodyDef::fixed(Shape::Box { half: vec2(px(w), px(h)) }, vec2(px(x), px(y)));
        BodyDef { material, ..def }
    };
    let pit = Box::<Storage<Fixed, 48, 256>>::default;
    let (mut first, mut second) = (pit(), pit());
    let (mut pit, mut woken) = (first.world(), second.world());
    for wall in [wall(50, 108, 66, 8), wall(-8, 0, 8, 108), wall(108, 0, 8, 108)] {
        pit.spawn(&wall).unwrap();
    }
    let balls: Vec<Handle> = (0..40)
        .map(|n| {
            let at = vec2(px(9 + n % 7 * 13 + n / 7 % 2 * 4), px(90 - n / 7 * 14));
            pit.spawn(&BodyDef { material, ..BodyDef::rigid(Shape::Circle { radius: px(6) }, at) }).unwrap()
        })
        .collect();
    // It may take a while until the last one rests.
    assert!((0..40).any(|_| (steps(&mut pit, 100), asleep(&pit) == balls.len()).1));
    let settled = digest(&pit);
    steps(&mut pit, 100);
    assert_eq!(digest(&pit), settled);

    let mut wake = || {
        woken.copy_from(&pit).unwrap();
        woken.apply_impulse(balls[20], vec2(px(40), px(-90))).unwrap();
        let digests: Vec<u64> = (0..1000).map(|_| (step(&mut woken, ON), digest(&woken)).1).collect();
        (digests, asleep(&woken))
    };
    let (once, twice) = (wake(), wake());
    assert!(once == twice);
    assert!(once.0[0] != settled && once.0[999] != settled);
    assert_eq!(once.1, balls.len());
}
