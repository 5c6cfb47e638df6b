//! What an rv32imc instruction does to registers that hold addresses, and where control goes from it.
//!
//! Encodings: *The RISC-V Instruction Set Manual*, volume I, "RV32/64G Instruction Set Listings" and "C extension".

use super::instructions::Instruction;

/// A register's number, 0 to 31.
pub(crate) type Register = u8;

/// Return address.
pub(crate) const RA: Register = 1;
const SP: Register = 2;

/// An instruction's effect, as far as addresses are concerned. Distances count from the instruction itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operation {
    /// `lui`: a constant whose low 12 bits are zero.
    Constant { to: Register, value: u32 },
    /// `auipc`: the same, counted from the instruction.
    Relative { to: Register, distance: u32 },
    /// `addi`, and `mv` as `addi` of zero.
    Offset { to: Register, from: Register, by: u32 },
    /// `add`.
    Sum { to: Register, of: [Register; 2] },
    /// Any load.
    Load { to: Register, base: Register, offset: u32 },
    /// Any store.
    Store { base: Register, offset: u32 },
    /// A conditional branch.
    Branch { distance: u32 },
    /// `jal`; to `x0` it is a plain jump.
    Jump { link: Register, distance: u32 },
    /// `jalr`.
    JumpRegister { link: Register, base: Register, offset: u32 },
    /// `mret`.
    Return,
    /// Anything else, and the register that it writes; `x0` if none.
    Other { to: Register },
}

impl Operation {
    /// Decodes an instruction of rv32imc with Zicsr.
    pub(crate) fn of(instruction: Instruction) -> Self {
        if instruction.length == 2 { compressed(instruction.word) } else { full(instruction.word) }
    }
}

fn full(word: u32) -> Operation {
    const MRET: u32 = 0x3020_0073;
    let register = |from: u32| field(word, from, 5) as Register;
    let (to, first, second) = (register(7), register(15), register(20));
    let function = field(word, 12, 3);
    let immediate = sign_extend(word >> 20, 12);
    match word & 0x7f {
        0x37 => Operation::Constant { to, value: word & 0xffff_f000 },
        0x17 => Operation::Relative { to, distance: word & 0xffff_f000 },
        0x13 if function == 0 => Operation::Offset { to, from: first, by: immediate },
        0x33 if function == 0 && word >> 25 == 0 => Operation::Sum { to, of: [first, second] },
        0x03 => Operation::Load { to, base: first, offset: immediate },
        0x23 => Operation::Store { base: first, offset: sign_extend(field(word, 25, 7) << 5 | field(word, 7, 5), 12) },
        0x63 => {
            let high = field(word, 31, 1) << 12 | field(word, 7, 1) << 11;
            let low = field(word, 25, 6) << 5 | field(word, 8, 4) << 1;
            Operation::Branch { distance: sign_extend(high | low, 13) }
        }
        0x6f => {
            let high = field(word, 31, 1) << 20 | field(word, 12, 8) << 12;
            let low = field(word, 20, 1) << 11 | field(word, 21, 10) << 1;
            Operation::Jump { link: to, distance: sign_extend(high | low, 21) }
        }
        0x67 => Operation::JumpRegister { link: to, base: first, offset: immediate },
        _ if word == MRET => Operation::Return,
        // Fences write no register: their `to` field is zero.
        _ => Operation::Other { to },
    }
}

fn compressed(half: u32) -> Operation {
    let register = |from: u32| field(half, from, 5) as Register;
    // Three bits name the eight registers from x8 on.
    let popular = |from: u32| field(half, from, 3) as Register + 8;
    let (to, second) = (register(7), register(2));
    let word_offset = field(half, 10, 3) << 3 | field(half, 6, 1) << 2 | field(half, 5, 1) << 6;
    match (half & 0b11, half >> 13) {
        (0b00, 0b010) => Operation::Load { to: popular(2), base: popular(7), offset: word_offset },
        (0b00, 0b110) => Operation::Store { base: popular(7), offset: word_offset },
        (0b00, _) => Operation::Other { to: popular(2) },
        (0b01, 0b000) => {
            let by = sign_extend(field(half, 12, 1) << 5 | field(half, 2, 5), 6);
            Operation::Offset { to, from: to, by }
        }
        (0b01, 0b001 | 0b101) => {
            let link = if half >> 13 == 0b001 { RA } else { 0 };
            Operation::Jump { link, distance: compressed_jump(half) }
        }
        (0b01, 0b010 | 0b011) => Operation::Other { to },
        (0b01, 0b110 | 0b111) => {
            let high = field(half, 12, 1) << 8 | field(half, 5, 2) << 6 | field(half, 2, 1) << 5;
            let low = field(half, 10, 2) << 3 | field(half, 3, 2) << 1;
            Operation::Branch { distance: sign_extend(high | low, 9) }
        }
        (0b01, _) => Operation::Other { to: popular(7) },
        (0b10, 0b010) => {
            let offset = field(half, 12, 1) << 5 | field(half, 4, 3) << 2 | field(half, 2, 2) << 6;
            Operation::Load { to, base: SP, offset }
        }
        (0b10, 0b110) => Operation::Store { base: SP, offset: field(half, 9, 4) << 2 | field(half, 7, 2) << 6 },
        (0b10, 0b100) => match (field(half, 12, 1), to, second) {
            (0, base, 0) => Operation::JumpRegister { link: 0, base, offset: 0 },
            (0, to, from) => Operation::Offset { to, from, by: 0 },
            // c.ebreak
            (_, 0, 0) => Operation::Other { to: 0 },
            (_, base, 0) => Operation::JumpRegister { link: RA, base, offset: 0 },
            (_, to, second) => Operation::Sum { to, of: [to, second] },
        },
        _ => Operation::Other { to },
    }
}

fn compressed_jump(half: u32) -> u32 {
    let bit = |from: u32, to: u32| field(half, from, 1) << to;
    let distance = bit(12, 11) | bit(11, 4) | field(half, 9, 2) << 8 | bit(8, 10) | bit(7, 6) | bit(6, 7);
    sign_extend(distance | field(half, 3, 3) << 1 | bit(2, 5), 12)
}

fn field(word: u32, from: u32, count: u32) -> u32 {
    (word >> from) & ((1 << count) - 1)
}

fn sign_extend(value: u32, width: u32) -> u32 {
    let unused = 32 - width;
    ((value << unused).cast_signed() >> unused).cast_unsigned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::firmware::instructions::decode;

    fn operation(code: &[u8]) -> Operation {
        Operation::of(decode(code).next().expect("one instruction"))
    }

    /// Encodings by GNU as 2.40.
    #[test]
    fn operations_are_what_the_assembler_was_told() {
        const S0: Register = 8;
        const A0: Register = 10;
        const A1: Register = 11;
        for (text, word, expected) in [
            ("lui a0, 0x3c004", 0x3c00_4537_u32, Operation::Constant { to: A0, value: 0x3c00_4000 }),
            ("auipc a0, 0x1c9e", 0x01c9_e517, Operation::Relative { to: A0, distance: 0x01c9_e000 }),
            ("addi a0, a1, -16", 0xff05_8513, Operation::Offset { to: A0, from: A1, by: 0xffff_fff0 }),
            ("add a0, a0, a1", 0x00b5_0533, Operation::Sum { to: A0, of: [A0, A1] }),
            ("sub a0, a0, a1", 0x40b5_0533, Operation::Other { to: A0 }),
            ("lw a0, -4(a1)", 0xffc5_a503, Operation::Load { to: A0, base: A1, offset: 0xffff_fffc }),
            ("sw a0, -4(a1)", 0xfea5_ae23, Operation::Store { base: A1, offset: 0xffff_fffc }),
            ("bne a0, a1, .-8", 0xfeb5_1ce3, Operation::Branch { distance: 0xffff_fff8 }),
            ("jal ra, .-4", 0xffdf_f0ef, Operation::Jump { link: RA, distance: 0xffff_fffc }),
            ("jal ra, .+0x12344", 0x3441_20ef, Operation::Jump { link: RA, distance: 0x1_2344 }),
            ("jalr ra, -16(a0)", 0xff05_00e7, Operation::JumpRegister { link: RA, base: A0, offset: 0xffff_fff0 }),
            ("mret", 0x3020_0073, Operation::Return),
            ("mul a0, a0, a1", 0x02b5_0533, Operation::Other { to: A0 }),
            ("fence", 0x0ff0_000f, Operation::Other { to: 0 }),
        ] {
            assert_eq!(operation(&word.to_le_bytes()), expected, "{text}");
        }
        for (text, half, expected) in [
            ("c.lw a0, 4(a1)", 0x41c8_u16, Operation::Load { to: A0, base: A1, offset: 4 }),
            ("c.sw a0, 64(a1)", 0xc1a8, Operation::Store { base: A1, offset: 64 }),
            ("c.addi a0, -1", 0x157d, Operation::Offset { to: A0, from: A0, by: u32::MAX }),
            ("c.j .-2", 0xbffd, Operation::Jump { link: 0, distance: 0xffff_fffe }),
            ("c.jal .+0x146", 0x2299, Operation::Jump { link: RA, distance: 0x146 }),
            ("c.beqz a0, .+8", 0xc501, Operation::Branch { distance: 8 }),
            ("c.bnez s0, .-2", 0xfc7d, Operation::Branch { distance: 0xffff_fffe }),
            ("c.jr a0", 0x8502, Operation::JumpRegister { link: 0, base: A0, offset: 0 }),
            ("c.jalr a0", 0x9502, Operation::JumpRegister { link: RA, base: A0, offset: 0 }),
            ("c.mv a0, a1", 0x852e, Operation::Offset { to: A0, from: A1, by: 0 }),
            ("c.add a0, a1", 0x952e, Operation::Sum { to: A0, of: [A0, A1] }),
            ("c.ebreak", 0x9002, Operation::Other { to: 0 }),
            ("c.lwsp a0, 12(sp)", 0x4532, Operation::Load { to: A0, base: SP, offset: 12 }),
            ("c.swsp ra, 12(sp)", 0xc606, Operation::Store { base: SP, offset: 12 }),
            ("c.srli s0, 4", 0x8011, Operation::Other { to: S0 }),
            ("c.li a0, 1", 0x4505, Operation::Other { to: A0 }),
        ] {
            assert_eq!(operation(&half.to_le_bytes()), expected, "{text}");
        }
    }
}
