//! The 16-bit instructions: each stands for one 32-bit instruction ("C" extension, RISC-V unprivileged manual, version 2.0).

const SP: u32 = 2;
const RA: u32 = 1;

/// The 32-bit instruction that a 16-bit one stands for; none if it stands for none of rv32imc.
pub fn expand(half: u16) -> Option<u32> {
    let half = u32::from(half);
    let (rd, rs2) = (field(half, 7, 5), field(half, 2, 5));
    let (small_high, small_low) = (field(half, 7, 3) + 8, field(half, 2, 3) + 8);
    let funct = half >> 13;
    Some(match (half & 0b11, funct) {
        // c.addi4spn
        (0, 0b000) => {
            let amount = bits(half, &[(12, 5), (11, 4), (10, 9), (9, 8), (8, 7), (7, 6), (6, 2), (5, 3)]);
            if amount == 0 {
                return None;
            }
            immediate(0x13, 0, small_low, SP, amount)
        }
        (0, 0b010) => immediate(0x03, 2, small_low, small_high, word_offset(half)),
        (0, 0b110) => store(small_high, small_low, word_offset(half)),
        // c.addi, c.nop
        (1, 0b000) => immediate(0x13, 0, rd, rd, six(half)),
        // c.jal, c.j
        (1, 0b001) => jump(RA, jump_offset(half)),
        (1, 0b101) => jump(0, jump_offset(half)),
        // c.li
        (1, 0b010) => immediate(0x13, 0, rd, 0, six(half)),
        (1, 0b011) if rd == SP => {
            let amount = bits(half, &[(12, 9), (6, 4), (5, 6), (4, 8), (3, 7), (2, 5)]);
            immediate(0x13, 0, SP, SP, signed(amount, 10))
        }
        // c.lui
        (1, 0b011) => six(half) << 12 | rd << 7 | 0x37,
        (1, 0b100) => arithmetic(half, small_high, small_low)?,
        // c.beqz, c.bnez
        (1, 0b110) => branch(0, small_high, branch_offset(half)),
        (1, 0b111) => branch(1, small_high, branch_offset(half)),
        // c.slli
        (2, 0b000) => immediate(0x13, 1, rd, rd, rs2),
        // c.lwsp
        (2, 0b010) => {
            let offset = bits(half, &[(12, 5), (6, 4), (5, 3), (4, 2), (3, 7), (2, 6)]);
            immediate(0x03, 2, rd, SP, offset)
        }
        (2, 0b100) => match (field(half, 12, 1), rd, rs2) {
            (0, 0, 0) => return None,
            // c.jr, c.mv
            (0, _, 0) => immediate(0x67, 0, 0, rd, 0),
            (0, ..) => register(0, 0, rd, 0, rs2),
            // c.ebreak, c.jalr, c.add
            (1, 0, 0) => 0x0010_0073,
            (1, _, 0) => immediate(0x67, 0, RA, rd, 0),
            _ => register(0, 0, rd, rd, rs2),
        },
        // c.swsp
        (2, 0b110) => {
            let offset = bits(half, &[(12, 5), (11, 4), (10, 3), (9, 2), (8, 7), (7, 6)]);
            store(SP, rs2, offset)
        }
        _ => return None,
    })
}

/// c.srli, c.srai, c.andi, c.sub, c.xor, c.or, c.and
fn arithmetic(half: u32, rd: u32, rs2: u32) -> Option<u32> {
    let amount = field(half, 2, 5);
    Some(match (field(half, 10, 2), field(half, 12, 1), field(half, 5, 2)) {
        (0, 0, _) => immediate(0x13, 5, rd, rd, amount),
        (1, 0, _) => immediate(0x13, 5, rd, rd, amount | 0x400),
        (2, ..) => immediate(0x13, 7, rd, rd, six(half)),
        (3, 0, 0) => register(0x20, 0, rd, rd, rs2),
        (3, 0, 1) => register(0, 4, rd, rd, rs2),
        (3, 0, 2) => register(0, 6, rd, rd, rs2),
        (3, 0, 3) => register(0, 7, rd, rd, rs2),
        _ => return None,
    })
}

fn field(word: u32, from: u32, width: u32) -> u32 {
    word >> from & ((1 << width) - 1)
}

/// Gathers bits of an immediate: from where in the instruction to where in the number.
fn bits(half: u32, places: &[(u32, u32)]) -> u32 {
    places.iter().fold(0, |number, (from, to)| number | (half >> from & 1) << to)
}

fn signed(number: u32, width: u32) -> u32 {
    let unused = 32 - width;
    ((number << unused).cast_signed() >> unused).cast_unsigned()
}

/// The signed immediate of six bits.
fn six(half: u32) -> u32 {
    signed(field(half, 12, 1) << 5 | field(half, 2, 5), 6)
}

/// Of c.lw and c.sw.
fn word_offset(half: u32) -> u32 {
    bits(half, &[(12, 5), (11, 4), (10, 3), (6, 2), (5, 6)])
}

fn jump_offset(half: u32) -> u32 {
    let places = [(12, 11), (11, 4), (10, 9), (9, 8), (8, 10), (7, 6), (6, 7), (5, 3), (4, 2), (3, 1), (2, 5)];
    signed(bits(half, &places), 12)
}

fn branch_offset(half: u32) -> u32 {
    signed(bits(half, &[(12, 8), (11, 4), (10, 3), (6, 7), (5, 6), (4, 2), (3, 1), (2, 5)]), 9)
}

fn immediate(opcode: u32, funct: u32, rd: u32, rs1: u32, amount: u32) -> u32 {
    (amount & 0xfff) << 20 | rs1 << 15 | funct << 12 | rd << 7 | opcode
}

fn register(high: u32, funct: u32, rd: u32, rs1: u32, rs2: u32) -> u32 {
    high << 25 | rs2 << 20 | rs1 << 15 | funct << 12 | rd << 7 | 0x33
}

fn store(base: u32, source: u32, offset: u32) -> u32 {
    field(offset, 5, 7) << 25 | source << 20 | base << 15 | 2 << 12 | field(offset, 0, 5) << 7 | 0x23
}

fn branch(funct: u32, rs1: u32, offset: u32) -> u32 {
    let (high, low) =
        (field(offset, 12, 1) << 6 | field(offset, 5, 6), field(offset, 1, 4) << 1 | field(offset, 11, 1));
    high << 25 | rs1 << 15 | funct << 12 | low << 7 | 0x63
}

fn jump(rd: u32, offset: u32) -> u32 {
    field(offset, 20, 1) << 31
        | field(offset, 1, 10) << 21
        | field(offset, 11, 1) << 20
        | field(offset, 12, 8) << 12
        | rd << 7
        | 0x6f
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs as an assembler writes them, with and without compression.
    #[test]
    fn short_forms_expand_to_what_the_assembler_writes_in_full() {
        for (text, half, word) in [
            ("addi a0, sp, 16", 0x0808, 0x0101_0513),
            ("lw a2, 12(a0)", 0x4550, 0x00c5_2603),
            ("sw a2, 12(a0)", 0xc550, 0x00c5_2623),
            ("addi s0, s0, -1", 0x147d, 0xfff4_0413),
            ("li a5, -3", 0x57f5, 0xffd0_0793),
            ("addi sp, sp, -32", 0x1101, 0xfe01_0113),
            ("lui a1, 0xfffe1", 0x7585, 0xfffe_15b7),
            ("srai a0, a0, 3", 0x850d, 0x4035_5513),
            ("andi a0, a0, 7", 0x891d, 0x0075_7513),
            ("sub a0, a0, a1", 0x8d0d, 0x40b5_0533),
            ("slli a0, a0, 4", 0x0512, 0x0045_1513),
            ("lw ra, 28(sp)", 0x40f2, 0x01c1_2083),
            ("sw ra, 28(sp)", 0xce06, 0x0011_2e23),
            ("mv a0, a1", 0x852e, 0x00b0_0533),
            ("add a0, a0, a1", 0x952e, 0x00b5_0533),
            ("ret", 0x8082, 0x0000_8067),
            ("jalr a5", 0x9782, 0x0007_80e7),
            ("ebreak", 0x9002, 0x0010_0073),
        ] {
            assert_eq!(expand(half), Some(word), "{text}");
        }
    }

    #[test]
    fn what_is_reserved_or_of_another_extension_expands_to_nothing() {
        for half in [0x0000, 0x8002, 0x2108, 0x6108, 0x9c01] {
            assert_eq!(expand(half), None, "{half:#06x}");
        }
    }
}
