//! What the RISC-V boards share: exceptions, and the trail of calls on their one stack.

use core::arch::asm;
use core::ops::Range;
use core::ptr;

use flat_wire::message::{BACKTRACE, FaultKind};
use heapless::Vec;
use riscv::register::{mcause, mepc, mtval};
use riscv_rt::TrapFrame;

use super::machine;
use crate::fault;

/// Exception codes.
const BREAKPOINT: usize = 3;
const STORE_FAULT: usize = 7;
/// Espressif's start-up code, for a stack pointer that has left the RAM.
const STACK_LEFT: usize = 14;

/// Called for every exception; no code here means to cause one.
#[unsafe(export_name = "ExceptionHandler")]
extern "C" fn on_exception(frame: &TrapFrame) -> ! {
    let (cause, pc, value) = (mcause::read().code(), mepc::read(), mtval::read());
    let stack = ptr::from_ref(frame).addr() + size_of::<TrapFrame>();
    let trail = trail(pc, stack);
    let guard = machine::stack().start;
    let is_guard = matches!(cause, BREAKPOINT | STORE_FAULT)
        && (guard - machine::reserve()..guard + machine::GUARD).contains(&value);
    if cause == STACK_LEFT || is_guard {
        let size = machine::stack().len();
        fault::report(FaultKind::StackOverflow, format_args!("all {size} bytes of the stack are used"), None, trail)
    }
    let name = name(cause);
    fault::report(FaultKind::Exception, format_args!("{name} ({cause}), mtval {value:#010x}"), None, trail)
}

/// The calls that led to the caller.
pub(crate) fn backtrace() -> Vec<u32, BACKTRACE> {
    return_addresses(stack_pointer())
}

/// For a handler that nothing interrupts: where the program was when the interrupt came, and the calls that led there, after
/// the handler's own.
pub(crate) fn trail_of_interrupted() -> Vec<u32, BACKTRACE> {
    trail(mepc::read(), stack_pointer())
}

/// A place in the code, and the calls that led there, given the stack pointer.
fn trail(pc: usize, stack: usize) -> Vec<u32, BACKTRACE> {
    let mut trail = Vec::new();
    let calls = return_addresses(stack);
    // One place is kept for the pc; the outermost call gives way.
    let _ = trail.push(pc as u32);
    trail.extend(calls.into_iter().take(BACKTRACE - 1));
    trail
}

fn stack_pointer() -> usize {
    let stack;
    // SAFETY: reads a register.
    unsafe { asm!("mv {}, sp", out(reg) stack, options(nomem, nostack, preserves_flags)) };
    stack
}

/// Calls under way, given the stack pointer.
fn return_addresses(stack: usize) -> Vec<u32, BACKTRACE> {
    let Range { start, end } = machine::stack();
    let words = (stack.next_multiple_of(4).max(start - machine::reserve())..end).step_by(4).map(|address| {
        // SAFETY: a word of the stack, which is RAM that holds plain words.
        unsafe { ptr::read_volatile(ptr::with_exposed_provenance::<u32>(address)) }
    });
    flat_session::return_addresses(words, |address| {
        let address = address as usize;
        // SAFETY: halfwords of code, which is never written.
        machine::is_code(address).then(|| unsafe { ptr::read_volatile(ptr::with_exposed_provenance::<u16>(address)) })
    })
}

/// Runs into an instruction that no processor has.
#[cfg(feature = "provoke")]
pub(crate) fn illegal_instruction() -> ! {
    // SAFETY: ends in the exception handler, which doesn't return.
    unsafe { asm!("unimp", options(noreturn)) }
}

/// The privileged architecture's name of an exception.
fn name(cause: usize) -> &'static str {
    match cause {
        0 => "misaligned instruction address",
        1 => "instruction access fault",
        2 => "illegal instruction",
        BREAKPOINT => "breakpoint",
        4 => "misaligned load",
        5 => "load access fault",
        6 => "misaligned store",
        STORE_FAULT => "store access fault",
        _ => "exception",
    }
}
