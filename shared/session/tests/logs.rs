//! Log messages reach the line whole, or not at all and counted.

use flat_session::Logs;
use flat_wire::message::{Frame, LOG_BYTES};

fn log<const N: usize>(logs: &mut Logs<N>, parts: &[&[u8]]) {
    logs.begin();
    for part in parts {
        logs.append(part);
    }
    logs.end();
}

/// All that waits: the bytes, and how many messages were lost.
fn drain<const N: usize>(logs: &mut Logs<N>) -> (Vec<u8>, u32) {
    let (mut all, mut count) = (Vec::new(), 0);
    while let Some(Frame::Log { lost, bytes }) = logs.take() {
        assert!(bytes.len() == LOG_BYTES || bytes.len() + all.len() <= N);
        all.extend_from_slice(&bytes);
        count = lost;
    }
    (all, count)
}

#[test]
fn messages_leave_in_the_order_in_which_they_came() {
    let mut logs = Logs::<32>::new();
    log(&mut logs, &[b"one ", b"two "]);
    log(&mut logs, &[b"three"]);
    assert_eq!(drain(&mut logs), (b"one two three".to_vec(), 0));
    assert_eq!(logs.take(), None);
}

#[test]
fn a_message_that_does_not_fit_is_lost_as_a_whole_and_leaves_no_trace() {
    let mut logs = Logs::<8>::new();
    log(&mut logs, &[b"abcde"]);
    log(&mut logs, &[b"fg", b"hij", b"k"]);
    log(&mut logs, &[b"xyz"]);
    assert_eq!(drain(&mut logs), (b"abcdexyz".to_vec(), 1));
    log(&mut logs, &[b"later"]);
    assert_eq!(drain(&mut logs), (b"later".to_vec(), 1));
}

#[test]
fn a_message_under_way_is_not_sent_before_its_end() {
    let mut logs = Logs::<16>::new();
    log(&mut logs, &[b"whole"]);
    logs.begin();
    logs.append(b"half");
    assert_eq!(drain(&mut logs), (b"whole".to_vec(), 0));
    logs.end();
    assert_eq!(drain(&mut logs), (b"half".to_vec(), 0));
}

#[test]
fn what_exceeds_a_frame_is_cut_over_several() {
    let mut logs = Logs::<1024>::new();
    let message: Vec<u8> = (0..=255).cycle().take(3 * LOG_BYTES / 2).collect();
    log(&mut logs, &[&message]);
    assert_eq!(drain(&mut logs), (message, 0));
}
