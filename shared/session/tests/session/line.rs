//! What a slow line costs, and what it never does.

use flat_session::{Class, Sink};
use flat_wire::message::{Command, Flow, Frame};

use crate::device::{Device, FAST, Readings, everything, undisturbed};

#[test]
fn a_slow_line_drops_details_first_and_delays_no_step() {
    let mut device = Device::new();
    device.start("ball_pit", 50, everything(Flow::Drop), 120);
    let begun = device.now_us;
    device.run(100); // 6 kB/s: enough for the steps alone
    assert_eq!(device.now_us - begun, 2_000_000, "the last step was late");
    let (step, digest, details, steps) = device.finish();
    assert_eq!((step, digest, steps), (120, undisturbed(50, 120), 0));
    assert!(details > 1000, "{details} details dropped");
    assert_eq!(device.steps().len(), 120);
    assert_eq!(device.decoder.counters().missing, details);
}

#[test]
fn a_stuck_line_loses_steps_but_never_the_end_of_the_run() {
    let mut device = Device::new();
    device.start("ball_pit", 50, everything(Flow::Drop), 600);
    device.run(0);
    let (step, digest, details, steps) = device.finish();
    assert_eq!((step, digest), (600, undisturbed(50, 600)));
    assert!(details > 0 && steps > 0);
    // Each step has its Step and its Statistics frame.
    let statistics = device.frames().filter(|frame| matches!(frame, Frame::Statistics(_))).count();
    assert_eq!(device.steps().len() + statistics + steps as usize, 1200);
    assert_eq!(device.decoder.counters().missing, details + steps);
}

#[test]
fn a_host_that_wants_everything_gets_everything_however_slow_the_line() {
    let mut device = Device::new();
    device.start("ball_pit", 50, everything(Flow::Hold), 40);
    device.run(300);
    assert_eq!(device.finish(), (40, undisturbed(50, 40), 0, 0));
    assert_eq!(device.decoder.counters().missing, 0);
    assert_eq!(device.steps().iter().map(|(step, _)| *step).collect::<Vec<_>>(), (1..=40).collect::<Vec<_>>());

    let (mut bodies, mut last_slot, mut contacts) = (0, None, (0, 0));
    for frame in device.frames() {
        match frame {
            Frame::Step { step, digest } => assert_eq!(device.steps()[*step as usize - 1].1, *digest),
            Frame::StageDigests { step, digests } => assert_eq!(digests[5], device.steps()[*step as usize - 1].1),
            Frame::StageTimes { counts, .. } => assert_eq!(*counts, [3; 6], "without the 7 of the reading itself"),
            Frame::Bodies { total, bodies: some, at } => {
                assert_eq!((*total, at.stage), (54, 5));
                for body in some {
                    assert!(last_slot < Some(body.slot));
                    last_slot = Some(body.slot).filter(|&slot| slot < 53);
                }
                bodies += some.len();
            }
            Frame::Contacts { total, contacts: some, .. } => {
                contacts = (contacts.0 + some.len(), contacts.1.max(*total));
            }
            Frame::Statistics(statistics) => {
                assert_eq!((statistics.bodies, statistics.contacts_lost, statistics.escaped), (54, 0, 0));
                assert!(statistics.contacts_peak >= statistics.contacts);
            }
            Frame::Timing { late_us, took_us, .. } => assert_eq!((*late_us, *took_us), (0, 0)),
            _ => {}
        }
    }
    assert_eq!(bodies, 40 * 54);
    assert!(contacts.0 > usize::from(contacts.1), "{contacts:?}");
}

#[test]
fn a_sink_that_takes_nothing_harms_nobody() {
    struct Closed;
    impl Sink for Closed {
        fn sequence(&self) -> u16 {
            0
        }

        fn skip(&mut self) {}

        fn push(&mut self, _class: Class, _frame: &[u8]) -> bool {
            false
        }
    }
    let mut device = Device::new();
    device.start("drop", 1, everything(Flow::Drop), 10);
    for _ in 0..30 {
        device.now_us += 16_667;
        device.session.tick(&mut Readings { now_us: device.now_us, tick_us: 0, count: 0 }, &mut Closed);
        device.session.handle(device.now_us, 1, &Command::Status, &mut Closed);
    }
    // Then the line works again, and the end of the run arrives.
    device.run(FAST);
    assert_eq!(device.finish().0, 10);
}
