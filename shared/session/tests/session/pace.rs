//! When steps run.

use flat_wire::message::{Frame, StreamRequest};

use crate::device::{Device, FAST, undisturbed};

#[test]
fn the_clock_alone_paces_the_steps() {
    let mut device = Device::new();
    device.start("drop", 1, StreamRequest::default(), 1000);
    for _ in 0..1_000 {
        device.now_us += 1_000;
        device.tick();
        device.drain(FAST);
    }
    assert_eq!(device.steps().len(), 60);
    // A second passes unnoticed: it is caught up with, four steps at a time, and nothing is lost.
    device.now_us += 1_000_000;
    for expected in [64, 68, 72] {
        device.tick();
        device.drain(FAST);
        assert_eq!(device.steps().len(), expected);
    }
    let status = device.status();
    assert_eq!((status.step, status.remaining, status.backlog_us), (72, 928, 800_000));
    // The first of the last four, the 69th, was due at 69/60 s and ran at 2 s.
    assert_eq!((status.late_us, status.overruns), (983_333, 12));
}

#[test]
fn how_time_passes_changes_no_digest() {
    let reference = undisturbed(20, 120);
    for chunk_us in [1_000, 16_000, 33_000, 2_000_000] {
        let mut device = Device::new();
        device.start("ball_pit", 20, StreamRequest::default(), 120);
        while device.session.due_us().is_some() {
            device.now_us += chunk_us;
            device.tick();
            device.drain(FAST);
        }
        assert_eq!(device.finish(), (120, reference, 0, 0), "{chunk_us} us");
    }
}

#[test]
fn lateness_counts_from_when_a_step_was_due_and_duration_from_its_beginning() {
    let mut device = Device::new();
    let stream = StreamRequest { timing: true, ..StreamRequest::default() };
    device.start("drop", 1, stream, 4);
    let begun = device.now_us;
    // The n-th step is due at n/60 s, rounded up to a whole microsecond.
    for (now_us, tick_us) in [(16_667, 10), (33_340, 5), (50_000, 17_000)] {
        device.now_us = begun + now_us;
        device.tick_at(tick_us);
    }
    device.run(FAST);
    let timings: Vec<_> = device
        .frames()
        .filter_map(|frame| match *frame {
            Frame::Timing { step, late_us, took_us, overruns } => Some((step, late_us, took_us, overruns)),
            _ => None,
        })
        .collect();
    // A tick reads the clock when it starts, when a step begins, and when it ends; the third step ends when the fourth
    // has long been due, and the fourth when the fifth has.
    assert_eq!(timings, [(1, 10, 10, 0), (2, 11, 5, 0), (3, 17_000, 17_000, 1), (4, 34_333, 0, 2)]);
    let status = device.status();
    assert_eq!((status.late_us, status.took_us, status.overruns), (34_333, 17_000, 2));
}
