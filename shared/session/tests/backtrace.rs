//! Calls are found on a stack by the instruction in front of their return address.

use flat_session::return_addresses;
use flat_wire::message::BACKTRACE;

/// Where the code below begins.
const BASE: u32 = 0x4200_0000;

/// Code by halfwords: what the address behind each line follows.
const CODE: [u16; 12] = [
    0x0001, 0x0001, // 4: c.nop
    0x00EF, 0x0100, // 8: jal ra, 16
    0x80E7, 0x0005, // 12: jalr ra, a1
    0x9582, 0x2021, // 14: c.jalr a1; 16: c.jal 8
    0x806F, 0x0000, // 20: jal x0, a jump
    0x8067, 0x0000, // 24: ret
];

fn code(address: u32) -> Option<u16> {
    let offset = address.checked_sub(BASE)?;
    CODE.get(offset as usize / 2).copied()
}

fn found(offsets: &[u32]) -> Vec<u32> {
    let words = offsets.iter().map(|offset| BASE.wrapping_add(*offset));
    return_addresses(words, code).iter().map(|address| address - BASE).collect()
}

#[test]
fn what_follows_a_call_is_a_return_address_and_nothing_else_is() {
    assert_eq!(found(&(0..24).collect::<Vec<_>>()), [8, 12, 14, 16]);
    assert!(found(&[24]).is_empty());
}

#[test]
fn words_outside_the_code_are_passed_over() {
    assert_eq!(found(&[u32::MAX - BASE, 0u32.wrapping_sub(BASE), 8, 1000, 2u32.wrapping_sub(BASE), 16]), [8, 16]);
}

#[test]
fn a_recursion_is_given_once() {
    assert_eq!(found(&[16, 8, 8, 8, 8, 12, 8]), [16, 8, 12, 8]);
}

#[test]
fn a_trace_ends_when_it_is_full() {
    let deep: Vec<_> = [8, 12].into_iter().cycle().take(10 * BACKTRACE).collect();
    assert_eq!(found(&deep), deep[..BACKTRACE]);
}
