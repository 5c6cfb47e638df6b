//! Unit tests that run on the device, each after a reset: what only the target's memory, clock and compiler can show.
//!
//! They take no link. A test runner reads their names from the image, and talks to them through semihosting: probe-rs over a
//! debug probe, `rig test` in QEMU.

use core::panic::PanicInfo;

#[panic_handler]
fn on_panic(info: &PanicInfo<'_>) -> ! {
    semihosting::eprintln!("{info}");
    semihosting::process::abort()
}

#[embedded_test::tests(default_timeout = 20)]
mod on_target {
    use core::hint::black_box;

    use embassy_time::{Duration, Instant};
    use flat_physics::{Fixed, Level, Scalar, Storage, World, digest, step};
    use flat_scenes::{Cue, Memory};
    use flat_wire::MAX_FRAME;
    use flat_wire::message::Cause;
    use static_cell::ConstStaticCell;

    use crate::board::{self, machine};
    use crate::{Parts, fault, stack};

    /// The scenes' digests as the engine's own tests know them: a line each, in fixed point, binary32 and binary64.
    const DIGESTS: &str = include_str!("../../shared/scenes/tests/digests.txt");

    #[init]
    fn boot() -> Parts {
        board::boot()
    }

    #[test]
    fn a_scene_ends_in_the_known_bits_in_fixed_point() {
        static STORAGE: ConstStaticCell<Storage<Fixed, 16, 64>> = ConstStaticCell::new(Storage::new());
        ends_in_the_known_bits("drop", 0, STORAGE.take().world());
    }

    #[test]
    fn a_scene_ends_in_the_known_bits_in_binary32() {
        static STORAGE: ConstStaticCell<Storage<f32, 16, 64>> = ConstStaticCell::new(Storage::new());
        ends_in_the_known_bits("drop", 1, STORAGE.take().world());
    }

    #[test]
    fn the_clock_goes_on_and_never_back() {
        let start = Instant::now();
        let mut last = start;
        while last - start < Duration::from_millis(2) {
            let now = Instant::now();
            assert!(now >= last, "{} us came after {} us", now.as_micros(), last.as_micros());
            last = now;
        }
    }

    #[test]
    fn the_counter_counts(parts: Parts) {
        let Parts { counter, .. } = parts;
        let before = counter.count();
        for number in 0..1000 {
            black_box(number);
        }
        let counted = counter.count().wrapping_sub(before);
        assert!((1000..1_000_000).contains(&counted), "{counted} in a thousand turns of a loop");
    }

    #[test]
    fn the_stack_remembers_its_deepest_use() {
        const FRAME: usize = 2048;
        let before = stack::measure();
        use_up::<FRAME>();
        let after = stack::measure();
        assert_eq!(after.size, machine::stack().len() as u32);
        assert!(after.peak >= before.peak.max(FRAME as u32), "{} bytes, then {}", before.peak, after.peak);
        assert!(after.peak < after.size, "{} of {} bytes", after.peak, after.size);
    }

    #[test]
    fn last_words_are_kept_until_they_are_read() {
        let words = b"last words of an odd length";
        fault::keep(words);
        assert_eq!(fault::cause(), Cause::Fault);
        let mut buffer = [0; MAX_FRAME];
        assert_eq!(fault::last_words(&mut buffer), words);
        assert!(fault::last_words(&mut buffer).is_empty());
        assert_ne!(fault::cause(), Cause::Fault);
    }

    /// Where code waits for no cache.
    #[test]
    #[cfg(feature = "_esp")]
    fn the_hot_path_lies_in_instruction_ram() {
        let ram = if cfg!(feature = "esp32") { 0x4007_0000..0x400A_0000 } else { 0x4037_C000..0x403E_0000 };
        let tick = flat_session::Session::tick as *const () as usize;
        assert!(ram.contains(&tick), "Session::tick is at {tick:#010x}");
    }

    fn ends_in_the_known_bits<S: Scalar>(name: &str, column: usize, mut world: World<'_, S>) {
        let scene = flat_scenes::find(name).expect("the catalogue has it");
        scene.build(&scene.defaults, Level::Grounded, &mut world).expect("the room is enough");
        let mut memory = Memory::default();
        for step_number in 1..=scene.steps {
            let cue = Cue::unattended(step_number);
            scene.direct(&scene.defaults, cue, &mut memory, &mut world).expect("the scene knows its bodies");
            step(&mut world, scene.effects);
        }
        let line =
            DIGESTS.lines().find(|line| line.split_whitespace().next() == Some(name)).expect("a line each scene");
        let known = line.split_whitespace().nth(1 + column).expect("a column each format");
        assert_eq!(u64::from_str_radix(known, 16), Ok(digest(&world)));
    }

    /// Writes to so many bytes of the stack.
    #[inline(never)]
    fn use_up<const BYTES: usize>() {
        black_box(&mut [1_u8; BYTES]);
    }
}
