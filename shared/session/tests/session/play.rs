//! A player's buttons over the wire.

use flat_scenes::{Buttons, Hold};
use flat_wire::message::{Command, Level, Reply, SceneRequest, StreamRequest};

use crate::device::{Device, FAST, scene};

fn platformer() -> SceneRequest {
    SceneRequest { level: Level::Grounded, ..scene("platformer", 1) }
}

/// Digest after a run in which somebody plays.
fn played(holds: &[Hold]) -> u64 {
    let mut device = Device::new();
    assert!(matches!(device.ask(&Command::Load(platformer())), Reply::Loaded(_)));
    for Hold { buttons, steps } in holds {
        assert_eq!(device.ask(&Command::Input { buttons: buttons.bits() }), Reply::Done);
        assert_eq!(device.ask(&Command::Run { steps: *steps }), Reply::Done);
        device.run(FAST);
    }
    device.finish().1
}

/// Digest after a run in which nobody plays.
fn unattended(steps: u32) -> u64 {
    let mut device = Device::new();
    assert!(matches!(device.ask(&Command::Load(platformer())), Reply::Loaded(_)));
    assert_eq!(device.ask(&Command::Run { steps }), Reply::Done);
    device.run(FAST);
    device.finish().1
}

#[test]
fn the_demo_is_what_a_host_can_play_too() {
    let demo = flat_scenes::find("platformer").unwrap().demo.unwrap();
    let holds = &demo.holds[..8];
    let steps = holds.iter().map(|hold| hold.steps).sum();
    assert_eq!(played(holds), unattended(steps));
}

#[test]
fn buttons_count_from_the_next_step_on_until_others_come() {
    let hold = |buttons, steps| Hold { buttons, steps };
    let early = played(&[hold(Buttons::IDLE, 10), hold(Buttons::RIGHT, 20), hold(Buttons::IDLE, 10)]);
    let in_two = [hold(Buttons::IDLE, 10), hold(Buttons::RIGHT, 7), hold(Buttons::RIGHT, 13), hold(Buttons::IDLE, 10)];
    assert_eq!(early, played(&in_two));
    assert_ne!(early, played(&[hold(Buttons::IDLE, 10), hold(Buttons::RIGHT, 21), hold(Buttons::IDLE, 9)]));
}

#[test]
fn what_nobody_can_press_is_refused_and_changes_nothing() {
    let mut device = Device::new();
    assert_eq!(device.refusal(&Command::Input { buttons: 1 }), "no scene is loaded");
    device.start("ball_pit", 20, StreamRequest::default(), 30);
    assert_eq!(device.refusal(&Command::Input { buttons: 1 }), "ball_pit has no player");
    assert!(matches!(device.ask(&Command::Load(platformer())), Reply::Loaded(_)));
    assert_eq!(device.refusal(&Command::Input { buttons: 0x31 }), "buttons 0x31 hold an unknown bit");
    assert_eq!(device.ask(&Command::Run { steps: 50 }), Reply::Done);
    device.run(FAST);
    assert_eq!(device.finish().1, unattended(50), "the demo goes on");
}

#[test]
fn a_scene_that_is_loaded_anew_plays_by_itself_again() {
    let mut device = Device::new();
    assert!(matches!(device.ask(&Command::Load(platformer())), Reply::Loaded(_)));
    device.ask(&Command::Input { buttons: Buttons::LEFT.bits() });
    device.ask(&Command::Run { steps: 30 });
    device.run(FAST);
    assert!(matches!(device.ask(&Command::Load(platformer())), Reply::Loaded(_)));
    device.ask(&Command::Run { steps: 30 });
    device.run(FAST);
    assert_eq!(device.finish().1, unattended(30));
}
