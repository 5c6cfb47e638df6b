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
