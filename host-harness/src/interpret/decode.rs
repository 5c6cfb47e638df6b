//! From words to operations.

use super::compressed;

/// What an instruction does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// `rd = imm`
    Lui,
    /// `rd = pc + imm`
    Auipc,
    /// `rd = next pc; pc += imm`
    Jal,
    /// `rd = next pc; pc = rs1 + imm`
    Jalr,
    /// `if rs1 ? rs2 { pc += imm }`
    Branch(Comparison),
    /// `rd = memory[rs1 + imm]`
    Load(Width),
    /// `memory[rs1 + imm] = rs2`
    Store(Width),
    /// `rd = rs1 ? imm`
    Immediate(Arithmetic),
    /// `rd = rs1 ? rs2`
    Register(Arithmetic),
    /// `rd = rs1 * rs2` and the like
    Product(Product),
    /// Orders memory accesses: nothing to do for one core.
    Fence,
    /// A call of the environment.
    Call,
}

/// Conditions of branches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    Equal,
    NotEqual,
    Less,
    NotLess,
    Below,
    NotBelow,
}

/// Widths in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    SignedByte,
    SignedHalf,
    Word,
    Byte,
    Half,
}

/// Arithmetic and logic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    Add,
    Subtract,
    ShiftLeft,
    SetLess,
    SetBelow,
    Xor,
    ShiftRight,
    ShiftRightSigned,
    Or,
    And,
}

/// The "M" extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Product {
    Low,
    High,
    HighSignedUnsigned,
    HighUnsigned,
    Quotient,
    QuotientUnsigned,
    Remainder,
    RemainderUnsigned,
}

/// A decoded instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// What it does.
    pub operation: Operation,
    /// Where the result goes.
    pub rd: u8,
    /// First operand.
    pub rs1: u8,
    /// Second operand.
    pub rs2: u8,
    /// The number in it.
    pub imm: u32,
    /// Bytes.
    pub length: u8,
}

/// Decodes what starts with these four bytes; none if it is nothing of rv32imc.
pub fn decode(word: u32) -> Option<Instruction> {
    if word & 0b11 == 0b11 { full(word, 4) } else { full(compressed::expand(word as u16)?, 2) }
}

fn full(word: u32, length: u8) -> Option<Instruction> {
    let funct = word >> 12 & 0b111;
    let high = word >> 25;
    let signed = word.cast_signed();
    let i = (signed >> 20).cast_unsigned();
    let (operation, imm) = match word & 0x7f {
        0x37 => (Operation::Lui, word & 0xffff_f000),
        0x17 => (Operation::Auipc, word & 0xffff_f000),
        0x6f => {
            let top = (signed >> 31).cast_unsigned() << 20;
            (Operation::Jal, top | word & 0xf_f000 | word >> 9 & 0x800 | word >> 20 & 0x7fe)
        }
        0x67 if funct == 0 => (Operation::Jalr, i),
        0x63 => {
            let top = (signed >> 31).cast_unsigned() << 12;
            let offset = top | (word << 4 & 0x800) | (word >> 20 & 0x7e0) | (word >> 7 & 0x1e);
            (Operation::Branch(comparison(funct)?), offset)
        }
        0x03 => (Operation::Load(load_width(funct)?), i),
        0x23 => {
            let offset = (signed >> 25 << 5).cast_unsigned() | (word >> 7 & 0x1f);
            let width = [Width::Byte, Width::Half, Width::Word].get(funct as usize).copied()?;
            (Operation::Store(width), offset)
        }
        0x13 => match (funct, high) {
            (1, 0) => (Operation::Immediate(Arithmetic::ShiftLeft), i & 31),
            (5, 0) => (Operation::Immediate(Arithmetic::ShiftRight), i & 31),
            (5, 0x20) => (Operation::Immediate(Arithmetic::ShiftRightSigned), i & 31),
            (1 | 5, _) => return None,
            _ => (Operation::Immediate(arithmetic(funct, 0)?), i),
        },
        0x33 if high == 1 => (Operation::Product(product(funct)), 0),
        0x33 => (Operation::Register(arithmetic(funct, high)?), 0),
        0x0f => (Operation::Fence, 0),
        0x73 if word == 0x73 => (Operation::Call, 0),
        _ => return None,
    };
    let register = |from: u32| (word >> from & 31) as u8;
    Some(Instruction { operation, rd: register(7), rs1: register(15), rs2: register(20), imm, length })
}

fn comparison(funct: u32) -> Option<Comparison> {
    Some(match funct {
        0 => Comparison::Equal,
        1 => Comparison::NotEqual,
        4 => Comparison::Less,
        5 => Comparison::NotLess,
        6 => Comparison::Below,
        7 => Comparison::NotBelow,
        _ => return None,
    })
}

fn load_width(funct: u32) -> Option<Width> {
    Some(match funct {
        0 => Width::SignedByte,
        1 => Width::SignedHalf,
        2 => Width::Word,
        4 => Width::Byte,
        5 => Width::Half,
        _ => return None,
    })
}

fn arithmetic(funct: u32, high: u32) -> Option<Arithmetic> {
    Some(match (funct, high) {
        (0, 0) => Arithmetic::Add,
        (0, 0x20) => Arithmetic::Subtract,
        (1, 0) => Arithmetic::ShiftLeft,
        (2, 0) => Arithmetic::SetLess,
        (3, 0) => Arithmetic::SetBelow,
        (4, 0) => Arithmetic::Xor,
        (5, 0) => Arithmetic::ShiftRight,
        (5, 0x20) => Arithmetic::ShiftRightSigned,
        (6, 0) => Arithmetic::Or,
        (7, 0) => Arithmetic::And,
        _ => return None,
    })
}

fn product(funct: u32) -> Product {
    match funct {
        0 => Product::Low,
        1 => Product::High,
        2 => Product::HighSignedUnsigned,
        3 => Product::HighUnsigned,
        4 => Product::Quotient,
        5 => Product::QuotientUnsigned,
        6 => Product::Remainder,
        _ => Product::RemainderUnsigned,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_come_together_from_their_scattered_bits() {
        for (text, word, operation, imm) in [
            ("jal ra, .-4", 0xffdf_f0ef, Operation::Jal, (-4_i32).cast_unsigned()),
            ("jal ra, .+0x12344", 0x3441_20ef, Operation::Jal, 0x1_2344),
            ("bne a0, a1, .-8", 0xfeb5_1ce3, Operation::Branch(Comparison::NotEqual), (-8_i32).cast_unsigned()),
            ("bltu a0, a1, .+0x7fe", 0x7eb5_6f63, Operation::Branch(Comparison::Below), 0x7fe),
            ("sw a1, -4(a0)", 0xfeb5_2e23, Operation::Store(Width::Word), (-4_i32).cast_unsigned()),
            ("lhu a0, 2047(a1)", 0x7ff5_d503, Operation::Load(Width::Half), 2047),
            ("srai a0, a1, 31", 0x41f5_d513, Operation::Immediate(Arithmetic::ShiftRightSigned), 31),
            ("mulhu a0, a1, a2", 0x02c5_b533, Operation::Product(Product::HighUnsigned), 0),
        ] {
            let found = decode(word).map(|instruction| (instruction.operation, instruction.imm));
            assert_eq!(found, Some((operation, imm)), "{text}");
        }
    }

    #[test]
    fn what_is_nothing_of_rv32imc_is_not_decoded() {
        // amoadd.w, fadd.s, csrr, all ones
        for word in [0x00c5_a52f, 0x00b5_7553, 0xb000_2573, u32::MAX] {
            assert_eq!(decode(word), None, "{word:#010x}");
        }
    }
}
