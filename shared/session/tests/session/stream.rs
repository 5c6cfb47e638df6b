//! What is sent of a step.

use flat_physics::{Effects, Fixed, Quantity, Storage};
use flat_wire::message::{Command, Detail, Flip, Flow, Frame, Phase, Point, Reply, StreamRequest};

use crate::device::{Device, FAST, everything, undisturbed};

#[test]
fn positions_come_in_sixteenths_every_so_many_steps() {
    let mut device = Device::new();
    let stream = StreamRequest { detail: Detail::Positions, every: 3, ..StreamRequest::default() };
    device.start("drop", 40, stream, 10);
    device.run(FAST);
    let mut seen = Vec::new();
    for frame in device.frames() {
        if let Frame::Positions { step, total, bodies } = frame {
            assert_eq!(*total, 41);
            seen.extend(bodies.iter().map(|body| (*step, body.slot)));
            // Bodies start at y = -106 and have fallen less than 4 px after 9 steps.
            assert!(bodies.iter().all(|body| body.slot == 0 || (-106 * 16..-102 * 16).contains(&body.position[1])));
        }
    }
    let expected: Vec<_> = [3, 6, 9].into_iter().flat_map(|step| (0..41).map(move |slot| (step, slot))).collect();
    assert_eq!(seen, expected);
}

#[test]
fn a_flipped_bit_changes_the_digest_from_its_stage_on() {
    let trace = |flip: Option<Flip>| {
        let mut device = Device::new();
        assert!(matches!(device.load("ball_pit", 20), Reply::Loaded(_)));
        let stream = StreamRequest { stage_digests: true, flow: Flow::Hold, ..StreamRequest::default() };
        device.ask(&Command::Stream(stream));
        if let Some(flip) = flip {
            assert_eq!(device.ask(&Command::Flip(flip)), Reply::Done);
        }
        device.ask(&Command::Run { steps: 10 });
        device.run(FAST);
        let digests = device.frames().filter_map(|frame| match frame {
            Frame::StageDigests { digests, .. } => Some(*digests),
            _ => None,
        });
        digests.flatten().collect::<Vec<_>>()
    };
    let flip = Flip { point: Point { step: 4, stage: 2 }, body: 9, bit: 0 };
    let (good, bad) = (trace(None), trace(Some(flip)));
    let first = good.iter().zip(&bad).position(|(a, b)| a != b);
    assert_eq!(first, Some(3 * 6 + 2));
}

#[test]
fn a_watched_point_shows_all_bodies_and_contacts_in_the_middle_of_a_step() {
    let mut device = Device::new();
    assert!(matches!(device.load("ball_pit", 50), Reply::Loaded(_)));
    device.ask(&Command::Stream(StreamRequest { flow: Flow::Hold, ..StreamRequest::default() }));
    for (steps, point) in [(30, Point { step: 20, stage: 0 }), (30, Point { step: 40, stage: 5 })] {
        assert_eq!(device.ask(&Command::Watch(point)), Reply::Done);
        device.ask(&Command::Run { steps });
        device.events.clear();
        device.run(100);
        let (mut slots, mut contacts) = (Vec::new(), Vec::new());
        for frame in device.frames() {
            match frame {
                Frame::Bodies { at, bodies, .. } if *at == point => slots.extend(bodies.iter().map(|body| body.slot)),
                Frame::Contacts { at, total, contacts: some } if *at == point => contacts.push((*total, some.len())),
                Frame::Bodies { at, .. } | Frame::Contacts { at, .. } => panic!("{at:?}"),
                _ => {}
            }
        }
        assert_eq!(slots, (0..54).collect::<Vec<_>>());
        let total = contacts.first().expect("balls touch").0;
        assert_eq!(contacts.iter().map(|(_, some)| some).sum::<usize>(), usize::from(total));
    }
}

#[test]
fn events_are_the_engines_own_of_every_step_over_as_many_frames_as_it_takes() {
    let mut device = Device::new();
    let stream = StreamRequest { events: true, flow: Flow::Hold, ..StreamRequest::default() };
    device.start("ball_pit", 50, stream, 90);
    device.run(FAST);
    assert_eq!(device.finish().1, undisturbed(50, 90), "to tell events changes nothing");

    let pit = flat_scenes::find("ball_pit").unwrap();
    let parameters = pit.parameters(Some(50), None, flat_scenes::Order::Forward).unwrap();
    let mut storage = Box::new(Storage::<Fixed, 128, 1024>::new());
    let mut world = storage.world();
    pit.build(&parameters, flat_physics::Level::Flat, &mut world).unwrap();
    let mut phases = [0; 3];
    for step in 1..=90 {
        flat_physics::step(&mut world, pit.effects | Effects::EVENTS);
        let expected: Vec<_> = world.events().map(|event| (event.body.slot(), event.impulse.x.bits())).collect();
        let mut told = Vec::new();
        for frame in device.frames() {
            if let Frame::Events { step: at, total, events } = frame
                && *at == step
            {
                assert_eq!(usize::from(*total), expected.len());
                told.extend(events.iter().map(|event| (event.bodies[0], event.impulse)));
                for event in events {
                    phases[event.phase as usize] += 1;
                    assert!(event.tile.is_none() && !event.sensor);
                }
            }
        }
        assert_eq!(told, expected, "step {step}");
    }
    assert!(phases.iter().all(|&count| count > 5), "begin, stay, end: {phases:?}");
}

#[test]
fn an_event_with_a_tile_names_it() {
    let mut device = Device::new();
    let stream = StreamRequest { events: true, flow: Flow::Hold, ..StreamRequest::default() };
    device.start("tile_level", 1, stream, 120);
    device.run(FAST);
    let mut tiles = Vec::new();
    for frame in device.frames() {
        if let Frame::Events { events, .. } = frame {
            tiles.extend(events.iter().map(|event| (event.phase, event.bodies, event.tile)));
        }
    }
    // The first ball starts over the first platform, of columns 3 to 8 in row 4, and flies to the right.
    let (phase, bodies, tile) = tiles[0];
    assert_eq!((phase, bodies), (Phase::Begin, [0, u16::MAX]));
    let [column, row] = tile.expect("the only body meets nothing but tiles");
    assert!((3..=8).contains(&column) && row == 4, "{column} {row}");
}

#[test]
fn measures_are_the_sums_over_the_bodies_and_contacts_of_their_step() {
    let mut device = Device::new();
    let stream = StreamRequest { measures_every: 25, every: 25, ..everything(Flow::Hold) };
    device.start("ball_pit", 20, stream, 100);
    device.run(FAST);
    // Mass 1, gravity 200 px/s2; px in 1/65536 and px per step in 2^-24, as fixed point has them.
    let px = |bits: i64| bits as f64 / 65_536.0;
    let speed = |bits: i64| 60.0 * bits as f64 / f64::from(1 << 24);
    let (mut bodies, mut contacts, mut measured) = (Vec::new(), Vec::new(), 0);
    for frame in device.frames() {
        match frame {
            Frame::Bodies { bodies: some, .. } => bodies.extend(some.iter().filter(|body| body.slot >= 4).copied()),
            Frame::Contacts { contacts: some, .. } => contacts.extend(some.iter().copied()),
            Frame::Measures(measures) => {
                let velocity = bodies.iter().map(|body| body.velocity.map(speed)).collect::<Vec<_>>();
                let kinetic: f64 = velocity.iter().map(|[x, y]| f64::midpoint(x * x, y * y)).sum();
                let potential: f64 = bodies.iter().map(|body| -200.0 * px(body.position[1])).sum();
                let momentum = [0, 1].map(|axis| velocity.iter().map(|velocity| velocity[axis]).sum::<f64>());
                let deepest = contacts.iter().map(|contact| px(contact.penetration)).fold(0.0, f64::max);
                let fastest = velocity.iter().flatten().map(|component| component.abs()).fold(0.0, f64::max);
                // Each speed is rounded to 1/65536 px/s; the energy of a fast one then differs by 1/100.
                let pairs = [
                    (measures.kinetic, kinetic, 0.05),
                    (measures.potential, potential, 0.01),
                    (measures.momentum[0], momentum[0], 0.001),
                    (measures.momentum[1], momentum[1], 0.001),
                    (measures.penetration, deepest, 1e-9),
                    (measures.fastest, fastest, 1e-4),
                ];
                for (got, expected, tolerance) in pairs {
                    assert!((px(got) - expected).abs() <= tolerance, "{measures:?}: {} for {expected}", px(got));
                }
                measured += 1;
                assert_eq!((bodies.len(), measures.step), (20, 25 * measured));
                (bodies, contacts) = (Vec::new(), Vec::new());
            }
            _ => {}
        }
    }
    assert_eq!(measured, 4);
}
