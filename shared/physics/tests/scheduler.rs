//! Time becomes steps, exactly.

use flat_physics::{Pace, Scheduler};
use proptest::prelude::*;

/// Feeds the chunks and then runs until nothing is due.
fn steps(pace: Pace, chunks: &[u64]) -> u64 {
    let mut scheduler = Scheduler::new(pace);
    let mut steps = 0;
    for &chunk in chunks {
        scheduler.elapse(chunk);
        steps += u64::from(scheduler.take());
    }
    while scheduler.until_due_us() == 0 {
        steps += u64::from(scheduler.take());
    }
    steps
}

#[test]
fn the_same_seconds_make_the_same_steps_however_they_are_fed() {
    for chunks in [vec![16_000; 375], vec![33_000; 182], vec![6_000_000], vec![16_667; 360]] {
        let us: u64 = chunks.iter().sum();
        assert_eq!(steps(Pace::DEFAULT, &chunks), us * 60 / 1_000_000, "{} chunks", chunks.len());
    }
}

#[test]
fn a_second_is_sixty_steps_for_a_day() {
    assert_eq!(steps(Pace::DEFAULT, &vec![1_000_000; 86_400]), 60 * 86_400);
}

#[test]
fn one_step_at_a_time_until_more_than_two_and_a_half_behind() {
    let take = |us| {
        let mut scheduler = Scheduler::new(Pace::DEFAULT);
        scheduler.elapse(us);
        (scheduler.take(), scheduler.backlog_us())
    };
    assert_eq!(take(16_666), (0, 16_666));
    assert_eq!(take(16_667), (1, 0));
    assert_eq!(take(41_666), (1, 24_999)); // 2.49996 steps
    assert_eq!(take(41_667), (2, 8_333)); // 2.50002 steps
    assert_eq!(take(3_000_000), (4, 2_933_333)); // nothing is discarded
}

#[test]
fn a_desktop_may_take_two_steps_at_a_time() {
    let mut scheduler = Scheduler::new(Pace { normal: 2, ..Pace::DEFAULT });
    scheduler.elapse(34_000);
    assert_eq!(scheduler.take(), 2);
}

#[test]
fn waiting_as_long_as_it_says_makes_a_step_due_and_no_less() {
    let mut scheduler = Scheduler::default();
    for _ in 0..1000 {
        let wait = scheduler.until_due_us();
        scheduler.elapse(wait - 1);
        assert_eq!(scheduler.take(), 0);
        scheduler.elapse(1);
        assert_eq!(scheduler.take(), 1);
    }
}

proptest! {
    #[test]
    fn no_chunks_lose_time(chunks in prop::collection::vec(0u64..200_000, 0..200)) {
        let us: u64 = chunks.iter().sum();
        prop_assert_eq!(steps(Pace::DEFAULT, &chunks), us * 60 / 1_000_000);
    }

    #[test]
    fn absurd_times_saturate(chunks in prop::collection::vec(any::<u64>(), 1..5)) {
        let mut scheduler = Scheduler::default();
        for chunk in chunks {
            scheduler.elapse(chunk);
            scheduler.take();
        }
    }
}
