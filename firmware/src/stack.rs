//! How deep the stack ever was: its free part is painted at the start, and what has lost its paint was used.

use core::ops::Range;
use core::ptr;

use flat_wire::message::Stack;

use crate::board::machine;

/// What nothing writes by chance.
const PAINT: u32 = 0xF1A7_57AC;

/// Left unpainted below the caller, for `paint` itself and for an interrupt meanwhile.
const MARGIN: usize = 512;

/// Paints the free part of the stack. Called once, early.
pub(crate) fn paint() {
    let marker = 0_u32;
    let top = ptr::from_ref(&marker).addr() - MARGIN;
    for address in words(machine::stack().start..top) {
        // SAFETY: a word of the stack's free part: above its guard, and further below this frame than anything that runs
        // meanwhile reaches.
        unsafe { ptr::write_volatile(ptr::with_exposed_provenance_mut(address), PAINT) };
    }
}

/// Size and deepest use so far. Reads the whole unused part, a few cycles a word: not for the physics task.
pub(crate) fn measure() -> Stack {
    let stack = machine::stack();
    let unused = words(stack.clone()).take_while(|&address| {
        // SAFETY: a word of the stack; whoever writes it meanwhile makes it used, whatever is read.
        unsafe { ptr::read_volatile(ptr::with_exposed_provenance::<u32>(address)) == PAINT }
    });
    // The guard isn't painted, and can't be used.
    let unused = machine::GUARD + 4 * unused.count();
    Stack { size: stack.len() as u32, peak: (stack.len() - unused) as u32 }
}

/// The words in a part of the stack, its guard left out.
fn words(part: Range<usize>) -> impl Iterator<Item = usize> {
    (part.start + machine::GUARD..part.end).step_by(4)
}
