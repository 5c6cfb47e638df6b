//! Registers, memory, and the loop over them.

use std::fmt;

use super::classes::{Class, Tally};
use super::decode::{Arithmetic, Comparison, Instruction, Operation, Product, Width, decode};

/// A register: the calling convention's names for those that calls use.
const SP: usize = 2;
const A0: usize = 10;
const A7: usize = 17;

/// A processor with one block of memory.
#[derive(Debug)]
pub struct Machine {
    registers: [u32; 32],
    pc: u32,
    base: u32,
    memory: Vec<u8>,
    /// By half words from the base; decoded once.
    decoded: Vec<Option<Instruction>>,
    tally: Tally,
}

/// A call of the environment (`ecall`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Call {
    /// a7.
    pub function: u32,
    /// a0 to a3.
    pub arguments: [u32; 4],
}

/// Why a program cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// No instruction of rv32imc.
    Instruction {
        /// Where.
        pc: u32,
    },
    /// An access outside of memory.
    Memory {
        /// The instruction.
        pc: u32,
        /// What it accessed.
        address: u32,
    },
    /// More instructions than allowed.
    Endless {
        /// Where it was.
        pc: u32,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Instruction { pc } => write!(f, "no instruction of rv32imc at {pc:#010x}"),
            Self::Memory { pc, address } => write!(f, "access to {address:#010x} at {pc:#010x}, outside of memory"),
            Self::Endless { pc } => write!(f, "no end in sight at {pc:#010x}"),
        }
    }
}

impl Machine {
    /// A machine whose memory starts at `base` with these bytes and goes on with zeros, about to run `entry` with arguments in
    /// a0 and up.
    pub fn new(base: u32, mut contents: Vec<u8>, size: usize, entry: u32, arguments: &[u32]) -> Self {
        contents.resize(size.max(contents.len()), 0);
        let decoded = vec![None; contents.len() / 2];
        let mut registers = [0; 32];
        // The stack grows down from the end; 16 bytes aligned, as the calling convention wants it.
        registers[SP] = (base + contents.len() as u32) & !15;
        registers[A0..A0 + arguments.len()].copy_from_slice(arguments);
        Self { registers, pc: entry, base, memory: contents, decoded, tally: Tally::default() }
    }

    /// What has been executed so far.
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// Runs until the program calls the environment; the call itself isn't counted.
    ///
    /// # Errors
    /// If it can't go on, or executes more than `limit` instructions.
    pub fn run(&mut self, limit: u64) -> Result<Call, Fault> {
        for _ in 0..limit {
            let instruction = self.fetch()?;
            if instruction.operation == Operation::Call {
                self.pc = self.pc.wrapping_add(u32::from(instruction.length));
                let arguments = std::array::from_fn(|index| self.registers[A0 + index]);
                return Ok(Call { function: self.registers[A7], arguments });
            }
            let class = self.execute(instruction)?;
            self.tally.add(class);
        }
        Err(Fault::Endless { pc: self.pc })
    }

    fn fetch(&mut self) -> Result<Instruction, Fault> {
        let fault = Fault::Instruction { pc: self.pc };
        let offset = self.pc.wrapping_sub(self.base) as usize;
        let slot = self.decoded.get_mut(offset / 2).filter(|_| offset.is_multiple_of(2)).ok_or(fault)?;
        if let Some(instruction) = *slot {
            return Ok(instruction);
        }
        // The last half word of memory can only hold a short instruction.
        let bytes: [u8; 4] = std::array::from_fn(|index| self.memory.get(offset + index).copied().unwrap_or(0));
        let instruction = decode(u32::from_le_bytes(bytes)).ok_or(fault)?;
        *slot = Some(instruction);
        Ok(instruction)
    }

    fn execute(&mut self, instruction: Instruction) -> Result<Class, Fault> {
        let Instruction { operation, rd, rs1, rs2, imm, length } = instruction;
        let (a, b) = (self.registers[usize::from(rs1)], self.registers[usize::from(rs2)]);
        let mut next = self.pc.wrapping_add(u32::from(length));
        let mut class = Class::Plain;
        let result = match operation {
            Operation::Lui => Some(imm),
            Operation::Auipc => Some(self.pc.wrapping_add(imm)),
            Operation::Jal | Operation::Jalr => {
                let back = next;
                next = if operation == Operation::Jal { self.pc.wrapping_add(imm) } else { a.wrapping_add(imm) & !1 };
                class = Class::Jump;
                Some(back)
            }
            Operation::Branch(comparison) => {
                class = Class::NotTaken;
                if compare(comparison, a, b) {
                    next = self.pc.wrapping_add(imm);
                    class = Class::Taken;
                }
                None
            }
            Operation::Load(width) => {
                class = Class::Load;
                Some(self.load(width, a.wrapping_add(imm))?)
            }
            Operation::Store(width) => {
                class = Class::Store;
                self.store(width, a.wrapping_add(imm), b)?;
                None
            }
            Operation::Immediate(arithmetic) => Some(calculate(arithmetic, a, imm)),
            Operation::Register(arithmetic) => Some(calculate(arithmetic, a, b)),
            Operation::Product(product) => {
                class = class_of(product);
                Some(multiply(product, a, b))
            }
            Operation::Fence | Operation::Call => None,
        };
        if let Some(result) = result
            && rd != 0
        {
            self.registers[usize::from(rd)] = result;
        }
        self.pc = next;
        Ok(class)
    }

    fn place(&self, address: u32, bytes: usize) -> Result<usize, Fault> {
        let offset = address.wrapping_sub(self.base) as usize;
        let fits = offset.checked_add(bytes).is_some_and(|end| end <= self.memory.len());
        if fits { Ok(offset) } else { Err(Fault::Memory { pc: self.pc, address }) }
    }

    fn load(&self, width: Width, address: u32) -> Result<u32, Fault> {
        let bytes = width.bytes();
        let from = self.place(address, bytes)?;
        let mut word = [0; 4];
        word[..bytes].copy_from_slice(&self.memory[from..from + bytes]);
        let value = u32::from_le_bytes(word);
        Ok(match width {
            Width::SignedByte => i32::from(value as i8).cast_unsigned(),
            Width::SignedHalf => i32::from(value as i16).cast_unsigned(),
            Width::Word | Width::Byte | Width::Half => value,
        })
    }

    fn store(&mut self, width: Width, address: u32, value: u32) -> Result<(), Fault> {
        let bytes = width.bytes();
        let to = self.place(address, bytes)?;
        self.memory[to..to + bytes].copy_from_slice(&value.to_le_bytes()[..bytes]);
        Ok(())
    }
}

impl Width {
    fn bytes(self) -> usize {
        match self {
            Self::SignedByte | Self::Byte => 1,
            Self::SignedHalf | Self::Half => 2,
            Self::Word => 4,
        }
    }
}

fn compare(comparison: Comparison, a: u32, b: u32) -> bool {
    match comparison {
        Comparison::Equal => a == b,
        Comparison::NotEqual => a != b,
        Comparison::Less => a.cast_signed() < b.cast_signed(),
        Comparison::NotLess => a.cast_signed() >= b.cast_signed(),
        Comparison::Below => a < b,
        Comparison::NotBelow => a >= b,
    }
}

fn calculate(arithmetic: Arithmetic, a: u32, b: u32) -> u32 {
    match arithmetic {
        Arithmetic::Add => a.wrapping_add(b),
        Arithmetic::Subtract => a.wrapping_sub(b),
        Arithmetic::ShiftLeft => a << (b & 31),
        Arithmetic::SetLess => u32::from(a.cast_signed() < b.cast_signed()),
        Arithmetic::SetBelow => u32::from(a < b),
        Arithmetic::Xor => a ^ b,
        Arithmetic::ShiftRight => a >> (b & 31),
        Arithmetic::ShiftRightSigned => (a.cast_signed() >> (b & 31)).cast_unsigned(),
        Arithmetic::Or => a | b,
        Arithmetic::And => a & b,
    }
}

/// Division by zero and the one overflow have the results that the manual gives them; neither traps.
fn multiply(product: Product, a: u32, b: u32) -> u32 {
    let (signed_a, signed_b) = (a.cast_signed(), b.cast_signed());
    match product {
        Product::Low => a.wrapping_mul(b),
        Product::High => ((i64::from(signed_a) * i64::from(signed_b)) >> 32) as u32,
        Product::HighSignedUnsigned => ((i64::from(signed_a) * i64::from(b)) >> 32) as u32,
        Product::HighUnsigned => ((u64::from(a) * u64::from(b)) >> 32) as u32,
        Product::Quotient if b == 0 => u32::MAX,
        Product::Quotient => signed_a.wrapping_div(signed_b).cast_unsigned(),
        Product::QuotientUnsigned => a.checked_div(b).unwrap_or(u32::MAX),
        Product::Remainder if b == 0 => a,
        Product::Remainder => signed_a.wrapping_rem(signed_b).cast_unsigned(),
        Product::RemainderUnsigned => a.checked_rem(b).unwrap_or(a),
    }
}

fn class_of(product: Product) -> Class {
    match product {
        Product::Low => Class::Multiply,
        Product::High | Product::HighSignedUnsigned | Product::HighUnsigned => Class::MultiplyHigh,
        _ => Class::Divide,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BASE: u32 = 0x8000_0000;

    fn machine(code: &[u32], arguments: &[u32]) -> Machine {
        let bytes = code.iter().flat_map(|word| word.to_le_bytes()).collect();
        Machine::new(BASE, bytes, 4096, BASE, arguments)
    }

    #[test]
    fn a_loop_runs_its_rounds_and_every_instruction_is_counted() {
        // sum: add a1, a1, a0; addi a0, a0, -1; bnez a0, sum; ecall
        let code = [0x00a5_85b3, 0xfff5_0513, 0xfe05_1ce3, 0x0000_0073];
        let mut machine = machine(&code, &[10]);
        let call = machine.run(1000).unwrap();
        assert_eq!(call.arguments[..2], [0, 55]);
        let tally = machine.tally();
        assert_eq!((tally.instructions(), tally.of(Class::Taken), tally.of(Class::NotTaken)), (30, 9, 1));
        assert_eq!(tally.cycles(), 20 + 9 * 3 + 1);
    }

    #[test]
    fn memory_keeps_widths_and_signs() {
        // addi t0, sp, -8; sw a0, 0(t0); lb a1, 0(t0); lhu a2, 0(t0); ecall
        let code = [0xff81_0293, 0x00a2_a023, 0x0002_8583, 0x0002_d603, 0x0000_0073];
        let call = machine(&code, &[0x1234_8081]).run(10).unwrap();
        assert_eq!(call.arguments[1..3], [0xffff_ff81, 0x8081]);
    }

    #[test]
    fn division_by_zero_and_its_overflow_have_results() {
        let (least, minus_one) = (i32::MIN.cast_unsigned(), u32::MAX);
        for (product, a, b, expected) in [
            (Product::Quotient, 7, 0, u32::MAX),
            (Product::Remainder, 7, 0, 7),
            (Product::QuotientUnsigned, 7, 0, u32::MAX),
            (Product::RemainderUnsigned, 7, 0, 7),
            (Product::Quotient, least, minus_one, least),
            (Product::Remainder, least, minus_one, 0),
            (Product::HighSignedUnsigned, minus_one, minus_one, minus_one),
            (Product::High, least, least, 0x4000_0000),
        ] {
            assert_eq!(multiply(product, a, b), expected, "{product:?} {a:#x} {b:#x}");
        }
    }

    #[test]
    fn what_cannot_go_on_says_where() {
        assert_eq!(machine(&[0], &[]).run(10), Err(Fault::Instruction { pc: BASE }));
        // lw a0, 0(zero)
        assert_eq!(machine(&[0x0000_2503], &[]).run(10), Err(Fault::Memory { pc: BASE, address: 0 }));
        // j .
        assert_eq!(machine(&[0x0000_006f], &[]).run(10), Err(Fault::Endless { pc: BASE }));
    }
}
