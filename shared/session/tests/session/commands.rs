//! What a device answers, and what it refuses.

use flat_physics::{Fixed, Storage};
use flat_session::LinkCounters;
use flat_wire::PROTOCOL_VERSION;
use flat_wire::message::{
    Command, Event, Flip, Flow, Level, Mishap, Point, Reply, ScalarKind, SceneRequest, Stack, Status, StreamRequest,
    Variant,
};

use crate::device::{Device, FAST, everything, scene, undisturbed};

#[test]
fn hello_tells_protocol_identity_and_the_room_of_each_number_format_that_has_any() {
    let Reply::Hello(hello) = Device::new().ask(&Command::Hello { protocol: 99 }) else { panic!() };
    assert_eq!((hello.protocol, &*hello.board, &*hello.build), (PROTOCOL_VERSION, "test", "b"));
    let room: Vec<_> = hello.capacities.iter().map(|c| (c.scalar, c.bodies, c.contacts)).collect();
    assert_eq!(room, [(ScalarKind::Fixed, 128, 1024), (ScalarKind::F32, 32, 256)]);
}

#[test]
fn what_cannot_be_done_is_refused_with_the_reason() {
    let mut device = Device::new();
    let at = |step, stage| Point { step, stage };
    assert_eq!(device.refusal(&Command::Run { steps: 1 }), "no scene is loaded");
    let provoked = device.refusal(&Command::Provoke(Mishap::Panic));
    assert_eq!(provoked, "this build doesn't fail on request; a test build does");
    assert_eq!(device.refusal(&Command::Watch(at(1, 0))), "no scene is loaded");
    assert_eq!(device.refusal(&Command::Load(scene("attic", 1))), "there is no scene named \"attic\"");
    assert_eq!(device.refusal(&Command::Load(scene("drop", 0))), "drop: bodies is 0, must be 1..=200");
    let too_many = device.refusal(&Command::Load(scene("ball_pit", 200)));
    assert_eq!(too_many, "ball_pit: needs 204 bodies and 1416 contacts, there is room for 128 and 1024");

    device.start("ball_pit", 10, StreamRequest::default(), 5);
    assert_eq!(device.refusal(&Command::Run { steps: 1 }), "a run is under way, 5 steps remain");
    device.run(FAST);
    assert_eq!(device.refusal(&Command::Run { steps: 0 }), "steps is 0, must be 1..=4294967290");
    assert_eq!(device.refusal(&Command::Run { steps: u32::MAX }), "steps is 4294967295, must be 1..=4294967290");
    assert_eq!(device.refusal(&Command::Watch(at(5, 5))), "step 5 stage 5 has passed");
    assert_eq!(device.refusal(&Command::Watch(at(6, 6))), "stage is 6, must be 0..=5");
    let flip = |body, bit| Command::Flip(Flip { point: at(6, 0), body, bit });
    assert_eq!(device.refusal(&flip(14, 0)), "there is no body in slot 14");
    assert_eq!(device.refusal(&flip(0, 32)), "bit is 32, must be 0..=31");
}

#[test]
fn a_frame_that_this_table_does_not_know_is_answered() {
    let mut device = Device::new();
    device.session.refuse_unknown(42, &mut *device.ring);
    device.drain(FAST);
    let Some(Event::Reply { to: 42, reply: Reply::Refused(reason) }) = device.events.pop() else { panic!() };
    assert_eq!(&*reason, "unknown command; this device speaks protocol 1");
}

#[test]
fn a_run_can_be_stopped_and_continued() {
    let mut device = Device::new();
    device.start("ball_pit", 20, StreamRequest::default(), 1_000_000);
    for _ in 0..50 {
        device.now_us += 16_667;
        device.tick();
    }
    assert_eq!(device.ask(&Command::Stop), Reply::Done);
    device.run(FAST);
    assert_eq!(device.finish().0, 50);
    assert_eq!(device.ask(&Command::Stop), Reply::Done);
    assert_eq!(device.ask(&Command::Run { steps: 70 }), Reply::Done);
    device.run(FAST);
    assert_eq!(device.finish(), (120, undisturbed(20, 120), 0, 0));
}

#[test]
fn loading_ends_a_run_and_forgets_what_was_counted() {
    let mut device = Device::new();
    device.start("ball_pit", 50, everything(Flow::Drop), 100);
    for _ in 0..50 {
        device.now_us += 16_667;
        device.tick();
    }
    assert!(matches!(device.load("drop", 1), Reply::Loaded(_)));
    device.session.note_link(LinkCounters { received: 5, damaged: 2 });
    device.session.note_stack(Stack { size: 100, peak: 60 });
    let status = device.status();
    let stack = Stack { size: 100, peak: 60 };
    assert_eq!(status, Status { received: 5, damaged: 2, stack, ..Status::default() });
    assert_eq!(device.session.due_us(), None);
}

#[test]
fn a_device_without_a_host_runs_one_scene_after_the_other_sends_nothing_and_tells_what_they_came_to() {
    let mut device = Device::new();
    let mut demos = Vec::new();
    while demos.len() < 3 {
        demos.extend(device.session.demonstrate(device.now_us));
        device.now_us = device.session.due_us().expect("a demo runs").max(device.now_us);
        device.tick();
    }
    assert!(device.ring.is_empty());
    for (demo, scene) in demos.iter().zip(flat_scenes::SCENES) {
        assert_eq!((demo.scene, demo.steps, demo.late_us), (scene.name, scene.steps, 0));
        let mut hosted = Device::new();
        let request = SceneRequest { name: scene.name.try_into().unwrap(), ..SceneRequest::default() };
        assert!(matches!(hosted.ask(&Command::Load(request)), Reply::Loaded(_)));
        assert_eq!(hosted.ask(&Command::Run { steps: scene.steps }), Reply::Done);
        hosted.run(FAST);
        assert_eq!(hosted.finish().1, demo.digest, "{}", scene.name);
    }
}

#[test]
fn a_host_finds_a_device_that_has_done_nothing_yet() {
    let mut device = Device::new();
    device.session.demonstrate(device.now_us);
    device.now_us += 100_000;
    device.tick();
    assert_eq!(device.status(), Status::default());
    device.session.demonstrate(device.now_us);
    assert_eq!(device.session.due_us(), None, "a demo began although there is a host");
    assert_eq!(device.refusal(&Command::Run { steps: 1 }), "no scene is loaded");
}

#[test]
fn a_scene_is_varied_and_directed_as_it_would_be_without_a_session() {
    let churn = flat_scenes::find("churn").unwrap();
    let variant = flat_scenes::Variant { mirrored: true, phase: 7, ..flat_scenes::Variant::NONE };
    let parameters = churn.vary(churn.defaults, variant).unwrap();
    let mut storage = Box::new(Storage::<Fixed, 128, 1024>::new());
    let mut world = storage.world();
    churn.build(&parameters, flat_physics::Level::Grounded, &mut world).unwrap();
    let mut memory = flat_scenes::Memory::default();
    for step in 1..=50 {
        churn.direct(&parameters, flat_scenes::Cue::unattended(step), &mut memory, &mut world).unwrap();
        flat_physics::step(&mut world, churn.effects);
    }

    let mut device = Device::new();
    let variant = Variant { mirrored: true, phase: 7, ..Variant::default() };
    let request = SceneRequest { bodies: None, level: Level::Grounded, variant, ..scene("churn", 0) };
    assert!(matches!(device.ask(&Command::Load(request.clone())), Reply::Loaded(_)));
    assert_eq!(device.ask(&Command::Run { steps: 50 }), Reply::Done);
    device.run(FAST);
    assert_eq!(device.finish().1, flat_physics::digest(&world));

    assert_eq!(device.refusal(&Command::Input { buttons: 1 }), "churn has no player");
    let gapped = SceneRequest { variant: Variant { gap: 3, ..Variant::default() }, ..request };
    assert_eq!(device.refusal(&Command::Load(gapped)), "churn: there is no room for a gap");
}
