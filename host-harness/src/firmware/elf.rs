//! What an image holds: code, functions, sizes, and instructions that its core would trap on.

use std::collections::{BTreeMap, BTreeSet};
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
    /// What it takes of the chip's memories, by use.
    pub sizes: Sizes,
    /// The same, by section; the stack included.
    pub sections: Vec<Section>,
    code: Vec<Code>,
    objects: Vec<Function>,
    labels: Vec<(u32, String)>,
    bytes: Vec<u8>,
}

/// A function, or a constant or variable, with an address of its own; what was inlined everywhere has none.
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

/// A part of the chip's memory that is loaded or reserved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// As the linker script names it.
    pub name: String,
    /// Where it starts.
    pub address: u32,
    /// Bytes.
    pub size: u64,
    /// Whether the image holds its contents.
    pub is_stored: bool,
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
        let (sections, objects, labels) = (Vec::new(), Vec::new(), Vec::new());
        Self { path: PathBuf::new(), functions, sizes, sections, code, objects, labels, bytes: Vec::new() }
    }

    fn parse(path: &Path, bytes: Vec<u8>) -> object::Result<Self> {
        let file = ElfFile32::<LittleEndian>::parse(&bytes[..])?;
        let functions = symbols(&file, SymbolKind::Text);
        let objects = symbols(&file, SymbolKind::Data);
        let labels = labels(&file);

        let mut code = Vec::new();
        let mut sizes = Sizes::default();
        let mut sections = Vec::new();
        for section in file.sections() {
            if takes_memory(&section) {
                let name = section.name()?.to_owned();
                if !takes_what_is_left(&name) {
                    sizes.add(&section);
                }
                let is_stored = section.kind() != SectionKind::UninitializedData;
                sections.push(Section { name, address: section.address() as u32, size: section.size(), is_stored });
            }
            if section.kind() == SectionKind::Text {
                let marks = file.symbols().filter(|symbol| symbol.section_index() == Some(section.index()));
                let marks = marks.filter_map(|symbol| Some((symbol.address(), symbol.name().ok()?.to_owned())));
                let functions = functions.iter().map(|function| function.address);
                code.extend(cut(section.address() as u32, section.data()?, marks, functions));
            }
        }
        Ok(Self { path: path.to_owned(), functions, sizes, sections, code, objects, labels, bytes })
    }

    /// Where the functions whose names are `wanted` have code, inlined copies included.
    ///
    /// # Errors
    /// If the image has no usable debug information.
    pub fn places(&self, wanted: impl Fn(&str) -> bool) -> Result<Vec<Place>, Error> {
        let file = ElfFile32::<LittleEndian>::parse(&self.bytes[..]).map_err(|error| unusable(&self.path, &error))?;
        dwarf::places(&file, wanted).map_err(|error| unusable(&self.path, &error))
    }

    /// Bytes of code, constants and variables that belong to some crates: their symbols, and what of them was inlined
    /// elsewhere.
    ///
    /// # Errors
    /// If the image has no usable debug information.
    pub fn bytes_of(&self, crates: &[&str]) -> Result<u64, Error> {
        let is_theirs = |name: &str| crates.iter().any(|one| name.contains(one));
        let symbols = self.functions.iter().chain(&self.objects).filter(|symbol| is_theirs(&symbol.name));
        let mut bytes: BTreeSet<u32> =
            symbols.flat_map(|symbol| symbol.address..symbol.address + symbol.size).collect();
        // A byte of a function inlined into another counts once.
        bytes.extend(self.places(is_theirs)?.into_iter().flat_map(|place| place.code));
        Ok(bytes.len() as u64)
    }

    /// The first of some words that stands anywhere in the file, names and debug information included.
    pub fn mentions<'a>(&self, words: &[&'a str]) -> Option<&'a str> {
        let is_in = |word: &&&str| self.bytes.windows(word.len()).any(|window| window == word.as_bytes());
        words.iter().find(is_in).copied()
    }

    /// The tables behind trait objects, by address.
    ///
    /// # Errors
    /// If the image has no usable debug information.
    pub fn vtables(&self) -> Result<BTreeMap<u32, String>, Error> {
        // An image put together by a test.
        if self.bytes.is_empty() {
            return Ok(BTreeMap::new());
        }
        let file = ElfFile32::<LittleEndian>::parse(&self.bytes[..]).map_err(|error| unusable(&self.path, &error))?;
        dwarf::vtables(&file).map_err(|error| unusable(&self.path, &error))
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

    /// Who the code at an address belongs to: a function, else whatever label of assembly stands before it.
    pub fn code_name(&self, address: u32) -> &str {
        let before = self.labels.partition_point(|&(at, _)| at <= address);
        let label = || self.labels[..before].last().map(|(_, name)| name.as_str());
        self.function_at(address).map(|function| function.name.as_str()).or_else(label).unwrap_or("?")
    }

    /// The constant or variable that an address lies in, if it has a name.
    pub fn object_at(&self, address: u32) -> Option<&Function> {
        let after = self.objects.partition_point(|object| object.address <= address);
        self.objects[..after].iter().rev().find(|object| address - object.address < object.size)
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

/// The symbols of a kind that have a size, by ascending address.
fn symbols<'data>(file: &impl Object<'data>, kind: SymbolKind) -> Vec<Function> {
    let mut found: Vec<_> = file
        .symbols()
        .filter(|symbol| symbol.kind() == kind && symbol.size() > 0)
        .filter_map(|symbol| {
            let name = format!("{:#}", rustc_demangle::demangle(symbol.name().ok()?));
            Some(Function { name, address: symbol.address() as u32, size: symbol.size() as u32 })
        })
        .collect();
    found.sort_by_key(|symbol| symbol.address);
    found
}

/// Names in executable sections that have no size, as assembly has them, by ascending address.
fn labels<'data>(file: &impl Object<'data>) -> Vec<(u32, String)> {
    let is_code = |symbol: &_| -> bool {
        let section = ObjectSymbol::section_index(symbol).and_then(|index| file.section_by_index(index).ok());
        section.is_some_and(|section| section.kind() == SectionKind::Text)
    };
    let mut found: Vec<_> = file
        .symbols()
        .filter(|symbol| symbol.size() == 0 && is_code(symbol))
        .filter_map(|symbol| Some((symbol.address() as u32, symbol.name().ok()?.to_owned())))
        // Mapping symbols and what the assembler made up.
        .filter(|(_, name)| !name.is_empty() && !name.starts_with(['$', '.']))
        .collect();
    found.sort_by_key(|&(address, _)| address);
    found
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

/// Whether a section takes any of the chip's memory.
fn takes_memory<'data>(section: &impl ObjectSection<'data>) -> bool {
    // esp-hal's linker scripts keep addresses free with sections that hold nothing and can't be written.
    let is_gap = section.kind() == SectionKind::UninitializedData
        && !has(section, elf::SHF_WRITE)
        && !section.name().is_ok_and(takes_what_is_left);
    has(section, elf::SHF_ALLOC) && !is_gap
}

fn takes_what_is_left(name: &str) -> bool {
    matches!(name, ".stack" | ".heap")
}

fn has<'data>(section: &impl ObjectSection<'data>, flag: elf::SectionFlags) -> bool {
    matches!(section.flags(), SectionFlags::Elf { sh_flags, .. } if sh_flags.contains(flag))
}

impl Sizes {
    fn add<'data>(&mut self, section: &impl ObjectSection<'data>) {
        let total = match section.kind() {
            SectionKind::UninitializedData => &mut self.bss,
            _ if has(section, elf::SHF_EXECINSTR) => &mut self.text,
            _ if has(section, elf::SHF_WRITE) => &mut self.data,
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
