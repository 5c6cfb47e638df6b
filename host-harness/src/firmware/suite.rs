//! The unit tests that an image holds, as embedded-test leaves them there for test runners.
//!
//! Each is a symbol in the section `.embedded_test`. Its name is a JSON object, and it points at the entry point, the module's
//! path, and that path's length.

use std::path::Path;
use std::time::Duration;

use object::read::elf::ElfFile32;
use object::{LittleEndian, Object, ObjectSection, ObjectSymbol};
use serde::Deserialize;

use crate::error::Error;

const SECTION: &str = ".embedded_test";
/// What marks the section's format, and its only value so far.
const VERSION: (&str, u32) = ("EMBEDDED_TEST_VERSION", 1);

/// A test of an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitTest {
    /// The function's name.
    pub name: String,
    /// Where it starts, its set-up included.
    pub entry: u32,
    /// Whether it passes by failing.
    pub should_panic: bool,
    /// Whether it is left out.
    pub ignored: bool,
    /// Longest that it may take.
    pub limit: Duration,
}

/// What embedded-test gives a test that names no limit.
const LIMIT: Duration = Duration::from_mins(1);

/// The symbol's name.
#[derive(Deserialize)]
struct Description {
    name: String,
    should_panic: bool,
    ignored: bool,
    timeout: Option<u64>,
}

/// Lists an image's tests by their names.
///
/// # Errors
/// If the image cannot be read, holds no tests, or holds them in another format.
pub fn list(path: &Path) -> Result<Vec<UnitTest>, Error> {
    let unusable = |why: String| Error::target(format!("{}: {why}", path.display()), "`cargo rig test` builds one");
    let bytes = std::fs::read(path).map_err(|error| unusable(error.to_string()))?;
    read(&bytes).map_err(unusable)
}

fn read(elf: &[u8]) -> Result<Vec<UnitTest>, String> {
    let file = ElfFile32::<LittleEndian>::parse(elf).map_err(|error| error.to_string())?;
    let section = file.section_by_name(SECTION).ok_or("it holds no tests")?;
    let data = section.data().map_err(|error| error.to_string())?;
    let word = |address: u64| {
        let start = usize::try_from(address.checked_sub(section.address())?).ok()?;
        Some(u32::from_le_bytes(data.get(start..start + 4)?.try_into().ok()?))
    };
    let (mut tests, mut version) = (Vec::new(), None);
    for symbol in file.symbols().filter(|symbol| symbol.section_index() == Some(section.index())) {
        let name = symbol.name().map_err(|error| error.to_string())?;
        if name == VERSION.0 {
            version = word(symbol.address());
        }
        let Ok(Description { name, should_panic, ignored, timeout }) = serde_json::from_str(name) else { continue };
        let limit = timeout.map_or(LIMIT, Duration::from_secs);
        let entry = word(symbol.address()).ok_or_else(|| format!("the test {name} has no entry point"))?;
        tests.push(UnitTest { name, entry, should_panic, ignored, limit });
    }
    tests.sort_by(|one, other| one.name.cmp(&other.name));
    match version {
        Some(version) if version == VERSION.1 && !tests.is_empty() => Ok(tests),
        Some(version) if version == VERSION.1 => Err("it holds no tests".into()),
        _ => Err(format!("its tests are in another format: version {version:?}, not {}", VERSION.1)),
    }
}

#[cfg(test)]
mod tests {
    use object::write::{Object, Symbol, SymbolSection};
    use object::{Architecture, BinaryFormat, Endianness, SectionKind, SymbolFlags, SymbolKind, SymbolScope};

    use super::*;

    const ONE: &str = r#"{"disambiguator":1,"name":"one","ignored":false,"should_panic":true,"timeout":20}"#;
    const TWO: &str = r#"{"disambiguator":1,"name":"two","ignored":true,"should_panic":false}"#;

    /// An image with words in its section, each under a name.
    fn image(words: &[(&str, u32)]) -> Vec<u8> {
        let mut image = Object::new(BinaryFormat::Elf, Architecture::Riscv32, Endianness::Little);
        let section = image.add_section(Vec::new(), SECTION.into(), SectionKind::Metadata);
        for &(name, word) in words {
            let value = image.append_section_data(section, &word.to_le_bytes(), 4);
            image.add_symbol(Symbol {
                name: name.into(),
                value,
                size: 4,
                kind: SymbolKind::Data,
                scope: SymbolScope::Dynamic,
                weak: false,
                section: SymbolSection::Section(section),
                flags: SymbolFlags::None,
            });
        }
        image.write().unwrap()
    }

    #[test]
    fn tests_are_listed_by_name_with_their_entry_points() {
        let found = read(&image(&[(TWO, 0x8000_0002), (ONE, 0x8000_0001), (VERSION.0, 1)])).unwrap();
        let test = |name: &str, entry, should_panic, ignored, seconds| UnitTest {
            name: name.into(),
            entry,
            should_panic,
            ignored,
            limit: Duration::from_secs(seconds),
        };
        assert_eq!(found, [test("one", 0x8000_0001, true, false, 20), test("two", 0x8000_0002, false, true, 60)]);
    }

    #[test]
    fn an_image_without_tests_or_with_those_of_another_format_is_refused() {
        let why = |words: &[(&str, u32)]| read(&image(words)).unwrap_err();
        assert!(why(&[(VERSION.0, 1)]).contains("no tests"), "{}", why(&[(VERSION.0, 1)]));
        assert!(why(&[(ONE, 1), (VERSION.0, 2)]).contains("another format"), "{}", why(&[(ONE, 1), (VERSION.0, 2)]));
        assert!(why(&[(ONE, 1)]).contains("another format"), "{}", why(&[(ONE, 1)]));
    }
}
