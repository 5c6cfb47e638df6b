//! What waits for a slow line, and what gives way.

use std::collections::VecDeque;

use flat_session::{Class, REPLY_RESERVE, Ring, STEP_RESERVE, Sink};
use flat_wire::message::{Event, Frame, Reason, Reply, Statistics};
use flat_wire::{MAX_FRAME, encode};
use proptest::collection::vec;
use proptest::prelude::*;

const SMALLEST: usize = MAX_FRAME + STEP_RESERVE + REPLY_RESERVE;

/// Pushes frames of this class until one is refused; returns how many bytes were taken.
fn fill(ring: &mut impl Sink, class: Class, frame: &[u8]) -> usize {
    let mut taken = 0;
    while ring.push(class, frame) {
        taken += frame.len();
    }
    taken
}

#[test]
fn each_class_fills_the_ring_up_to_its_own_limit() {
    let mut ring = Ring::<SMALLEST>::new();
    let detail = fill(&mut ring, Class::Detail, &[1; 50]);
    assert_eq!((detail, ring.room(Class::Detail)), (500, MAX_FRAME - 500));
    let step = fill(&mut ring, Class::Step, &[2; 50]);
    assert_eq!((step, ring.room(Class::Step)), (500, MAX_FRAME + STEP_RESERVE - 1000));
    let reply = fill(&mut ring, Class::Reply, &[3; 50]);
    assert_eq!((reply, ring.room(Class::Reply)), (250, SMALLEST - 1250));
    assert_eq!((ring.room(Class::Detail), ring.room(Class::Step)), (0, 0));
}

#[test]
fn a_class_gets_its_room_back_when_the_line_has_taken_enough() {
    let mut ring = Ring::<SMALLEST>::new();
    fill(&mut ring, Class::Reply, &[0]);
    ring.read(&mut [0; REPLY_RESERVE]);
    assert!(!ring.push(Class::Step, &[0]));
    ring.read(&mut [0; 1]);
    assert!(ring.push(Class::Step, &[0]));
    ring.read(&mut [0; STEP_RESERVE]);
    assert!(!ring.push(Class::Detail, &[0]));
    ring.read(&mut [0; 1]);
    assert!(ring.push(Class::Detail, &[0]));
}

#[test]
fn the_longest_detail_frame_fits_the_smallest_ring() {
    assert!(Ring::<SMALLEST>::new().push(Class::Detail, &[0; MAX_FRAME]));
}

#[test]
fn reserves_hold_what_they_are_documented_to_hold() {
    let length = |event| encode(0, &event, &mut [0; MAX_FRAME]).expect("events fit").len();
    let longest_text: Reason = (0..Reason::new().capacity()).map(|_| 'x').collect();
    let refused = length(Event::Reply { to: u16::MAX, reply: Reply::Refused(longest_text) });
    let finished = length(Event::Frame(Frame::Finished {
        step: u32::MAX,
        digest: u64::MAX,
        dropped_detail: u32::MAX,
        dropped_steps: u32::MAX,
    }));
    assert!(2 * refused + finished <= REPLY_RESERVE);

    let step = length(Event::Frame(Frame::Step { step: u32::MAX, digest: u64::MAX }));
    let statistics = length(Event::Frame(Frame::Statistics(Statistics {
        step: u32::MAX,
        contacts: u16::MAX,
        contacts_peak: u16::MAX,
        contacts_lost: u32::MAX,
        bodies: u16::MAX,
        escaped: u16::MAX,
        saturations: u32::MAX,
        backlog_us: u64::MAX,
        dropped_detail: u32::MAX,
        dropped_steps: u32::MAX,
    })));
    assert!(60 / 4 * step + statistics <= STEP_RESERVE);
}

/// What may happen to a ring.
#[derive(Clone, Debug)]
enum Act {
    Push(Class, Vec<u8>),
    Read(usize),
}

impl Act {
    fn any() -> impl Strategy<Value = Self> {
        let class = prop_oneof![Just(Class::Detail), Just(Class::Step), Just(Class::Reply)];
        prop_oneof![
            2 => (class, vec(any::<u8>(), 1..=MAX_FRAME)).prop_map(|(class, frame)| Self::Push(class, frame)),
            1 => (0..MAX_FRAME).prop_map(Self::Read),
        ]
    }
}

proptest! {
    #[test]
    fn frames_leave_whole_and_in_order(acts in vec(Act::any(), 0..60)) {
        let mut ring = Ring::<SMALLEST>::new();
        let mut model = VecDeque::new();
        for act in acts {
            match act {
                Act::Push(class, frame) => {
                    let limit = match class {
                        Class::Detail => SMALLEST - STEP_RESERVE - REPLY_RESERVE,
                        Class::Step => SMALLEST - REPLY_RESERVE,
                        Class::Reply => SMALLEST,
                    };
                    let fits = model.len() + frame.len() <= limit;
                    prop_assert_eq!(ring.room(class) >= frame.len(), fits);
                    prop_assert_eq!(ring.push(class, &frame), fits);
                    if fits {
                        model.extend(frame);
                    }
                }
                Act::Read(length) => {
                    let mut chunk = vec![0; length];
                    let count = ring.read(&mut chunk);
                    let expected: Vec<u8> = model.drain(..length.min(model.len())).collect();
                    prop_assert_eq!(&chunk[..count], expected);
                }
            }
            prop_assert_eq!(ring.is_empty(), model.is_empty());
        }
    }
}
