//! What all probes share: how they speak to rig's interpreter, and which effects they are built for.
//!
//! A probe is entered at `probe`, with its arguments in registers, a stack, and zeroed statics. It speaks by `ecall`.
#![no_std]
#![deny(missing_docs, clippy::undocumented_unsafe_blocks)]

pub mod game;

use core::arch::asm;

/// A mark: what is executed up to the next one is counted apart. Its argument says what comes next.
pub const MARK: u32 = 1;
/// The end: two halves of the world's digest.
pub const END: u32 = 2;
/// A panic, or a scene that cannot be built.
pub const FAIL: u32 = 3;

/// The effects that this build is for, as bits; none = they are an argument. `FLAT_PROBE_EFFECTS` when compiled.
pub const EFFECTS: Option<u16> = match option_env!("FLAT_PROBE_EFFECTS") {
    Some(digits) => Some(decimal(digits.as_bytes())),
    None => None,
};

/// Digits to a number.
const fn decimal(digits: &[u8]) -> u16 {
    let mut number = 0;
    let mut index = 0;
    while index < digits.len() {
        assert!(digits[index].is_ascii_digit(), "FLAT_PROBE_EFFECTS must be a decimal number");
        number = number * 10 + (digits[index] - b'0') as u16;
        index += 1;
    }
    number
}

/// Calls the interpreter.
pub fn call(function: u32, arguments: [u32; 2]) {
    // SAFETY: the interpreter reads these registers and changes nothing.
    unsafe {
        asm!("ecall", in("a7") function, in("a0") arguments[0], in("a1") arguments[1], options(nostack));
    }
}

/// Ends the probe.
pub fn end(function: u32, arguments: [u32; 2]) -> ! {
    loop {
        call(function, arguments);
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    end(FAIL, [0; 2])
}
