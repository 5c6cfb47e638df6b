//! Calls of the simulator: its host's files, and the end.

use core::fmt::{self, Write};
use core::panic::PanicInfo;

const STDIN: u32 = 0;
const STDOUT: u32 = 1;
const STDERR: u32 = 2;

/// Exit code of a panic.
const PANICKED: u32 = 101;

unsafe extern "C" {
    // See `start.S`.
    safe fn simulator_exit(code: u32) -> !;
    fn simulator_read(file: u32, buffer: *mut u8, length: usize) -> isize;
    fn simulator_write(file: u32, bytes: *const u8, length: usize) -> isize;
}

/// Waits for bytes. Ends the program where there are no more to come.
pub(crate) fn read(buffer: &mut [u8]) -> &[u8] {
    // SAFETY: the simulator writes to so many bytes at most, and they are ours.
    let count = unsafe { simulator_read(STDIN, buffer.as_mut_ptr(), buffer.len()) };
    match usize::try_from(count) {
        Ok(count @ 1..) => &buffer[..count],
        _ => simulator_exit(0),
    }
}

/// Writes bytes, all of them. Ends the program where nobody takes them.
pub(crate) fn write(bytes: &[u8]) {
    write_to(STDOUT, bytes);
}

fn write_to(file: u32, mut bytes: &[u8]) {
    while !bytes.is_empty() {
        // SAFETY: the simulator reads so many bytes.
        let count = unsafe { simulator_write(file, bytes.as_ptr(), bytes.len()) };
        match usize::try_from(count) {
            Ok(count @ 1..) => bytes = &bytes[count..],
            _ => simulator_exit(0),
        }
    }
}

struct Stderr;

impl Write for Stderr {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        write_to(STDERR, text.as_bytes());
        Ok(())
    }
}

#[panic_handler]
fn on_panic(info: &PanicInfo<'_>) -> ! {
    // Writing there can't fail.
    let _ = writeln!(Stderr, "{info}");
    simulator_exit(PANICKED)
}
