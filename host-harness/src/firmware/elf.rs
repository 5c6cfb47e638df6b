//! What an image holds: code, functions, sizes, and instructions that its core would trap on.

use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;

use object::read::elf::ElfFile32;
use object::{LittleEndian, Object, ObjectSection, ObjectSymbol, SectionFlags, SectionKind, SymbolKind, elf};

use super::dwarf::{self, Place};
use super::instructions::{self, Extension, Instruction};
use super::{provision, subprocess, toolchain};
use crate::error::Error;

/// A linked image, as far as the checks need it.
#[derive(Clone, Debug)]
pub struct Image {
    /// Where it was read from.
    pub path: PathBuf,
    /// Its functions, by ascending address.
    pub functions: Vec<Function>,
    /// What it takes of the chip's memories.
    pub sizes: Sizes,
    code: Vec<Code>,
    bytes: Vec<u8>,
}

/// A function with an address of its own; what was inlined everywhere has none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Function {
    /// Demangled, without the hash.
    pub name: String,
    /// Where it starts.
    pub address: u32,
    /// Bytes.
    pub size: u32,
}

/// Bytes by use, over all sections that are loaded or reserved; stack and heap, which take what is left, are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Code.
    pub text: u64,
    /// Constants.
    pub rodata: u64,
    /// Variables with an initial value.
    pub data: u64,
    /// Variables that start as zero.
    pub bss: u64,
}

/// A run of instructions with no data inside.
#[derive(Clone, Debug)]
struct Code {
    address: u32,
    bytes: Vec<u8>,
}

/// An instruction that the core would trap on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Foreign {
    /// Where.
    pub address: u32,
    /// The instruction's 16 or 32 bits.
    pub word: u32,
    /// What it needs.
    pub extension: Extension,
    /// The function it stands in, if that has a name.
    pub function: String,
}

impl Image {
    /// Reads a 32-bit RISC-V image.
    ///
    /// # Errors
    /// If the file cannot be read or isn't one.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let bytes = std::fs::read(path).map_err(|error| unusable(path, &error))?;
        Self::parse(path, bytes).map_err(|error| unusable(path, &error))
    }

    /// An image from its parts, code as address and bytes.
    #[cfg(test)]
    pub(super) fn of(functions: Vec<Function>, code: &[(u32, &[u8])], sizes: Sizes) -> Self {
        let code = code.iter().map(|&(address, bytes)| Code { address, bytes: bytes.to_vec() }).collect();
        Self { path: PathBuf::new(), functions, sizes, code, bytes: Vec::new() }
    }

    fn parse(path: &Path, bytes: Vec<u8>) -> object::Result<Self> {
        let file = ElfFile32::<LittleEndian>::parse(&bytes[..])?;
        let mut functions: Vec<_> = file
            .symbols()
            .filter(|symbol| symbol.kind() == SymbolKind::Text && symbol.size() > 0)
            .filter_map(|symbol| {
                let name = format!("{:#}", rustc_demangle::demangle(symbol.name().ok()?));
                Some(Function { name, address: symbol.address() as u32, size: symbol.size() as u32 })
            })
            .collect();
        functions.sort_by_key(|function| function.address);

        let mut code = Vec::new();
        let mut sizes = Sizes::default();
        for section in file.sections() {
            sizes.add(&section);
            if section.kind() == SectionKind::Text {
                let marks = file.symbols().filter(|symbol| symbol.section_index() == Some(section.index()));
                let marks = marks.filter_map(|symbol| Some((symbol.address(), symbol.name().ok()?.to_owned())));
                let functions = functions.iter().map(|function| function.address);
                code.extend(cut(section.address() as u32, section.data()?, marks, functions));
            }
        }
        Ok(Self { path: path.to_owned(), functions, sizes, code, bytes })
    }

    /// Where the functions whose names are `wanted` have code, inlined copies included.
    ///
    /// # Errors
    /// If the image has no usable debug information.
    pub fn places(&self, wanted: impl Fn(&str) -> bool) -> Result<Vec<Place>, Error> {
        let file = ElfFile32::<LittleEndian>::parse(&self.bytes[..]).map_err(|error| unusable(&self.path, &error))?;
        dwarf::places(&file, wanted).map_err(|error| unusable(&self.path, &error))
    }

    /// All instructions with their addresses.
    pub fn instructions(&self) -> impl Iterator<Item = (u32, Instruction)> + '_ {
        self.code
            .iter()
            .flat_map(|code| instructions::decode(&code.bytes).map(|found| (code.address + found.offset as u32, found)))
    }

    /// Instructions outside rv32imc that need the A, F or D extension.
    pub fn foreign(&self) -> Vec<Foreign> {
        self.instructions()
            .filter_map(|(address, found)| {
                let function = self.function_at(address).map_or("?", |function| &function.name).to_owned();
                found.extension().map(|extension| Foreign { address, word: found.word, extension, function })
            })
            .collect()
    }

    /// The function that an address lies in.
    pub fn function_at(&self, address: u32) -> Option<&Function> {
        let after = self.functions.partition_point(|function| function.address <= address);
        self.functions[..after].iter().rev().find(|function| address - function.address < function.size)
    }

    /// What binutils' disassembler cannot read as rv32imc, line by line; none if it isn't installed.
    ///
    /// # Errors
    /// If it fails.
    pub fn second_opinion(&self) -> Result<Option<Vec<String>>, Error> {
        if toolchain::installed(provision::OBJDUMP).is_none() {
            return Ok(None);
        }
        let mut objdump = Command::new(provision::OBJDUMP);
        objdump.args(["--disassemble", "--wide"]).arg(&self.path);
        let listing = subprocess::run("disassembling", &mut objdump)?;
        Ok(Some(listing.lines().filter(|line| is_unreadable(line)).map(str::to_owned).collect()))
    }
}

fn unusable(path: &Path, error: &dyn fmt::Display) -> Error {
    Error::target(format!("{} is no usable RISC-V image: {error}", path.display()), "build it again")
}

/// Cuts a section into runs of instructions.
///
/// `$d` marks where data starts and `$x` where instructions do again (RISC-V ELF psABI, "mapping symbols"). Functions start
/// a run too, so that nothing before them can put the decoder out of step.
fn cut(
    address: u32,
    bytes: &[u8],
    marks: impl Iterator<Item = (u64, String)>,
    functions: impl Iterator<Item = u32>,
) -> Vec<Code> {
    let end = address + bytes.len() as u32;
    // At one address, a mark that says what follows comes before a function, which leaves that as it is.
    let mut starts: Vec<(u32, Option<bool>)> = marks
        .filter_map(|(at, name)| match name.get(..2) {
            Some("$x") => Some((at as u32, Some(true))),
            Some("$d") => Some((at as u32, Some(false))),
            _ => None,
        })
        .chain(functions.filter(|at| (address..end).contains(at)).map(|at| (at, None)))
        .collect();
    starts.sort_by_key(|&(at, mark)| (at, mark.is_none()));
    starts.push((end, None));

    let mut runs = Vec::new();
    let (mut from, mut is_code) = (address, true);
    for (at, mark) in starts {
        if is_code && at > from {
            runs.push(Code {
                address: from,
                bytes: bytes[(from - address) as usize..(at - address) as usize].to_vec(),
            });
        }
        (from, is_code) = (at, mark.unwrap_or(is_code));
    }
    runs
}

/// Whether a line of a listing shows an instruction that objdump had no name for, or one of A, F or D.
fn is_unreadable(line: &str) -> bool {
    // "  address:\tbytes\tmnemonic\toperands"
    let mut fields = line.split('\t').skip(1).map(str::trim);
    let (Some(bytes), Some(mnemonic)) = (fields.next(), fields.next()) else { return false };
    let is_atomic = ["lr.", "sc.", "amo"].iter().any(|start| mnemonic.starts_with(start));
    let is_float = mnemonic.starts_with('f') && !mnemonic.starts_with("fence");
    is_atomic || is_float || (mnemonic.starts_with('.') && !is_known_to_every_core(bytes))
}

/// Whether an unnamed word is of an opcode that every core has. Images say "rv32imc" of themselves, and objdump takes
/// them at their word: it names neither what has become Zicsr and Zifencei since, nor zeroes between functions.
fn is_known_to_every_core(bytes: &str) -> bool {
    const SYSTEM: u32 = 0x73;
    const MISC_MEM: u32 = 0x0f;
    u32::from_str_radix(bytes, 16).is_ok_and(|word| word == 0 || [SYSTEM, MISC_MEM].contains(&(word & 0x7f)))
}

impl Sizes {
    fn add<'data>(&mut self, section: &impl ObjectSection<'data>) {
        let SectionFlags::Elf { sh_flags, .. } = section.flags() else { return };
        let has = |flag: elf::SectionFlags| sh_flags.contains(flag);
        let takes_what_is_left = matches!(section.name(), Ok(".stack" | ".heap"));
        // esp-hal's linker scripts keep addresses free with sections that hold nothing and can't be written.
        let is_gap = section.kind() == SectionKind::UninitializedData && !has(elf::SHF_WRITE);
        if !has(elf::SHF_ALLOC) || takes_what_is_left || is_gap {
            return;
        }
        let total = match section.kind() {
            SectionKind::UninitializedData => &mut self.bss,
            _ if has(elf::SHF_EXECINSTR) => &mut self.text,
            _ if has(elf::SHF_WRITE) => &mut self.data,
            _ => &mut self.rodata,
        };
        *total += section.size();
    }
}

impl fmt::Display for Sizes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { text, rodata, data, bss } = self;
        write!(f, "text {text}, rodata {rodata}, data {data}, bss {bss} bytes")
    }
}

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { address, word, extension, function } = self;
        let extension = match extension {
            Extension::Atomic => "A",
            Extension::Float => "F or D",
        };
        write!(f, "{address:#010x}: {word:#x} needs {extension}, in {function}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runs(bytes: &[u8], marks: &[(u64, &str)], functions: &[u32]) -> Vec<(u32, usize)> {
        let marks = marks.iter().map(|&(at, name)| (at, name.to_owned()));
        cut(0x100, bytes, marks, functions.iter().copied()).iter().map(|run| (run.address, run.bytes.len())).collect()
    }

    #[test]
    fn data_in_code_is_left_out() {
        let marks = [(0x100, "$xrv32i2p1_m2p0_c2p0"), (0x104, "$d.1"), (0x10c, "$x"), (0x104, "table")];
        assert_eq!(runs(&[0; 16], &marks, &[]), [(0x100, 4), (0x10c, 4)]);
    }

    #[test]
    fn without_marks_each_function_is_a_run() {
        assert_eq!(runs(&[0; 16], &[], &[0x106, 0x200]), [(0x100, 6), (0x106, 10)]);
    }

    #[test]
    fn a_function_does_not_turn_data_into_code() {
        assert_eq!(runs(&[0; 8], &[(0x100, "$d"), (0x104, "$x")], &[0x100, 0x104]), [(0x104, 4)]);
    }

    #[test]
    fn listings_of_foreign_code_are_noticed() {
        for line in [
            "   0:\t1005a52f          \tlr.w\ta0,(a1)",
            "   8:\t00b57553\tfadd.s\tfa0,fa0,fa1",
            " 4:\t2108\t.short\t0x2108",
        ] {
            assert!(is_unreadable(line), "{line}");
        }
        for line in [
            "00000000 <fadd.s>:",
            "  56:\t0000100f\tfence.i",
            "  2:\t0000\tunimp",
            "  4:\t00000000\t.word\t0x00000000",
            "  8:\t34029073          \t.4byte\t0x34029073",
        ] {
            assert!(!is_unreadable(line), "{line}");
        }
    }
}
