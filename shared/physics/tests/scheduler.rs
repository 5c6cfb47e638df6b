//! Time becomes steps, exactly.

use core::num::NonZero;

use flat_physics::scalar::px;
use flat_physics::{BodyDef, Effects, Fixed, Pace, Scheduler, Shape, Storage, digest, step, vec2};
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
    let take = |us| {
        let mut scheduler = Scheduler::new(Pace::DESKTOP);
        scheduler.elapse(us);
        scheduler.take()
    };
    assert_eq!([take(17_000), take(34_000), take(49_000), take(3_000_000)], [1, 2, 2, 4]);
}

#[test]
fn screens_of_30_and_120_hz_get_evenly_spaced_steps() {
    for (frame_us, pace, allowed) in
        [(33_333, Pace::DESKTOP, 1..=2), (16_667, Pace::DEFAULT, 1..=1), (8_333, Pace::DEFAULT, 0..=1)]
    {
        let mut scheduler = Scheduler::new(pace);
        let frames = 10_000_000 / frame_us;
        let steps = (0..frames).map(|frame| {
            scheduler.elapse(frame_us);
            let steps = scheduler.take();
            assert!(allowed.contains(&steps), "{steps} steps in frame {frame} of {frame_us} us");
            u64::from(steps)
        });
        let steps: u64 = steps.sum();
        assert!((599..=600).contains(&steps), "{steps} steps in ten seconds of {frame_us} us");
    }
}

#[test]
fn every_pace_is_kept() {
    let pace = |normal, catch_up| Pace {
        normal: NonZero::new(normal).unwrap(),
        catch_up: NonZero::new(catch_up).unwrap(),
        ..Pace::DEFAULT
    };
    for (pace, us, steps) in [(pace(1, 3), 1_000_000, 3), (pace(3, 1), 1_000_000, 1), (pace(3, 1), 41_000, 2)] {
        let mut scheduler = Scheduler::new(pace);
        scheduler.elapse(us);
        assert_eq!(scheduler.take(), steps, "{pace:?}");
    }
}

#[test]
fn what_exceeds_the_limit_is_discarded_and_counted() {
    let mut scheduler = Scheduler::new(Pace { limit: NonZero::new(6), ..Pace::DEFAULT });
    scheduler.elapse(100_000);
    assert_eq!((scheduler.backlog_us(), scheduler.discarded_us()), (100_000, 0));
    scheduler.elapse(50_000);
    assert_eq!((scheduler.backlog_us(), scheduler.discarded_us()), (100_000, 50_000));
    assert_eq!((scheduler.take(), scheduler.take(), scheduler.take(), scheduler.take()), (4, 1, 1, 0));
    scheduler.elapse(1_000_000);
    assert_eq!((scheduler.backlog_us(), scheduler.discarded_us()), (100_000, 950_000));
}

#[test]
fn a_world_ends_in_the_same_state_however_its_seconds_are_fed() {
    let run = |pace: Pace, chunks: &[u64]| {
        let mut storage = Storage::<Fixed, 8, 32>::new();
        let mut world = storage.world();
        let shape = Shape::Box { half: vec2(px(100), px(5)) };
        world.spawn(&BodyDef::fixed(shape, vec2(px(0), px(100)))).unwrap();
        for n in 0..6 {
            world.spawn(&BodyDef::rigid(Shape::Circle { radius: px(5) }, vec2(px(n * 7), px(n * -9)))).unwrap();
        }
        let mut scheduler = Scheduler::new(pace);
        let mut chunks = chunks.iter();
        while world.statistics().steps < 180 {
            scheduler.elapse(chunks.next().copied().unwrap_or(0));
            (0..scheduler.take()).for_each(|_| step(&mut world, Effects::ALL));
        }
        (digest(&world), world.statistics().steps, scheduler.backlog_us())
    };
    let whole = run(Pace::DEFAULT, &[3_000_000]);
    assert_eq!((whole.1, whole.2), (180, 0));
    let mut random = vec![7_000, 61_000, 1, 250_000, 16_667, 33_333, 400, 120_000];
    random.push(3_000_000 - random.iter().sum::<u64>());
    for chunks in [vec![16_000; 188], vec![33_000; 91], vec![100_000; 30], random] {
        let (end, steps, _) = run(Pace::DEFAULT, &chunks);
        assert_eq!((end, steps), (whole.0, 180), "{} chunks", chunks.len());
        assert_eq!(run(Pace::DESKTOP, &chunks).0, whole.0, "{} chunks", chunks.len());
    }
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
