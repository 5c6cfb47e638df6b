//! Who called whom, read off a RISC-V stack without frame pointers.

use flat_wire::message::BACKTRACE;
use heapless::Vec;

/// The return addresses on a stack, innermost first.
///
/// A word counts as one if it points behind a call: `jal` or `jalr` that leave their return address in `ra`, or their
/// compressed forms. An address that a function left on the stack some time ago counts as well, so a trace may name calls that
/// had returned. Equal neighbours, of a recursion, are given once.
///
/// `words` are the stack's, from its top towards its base; `code` reads 16 bits of code, none where there is no code.
pub fn return_addresses(words: impl Iterator<Item = u32>, code: impl Fn(u32) -> Option<u16>) -> Vec<u32, BACKTRACE> {
    let mut addresses = Vec::new();
    for word in words.filter(|&word| follows_call(word, &code)) {
        if addresses.last() != Some(&word) && addresses.push(word).is_err() {
            break;
        }
    }
    addresses
}

/// Whether the instruction before an address is a call.
fn follows_call(address: u32, code: impl Fn(u32) -> Option<u16>) -> bool {
    const RA: u32 = 1;
    if !address.is_multiple_of(2) {
        return false;
    }
    let Some(last) = address.checked_sub(2).and_then(&code) else {
        return false;
    };
    // C.JAL; C.JALR with a source register that isn't x0.
    if last & 0xE003 == 0x2001 || (last & 0xF07F == 0x9002 && last & 0x0F80 != 0) {
        return true;
    }
    let Some(first) = address.checked_sub(4).and_then(&code) else {
        return false;
    };
    let instruction = u32::from(last) << 16 | u32::from(first);
    // JAL; JALR with its funct3.
    (instruction & 0x7F == 0x6F || instruction & 0x707F == 0x67) && instruction >> 7 & 0x1F == RA
}
