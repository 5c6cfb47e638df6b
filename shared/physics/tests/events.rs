//! Contacts begin once, last, and end once, whatever happens to their bodies; sensors notice and block nothing.

mod meddling;

use std::collections::HashSet;

use flat_physics::kinematics::Collider;
use flat_physics::scalar::{px, ratio};
use flat_physics::{
    BodyDef, Config, Effects, Event, Fixed, Handle, Kind, Level, Material, Phase, Scalar, Shape, Storage, Vec2, World,
    digest, step, vec2,
};
use proptest::prelude::*;

const ON: Effects = Effects::ALL.without(Effects::DAMPING).without(Effects::SPEED_CAP);
const DULL: Material<Fixed> = Material { bounce: false, ..Material::DEFAULT };

fn disc(x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { material: DULL, ..BodyDef::rigid(Shape::Circle { radius: px(5) }, vec2(px(x), px(y))) }
}

fn block(x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { shape: Shape::Box { half: vec2(px(5), px(5)) }, ..disc(x, y) }
}

fn floor() -> BodyDef<Fixed> {
    let shape = Shape::Box { half: vec2(px(200), px(5)) };
    BodyDef { material: DULL, ..BodyDef::fixed(shape, vec2(px(0), px(5))) }
}

fn handle_of(collider: Collider) -> Handle {
    match collider {
        Collider::Body(handle) => handle,
        Collider::Tile(tile) => panic!("{tile:?} in a world without tiles"),
    }
}

/// The two of an event, the lower slot first.
fn pair(event: &Event<Fixed>) -> (Handle, Handle) {
    let (a, b) = (event.body, handle_of(event.other));
    if a.slot() < b.slot() { (a, b) } else { (b, a) }
}

/// Steps, and tells the events as (phase, slots).
fn told(world: &mut World<'_, Fixed>) -> Vec<(Phase, u16, u16)> {
    step(world, ON);
    let event = |event: Event<Fixed>| {
        let (a, b) = pair(&event);
        (event.phase, a.slot(), b.slot())
    };
    world.events().map(event).collect()
}

#[test]
fn a_contact_begins_once_stays_and_ends_once() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.spawn(&floor()).unwrap();
    let body = world.spawn(&disc(0, -20)).unwrap();
    let phases = |world: &mut World<'_, Fixed>, steps: usize| {
        (0..steps).flat_map(|_| told(world)).map(|(phase, ..)| phase).collect::<Vec<_>>()
    };
    let fall = phases(&mut world, 100);
    assert_eq!(fall[0], Phase::Begin);
    assert!(fall.len() > 50 && fall[1..].iter().all(|&phase| phase == Phase::Stay), "{fall:?}");
    world.set_velocity(body, vec2(px(0), px(-100))).unwrap();
    let flight = phases(&mut world, 10);
    let end = flight.iter().position(|&phase| phase == Phase::End).unwrap();
    assert!(end <= 1 && flight.len() == end + 1, "{flight:?}");
}

#[test]
fn an_event_tells_both_bodies_the_normal_and_the_impulse() {
    let mut storage = Storage::<Fixed, 3, 4>::new();
    let mut world = storage.world();
    let ground = world.spawn(&floor()).unwrap();
    let body = world.spawn(&BodyDef { velocity: vec2(px(0), px(120)), ..disc(0, -6) }).unwrap();
    step(&mut world, ON);
    let event = world.events().next().unwrap();
    assert_eq!((event.body, event.other, event.sensor), (body, Collider::Body(ground), false));
    assert_eq!((event.of(body), event.of(ground)), (Some(Collider::Body(ground)), Some(Collider::Body(body))));
    let stranger = world.spawn(&disc(99, 99)).unwrap();
    assert_eq!(event.of(stranger), None);
    assert_eq!(event.normal, vec2(Fixed::UNIT - Fixed::UNIT, Fixed::UNIT));
    // 120 px/s and a step of gravity, less the pixel to go.
    let impulse: f64 = Fixed::px_per_second(event.impulse.x).to_num();
    assert!((impulse - (120.0 + 200.0 / 60.0 - 60.0)).abs() < 0.01, "{impulse}");
}

#[test]
fn a_bounce_is_one_begin_and_one_end_with_its_impulse() {
    for (restitution, height) in [(px(1), 47), (ratio(1, 2), 48), (px(1), 45), (px(1), 5), (ratio(4, 5), 5)] {
        let material = Material { restitution, ..Material::DEFAULT };
        let mut storage = Storage::<Fixed, 2, 4>::new();
        let mut world = storage.world();
        world.configure(Config { gravity: Vec2::default(), ..Config::default() }).unwrap();
        world.spawn(&BodyDef { material, ..floor() }).unwrap();
        world.spawn(&BodyDef { material, velocity: vec2(px(0), px(300)), ..disc(0, -height) }).unwrap();
        let mut events = Vec::new();
        for _ in 0..30 {
            step(&mut world, ON);
            events.extend(world.events());
        }
        let phases: Vec<_> = events.iter().map(|event| event.phase).collect();
        let stays = phases.len().saturating_sub(2);
        assert!(stays <= 1 && phases[0] == Phase::Begin && phases[phases.len() - 1] == Phase::End, "{phases:?}");
        let impulse: f64 = Fixed::px_per_second(events[0].impulse.x).to_num();
        let expected = 300.0 * (1.0 + restitution.to_num::<f64>());
        assert!((impulse - expected).abs() < 0.1, "{impulse} for {expected}");
        let quiet = events[1..].iter().all(|event| event.impulse == Vec2::default());
        assert!(quiet, "{events:?}");
    }
}

#[test]
fn an_impact_that_runs_through_a_row_begins_and_ends_once() {
    let mut storage = Storage::<Fixed, 3, 8>::new();
    let mut world = storage.world();
    world.configure(Config { gravity: Vec2::default(), ..Config::default() }).unwrap();
    let elastic = |x| BodyDef { material: Material::DEFAULT, ..disc(x, 0) };
    world.spawn(&BodyDef { velocity: vec2(px(300), px(0)), ..elastic(-12) }).unwrap();
    world.spawn(&elastic(0)).unwrap();
    world.spawn(&elastic(10)).unwrap();
    // The first stops 2 px before the second, which doesn't move: it passes on at once what it gets.
    let log: Vec<_> = (0..5).flat_map(|_| told(&mut world)).filter(|&(_, a, _)| a == 0).collect();
    assert_eq!(log, [(Phase::Begin, 0, 1), (Phase::End, 0, 1)]);
}

/// Drops a heap; its bodies' user data number them.
fn heap(world: &mut World<'_, Fixed>, numbers: impl Iterator<Item = u16>) {
    world.spawn(&BodyDef { user_data: 99, ..floor() }).unwrap();
    for number in numbers {
        let n = number as i16;
        let (x, y) = (n % 5 * 9 - 18, -8 - n / 5 * 11);
        let def = if n % 3 == 0 { block(x, y) } else { disc(x, y) };
        world.spawn(&BodyDef { user_data: u32::from(number), ..def }).unwrap();
    }
}

#[test]
fn events_come_in_the_order_of_the_contacts_and_not_of_insertion() {
    let run = |reverse: bool| {
        let mut storage = Storage::<Fixed, 32, 128>::new();
        let mut world = storage.world();
        if reverse {
            heap(&mut world, (0..25).rev());
        } else {
            heap(&mut world, 0..25);
        }
        let mut log = Vec::new();
        for _ in 0..200 {
            step(&mut world, ON);
            let number = |handle| world.body(handle).unwrap().user_data;
            let solved: HashSet<_> = world.contacts().map(|contact| contact.bodies).collect();
            let order: Vec<_> = world.contacts().map(|contact| contact.bodies).collect();
            let events: Vec<_> =
                world.events().map(|event| (event.phase, [event.body, handle_of(event.other)])).collect();
            let listed: Vec<_> = events.iter().map(|&(_, pair)| pair).filter(|pair| solved.contains(pair)).collect();
            assert_eq!(listed, order, "each contact has an event");
            log.extend(events.iter().map(|&(phase, pair)| (phase, pair.map(number))));
        }
        assert!(log.iter().any(|(phase, _)| *phase == Phase::End), "balls roll off each other");
        log
    };
    assert_eq!(run(false), run(true));
}

#[test]
fn bodies_at_rest_do_not_flicker() {
    let cases = [
        (Level::Grounded, block as fn(i16, i16) -> _, 10),
        (Level::Grounded, disc, 6),
        (Level::Exact, block, 10),
        (Level::Flat, block, 2),
    ];
    for (level, body, count) in cases {
        for gravity in [0, 200, 600] {
            let mut storage = Storage::<Fixed, 16, 64>::new();
            let mut world = storage.world();
            world.configure(Config { gravity: vec2(px(0), px(gravity)), ..Config::at(level) }).unwrap();
            world.spawn(&floor()).unwrap();
            for n in 0..count {
                world.spawn(&body(0, -5 - 10 * n)).unwrap();
            }
            let mut begun = HashSet::new();
            for n in 0..1200 {
                for (phase, a, b) in told(&mut world) {
                    assert_ne!(phase, Phase::End, "{level:?} {gravity} px/s2, step {n}: {a} and {b}");
                    assert!(phase == Phase::Stay || begun.insert((a, b)));
                }
            }
            assert!(gravity == 0 || begun.len() == count as usize, "{level:?}: {begun:?}");
        }
    }
}

#[test]
fn what_touched_lasts_until_the_gap_exceeds_a_sixteenth_and_begins_at_none() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.configure(Config { gravity: Vec2::default(), ..Config::default() }).unwrap();
    world.spawn(&floor()).unwrap();
    let body = world.spawn(&block(0, -5)).unwrap();
    let mut lifted = |gap| {
        world.set_position(body, vec2(px(0), px(-5) - gap)).unwrap();
        told(&mut world).first().map(|&(phase, ..)| phase)
    };
    assert_eq!(lifted(px(0)), Some(Phase::Begin));
    assert_eq!(lifted(ratio(1, 16)), Some(Phase::Stay));
    assert_eq!(lifted(ratio(1, 15)), Some(Phase::End));
    assert_eq!(lifted(ratio(1, 100)), None);
    assert_eq!(lifted(px(0)), Some(Phase::Begin));
}

#[test]
fn a_removed_body_ends_its_contacts_under_its_own_name_even_if_its_slot_is_filled() {
    let mut storage = Storage::<Fixed, 4, 16>::new();
    let mut world = storage.world();
    let ground = world.spawn(&floor()).unwrap();
    let old = world.spawn(&block(0, -5)).unwrap();
    let upper = world.spawn(&block(0, -15)).unwrap();
    (0..20).for_each(|_| step(&mut world, ON));
    world.despawn(old).unwrap();
    // The slot changes hands twice before the next step.
    let between = world.spawn(&block(50, -5)).unwrap();
    world.despawn(between).unwrap();
    let new = world.spawn(&block(0, -5)).unwrap();
    assert_eq!((new.slot(), between.slot()), (old.slot(), old.slot()));
    step(&mut world, ON);
    let mut events: Vec<_> = world.events().map(|event| (event.phase, pair(&event))).collect();
    events.sort_by_key(|(phase, pair)| (*phase as u8, pair.1.slot()));
    assert_eq!(
        events,
        [
            (Phase::Begin, (ground, new)),
            (Phase::Begin, (new, upper)),
            (Phase::End, (ground, old)),
            (Phase::End, (old, upper)),
        ]
    );
    world.despawn(new).unwrap();
    world.despawn(ground).unwrap();
    step(&mut world, ON);
    let ends: Vec<_> = world.events().map(|event| (event.phase, pair(&event))).collect();
    assert_eq!(ends.len(), 2, "two bodies removed share one end: {ends:?}");
    assert!(ends.contains(&(Phase::End, (ground, new))) && ends.contains(&(Phase::End, (new, upper))));
    assert_eq!(told(&mut world), []);
}

#[test]
fn ends_are_told_from_a_full_pool() {
    let mut storage = Storage::<Fixed, 4, 3>::new();
    let mut world = storage.world();
    world.spawn(&floor()).unwrap();
    let bodies = [-20, 0, 20].map(|x| world.spawn(&block(x, -5)).unwrap());
    assert_eq!(told(&mut world).len(), 3);
    world.despawn(bodies[0]).unwrap();
    world.despawn(bodies[1]).unwrap();
    let mut events = told(&mut world);
    events.sort_by_key(|&(_, _, body)| body);
    assert_eq!(events, [(Phase::End, 0, 1), (Phase::End, 0, 2), (Phase::Stay, 0, 3)]);
}

#[test]
fn whatever_parts_two_bodies_ends_their_contact_in_the_next_step_and_only_then() {
    let partings: [fn(&mut World<'_, Fixed>, Handle); 8] = [
        |world, body| world.set_visible(body, false).unwrap(),
        |world, body| world.set_enabled(body, false).unwrap(),
        |world, body| world.set_position(body, vec2(px(0), px(-300))).unwrap(),
        |world, body| world.set_position(body, vec2(px(0), px(-7))).unwrap(),
        |world, body| world.set_velocity(body, vec2(px(0), px(-6000))).unwrap(),
        |world, body| world.set_shape(body, Shape::Circle { radius: px(1) }).unwrap(),
        |world, body| world.set_kind(body, Kind::Static).unwrap(),
        |world, body| {
            let _ = world.set_position(body, vec2(px(0), px(-16_384)));
            world.set_velocity(body, vec2(px(0), px(-7000))).unwrap();
        },
    ];
    for (number, part) in partings.into_iter().enumerate() {
        let mut storage = Storage::<Fixed, 4, 16>::new();
        let mut world = storage.world();
        world.spawn(&floor()).unwrap();
        let body = world.spawn(&block(0, -5)).unwrap();
        (0..20).for_each(|_| step(&mut world, ON));
        part(&mut world, body);
        let mut ends = 0;
        for n in 0..4 {
            for (phase, ..) in told(&mut world) {
                assert!(
                    phase == Phase::End || (phase == Phase::Stay && n == 0),
                    "parting {number}, step {n}: {phase:?}"
                );
                ends += usize::from(phase == Phase::End);
                assert!(n < 2, "parting {number}: late");
            }
        }
        assert_eq!(ends, 1, "parting {number}");
    }
}

#[test]
fn events_that_are_off_are_not_told_and_begin_anew_when_on_again() {
    let mut storage = Storage::<Fixed, 2, 4>::new();
    let mut world = storage.world();
    world.spawn(&floor()).unwrap();
    let body = world.spawn(&block(0, -5)).unwrap();
    let quiet = ON.without(Effects::EVENTS);
    assert_eq!(world.events().count(), 0);
    step(&mut world, quiet);
    assert_eq!(world.events().count(), 0);
    assert_eq!(told(&mut world), [(Phase::Begin, 0, 1)]);
    assert_eq!(told(&mut world), [(Phase::Stay, 0, 1)]);
    step(&mut world, quiet);
    assert_eq!(world.events().count(), 0);
    assert_eq!(told(&mut world), [(Phase::Begin, 0, 1)]);
    world.despawn(body).unwrap();
    step(&mut world, quiet);
    assert_eq!(told(&mut world), []);
}

#[test]
fn a_handler_may_change_the_world() {
    let mut storage = Storage::<Fixed, 8, 32>::new();
    let mut world = storage.world();
    world.spawn(&floor()).unwrap();
    let handles = [-20, 0, 20].map(|x| world.spawn(&block(x, -5)).unwrap());
    step(&mut world, ON);
    let mut seen = Vec::new();
    world.dispatch(|world, event| {
        let body = event.body;
        seen.push(body);
        if body == handles[0] {
            // Removes one whose event is to come, itself, and fills the slots again.
            handles[..2].iter().for_each(|&handle| world.despawn(handle).unwrap());
            for x in [100, 120] {
                world.spawn(&disc(x, -50)).unwrap();
            }
        } else if let Err(error) = world.set_velocity(body, vec2(px(0), px(-50))) {
            assert_eq!((error, body), (flat_physics::Error::NoSuchBody { handle: handles[1] }, handles[1]));
        }
    });
    assert_eq!(seen, handles, "each is told once");
    step(&mut world, ON);
    let ends: HashSet<_> = world.events().filter(|event| event.phase == Phase::End).map(|event| event.body).collect();
    assert!(ends.contains(&handles[0]) && ends.contains(&handles[1]), "{ends:?}");
    world.dispatch(|world, _| step(world, ON));
    world.dispatch(|world, _| world.clear());
}

#[test]
fn events_change_no_bit_of_the_world() {
    let run = |effects| {
        let mut storage = Storage::<Fixed, 32, 128>::new();
        let mut world = storage.world();
        heap(&mut world, 0..25);
        for n in 0..120 {
            step(&mut world, effects);
            if n % 10 == 0 {
                let handle = world.bodies().nth(3).unwrap().handle;
                world.despawn(handle).unwrap();
                world.spawn(&disc(n - 60, -100)).unwrap();
            }
        }
        digest(&world)
    };
    assert_eq!(run(ON), run(ON.without(Effects::EVENTS)));
}

#[test]
fn an_end_that_was_told_takes_no_room_once_events_are_off() {
    let mut storage = Storage::<Fixed, 2, 1>::new();
    let mut world = storage.world();
    world.spawn(&floor()).unwrap();
    let body = world.spawn(&block(0, -5)).unwrap();
    step(&mut world, ON);
    world.despawn(body).unwrap();
    assert_eq!(told(&mut world), [(Phase::End, 0, 1)]);
    for _ in 0..2 {
        let body = world.spawn(&block(0, -5)).unwrap();
        step(&mut world, ON.without(Effects::EVENTS));
        assert_eq!((world.statistics().contacts, world.statistics().contacts_lost), (1, 0));
        step(&mut world, ON);
        world.despawn(body).unwrap();
    }
}

/// Which contacts have begun and not ended.
#[derive(Default)]
struct Ledger(HashSet<(Handle, Handle)>);

impl Ledger {
    fn enter(&mut self, world: &World<'_, Fixed>) {
        let mut told = HashSet::new();
        for event in world.events() {
            let pair = pair(&event);
            match event.phase {
                Phase::Begin => assert!(self.0.insert(pair), "{pair:?} begins twice"),
                Phase::Stay => assert!(self.0.contains(&pair), "{pair:?} never began"),
                Phase::End => assert!(self.0.remove(&pair), "{pair:?} has ended or never began"),
            }
            assert!(event.phase == Phase::End || told.insert(pair), "{pair:?} is told twice");
        }
        assert_eq!(told, self.0, "what has begun stays until it ends");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, ..ProptestConfig::default() })]

    /// Every contact begins once and ends once, whatever a game does, and none is left when all bodies are gone.
    #[test]
    fn nothing_dangles(acts in meddling::acts()) {
        let mut storage = Storage::<Fixed, 12, 64>::new();
        let mut world = storage.world();
        meddling::build(&mut world);
        let mut ledger = Ledger::default();
        for act in &acts {
            act.perform(&mut world);
            for _ in 0..act.steps {
                step(&mut world, ON);
                ledger.enter(&world);
            }
        }
        let left: Vec<_> = world.bodies().map(|body| body.handle).collect();
        for handle in left {
            world.despawn(handle).unwrap();
        }
        step(&mut world, ON);
        ledger.enter(&world);
        prop_assert_eq!(world.statistics().contacts_lost, 0);
        prop_assert!(ledger.0.is_empty(), "{:?}", ledger.0);
    }
}
