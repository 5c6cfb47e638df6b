//! Ways to fail, on request: what a fault leaves behind is tested by causing it.

use core::hint::black_box;

use flat_wire::message::Mishap;

use crate::board;

/// Messages of a storm.
const STORM: u32 = 1000;

/// Comes to grief on the link's executor, if that is the place for it.
pub(crate) fn on_link(mishap: Mishap) {
    match mishap {
        Mishap::LinkHangs => hang(),
        Mishap::Deaf => critical_section::with(|_| hang()),
        Mishap::LogStorm => (0..STORM).for_each(|number| defmt::warn!("message {=u32} of a storm", number)),
        Mishap::Panic | Mishap::IllegalInstruction | Mishap::StackOverflow | Mishap::PhysicsHangs => {}
    }
}

/// Comes to grief on the executor for physics, if that is the place for it.
pub(crate) fn on_physics(mishap: Mishap) {
    match mishap {
        Mishap::Panic => panic!("provoked, with a message that is long enough to be read by somebody"),
        Mishap::IllegalInstruction => board::illegal_instruction(),
        Mishap::StackOverflow => drop(black_box(descend(0))),
        Mishap::PhysicsHangs => hang(),
        Mishap::LinkHangs | Mishap::Deaf | Mishap::LogStorm => {}
    }
}

fn hang() -> ! {
    loop {
        core::hint::spin_loop();
    }
}

/// Uses up the stack.
#[expect(unconditional_recursion, reason = "that is what it is for")]
#[inline(never)]
fn descend(depth: u32) -> u32 {
    // With the return address and a pointer: twenty words, none of them left out. One word at the stack's end is watched.
    let mut frame = [depth; 18];
    black_box(&mut frame);
    descend(depth + 1).wrapping_add(frame[0])
}
