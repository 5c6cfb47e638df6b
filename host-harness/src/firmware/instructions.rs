//! A linear RISC-V decoder that knows one thing: which instructions a core without the A, F and D extensions traps on.
//!
//! Opcode tables: *The RISC-V Instruction Set Manual*, volume I, "RV32/64G Instruction Set Listings" and "C extension".

/// What an instruction needs beyond rv32imc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extension {
    /// A: `lr`, `sc` and the `amo` family.
    Atomic,
    /// F or D: loads, stores, arithmetic, and access to the floating-point control registers.
    Float,
}

/// One instruction of a code section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Instruction {
    /// Offset from the start of the decoded bytes.
    pub offset: usize,
    /// The 16 or 32 bits, zero-extended.
    pub word: u32,
    /// Length in bytes: 2 or 4.
    pub length: usize,
}

/// Cuts code into instructions; a last one that is cut short by the end is left out.
pub(crate) fn decode(code: &[u8]) -> impl Iterator<Item = Instruction> + '_ {
    let mut offset = 0;
    core::iter::from_fn(move || {
        let rest = code.get(offset..)?;
        let half = u16::from_le_bytes(rest.first_chunk().copied()?);
        // The two low bits say whether 16 more bits follow.
        let (word, length) = if half & 0b11 == 0b11 {
            (u32::from_le_bytes(rest.first_chunk().copied()?), 4)
        } else {
            (u32::from(half), 2)
        };
        let instruction = Instruction { offset, word, length };
        offset += length;
        Some(instruction)
    })
}

impl Instruction {
    /// The extension that a plain rv32imc core lacks for this instruction, if any.
    pub(crate) fn extension(self) -> Option<Extension> {
        if self.length == 2 { compressed(self.word) } else { full(self.word) }
    }
}

fn full(word: u32) -> Option<Extension> {
    const CSR_OF_F: core::ops::RangeInclusive<u32> = 0x001..=0x003;
    match word & 0x7f {
        0x2f => Some(Extension::Atomic),
        // LOAD-FP, STORE-FP, MADD, MSUB, NMSUB, NMADD, OP-FP
        0x07 | 0x27 | 0x43 | 0x47 | 0x4b | 0x4f | 0x53 => Some(Extension::Float),
        // SYSTEM: funct3 = 0 is ecall and its like, anything else names a control register.
        0x73 if (word >> 12) & 0b111 != 0 && CSR_OF_F.contains(&(word >> 20)) => Some(Extension::Float),
        _ => None,
    }
}

fn compressed(half: u32) -> Option<Extension> {
    match (half & 0b11, half >> 13) {
        // c.fld, c.flw, c.fsd, c.fsw, and in quadrant 2 the same relative to sp.
        (0b00 | 0b10, 0b001 | 0b011 | 0b101 | 0b111) => Some(Extension::Float),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extension_of(code: &[u8]) -> Option<Extension> {
        let mut found = decode(code);
        let instruction = found.next().expect("one instruction");
        assert_eq!(instruction.length, code.len());
        assert_eq!(found.next(), None);
        instruction.extension()
    }

    #[test]
    fn atomics_are_found() {
        for (text, word) in [
            ("lr.w a0, (a1)", 0x1005_a52f_u32),
            ("sc.w a0, a2, (a1)", 0x18c5_a52f),
            ("amoadd.w a0, a2, (a1)", 0x00c5_a52f),
            ("amoswap.w.aqrl a0, a2, (a1)", 0x0ec5_a52f),
        ] {
            assert_eq!(extension_of(&word.to_le_bytes()), Some(Extension::Atomic), "{text}");
        }
    }

    #[test]
    fn floats_are_found() {
        for (text, word) in [
            ("flw fa0, 0(a0)", 0x0005_2507_u32),
            ("fsd fa0, 0(a0)", 0x00a5_3027),
            ("fmadd.s fa0, fa0, fa1, fa2", 0x60b5_7543),
            ("fnmadd.d fa0, fa0, fa1, fa2", 0x62b5_754f),
            ("fadd.s fa0, fa0, fa1", 0x00b5_7553),
            ("fcvt.w.s a0, fa0, rtz", 0xc005_1553),
            ("frflags a0", 0x0010_2573),
            ("fsrm a0, a1", 0x0025_9573),
        ] {
            assert_eq!(extension_of(&word.to_le_bytes()), Some(Extension::Float), "{text}");
        }
    }

    #[test]
    fn compressed_floats_are_found() {
        for (text, half) in [
            ("c.fld fa0, 0(a0)", 0x2108_u16),
            ("c.flw fa0, 0(a0)", 0x6108),
            ("c.fsd fa0, 0(a0)", 0xa108),
            ("c.fsw fa0, 0(a0)", 0xe108),
            ("c.fldsp fa0, 0(sp)", 0x2502),
            ("c.flwsp fa0, 0(sp)", 0x6502),
            ("c.fsdsp fa0, 0(sp)", 0xa02a),
            ("c.fswsp fa0, 0(sp)", 0xe02a),
        ] {
            assert_eq!(extension_of(&half.to_le_bytes()), Some(Extension::Float), "{text}");
        }
    }

    #[test]
    fn rv32imc_passes() {
        for (text, word) in [
            ("lw a0, 0(a1)", 0x0005_a503_u32),
            ("sw a0, 0(a1)", 0x00a5_a023),
            ("mulh a0, a0, a1", 0x02b5_1533),
            ("div a0, a0, a1", 0x02b5_4533),
            ("fence.i", 0x0000_100f),
            ("csrr a0, mcycle", 0xb000_2573),
            ("ecall", 0x0000_0073),
            ("uret, whose number field looks like a control register of F", 0x0020_0073),
        ] {
            assert_eq!(extension_of(&word.to_le_bytes()), None, "{text}");
        }
        for (text, half) in [("c.lw a0, 0(a1)", 0x4188_u16), ("c.swsp ra, 12(sp)", 0xc606), ("c.addi a0, 1", 0x0505)] {
            assert_eq!(extension_of(&half.to_le_bytes()), None, "{text}");
        }
    }

    #[test]
    fn mixed_lengths_stay_in_step() {
        // c.nop; lr.w a0, (a1); c.nop
        let code = [0x01, 0x00, 0x2f, 0xa5, 0x05, 0x10, 0x01, 0x00];
        let offsets: Vec<_> = decode(&code).map(|i| (i.offset, i.extension())).collect();
        assert_eq!(offsets, [(0, None), (2, Some(Extension::Atomic)), (6, None)]);
    }

    #[test]
    fn a_cut_off_end_is_left_out() {
        assert_eq!(decode(&[0x2f, 0xa5, 0x05]).count(), 0);
        assert_eq!(decode(&[0x01]).count(), 0);
    }
}
