//! The end of a device that failed: says why on the link, between two frame delimiters, and ends QEMU with a status.

use core::fmt::{self, Write};
use core::panic::PanicInfo;

use riscv::register::{mcause, mepc, mtval};
use riscv_rt::TrapFrame;

use super::register::Register;
use super::uart;

// SAFETY: the `virt` machine's test device.
const FINISHER: Register<u32> = unsafe { Register::at(0x0010_0000) };
/// Ends QEMU; the exit status stands in the upper half.
const FAIL: u32 = 0x3333;
/// As a panic of a program on a host.
const PANIC_STATUS: u32 = 101;
const TRAP_STATUS: u32 = 102;

/// Writes to the port, whoever else was writing.
struct Port;

impl Write for Port {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        uart::send_blocking(text.as_bytes());
        Ok(())
    }
}

#[panic_handler]
fn on_panic(info: &PanicInfo<'_>) -> ! {
    end(PANIC_STATUS, format_args!("{info}"))
}

/// Called by riscv-rt for every exception: no code here means to cause one.
#[unsafe(export_name = "ExceptionHandler")]
extern "C" fn on_exception(_: &TrapFrame) -> ! {
    let (cause, pc, value) = (mcause::read().code(), mepc::read(), mtval::read());
    end(TRAP_STATUS, format_args!("exception {cause} at {pc:#010x}, mtval {value:#010x}"))
}

fn end(status: u32, reason: fmt::Arguments<'_>) -> ! {
    // The port never fails.
    let _ = write!(Port, "\0{reason}\n\0");
    FINISHER.write(status << 16 | FAIL);
    loop {
        riscv::asm::wfi();
    }
}
