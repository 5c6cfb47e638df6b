//! Addresses to functions and source lines.

use std::fmt;

use addr2line::Context;
use object::LittleEndian;
use object::read::elf::ElfFile32;

use super::dwarf;

/// An address of a backtrace and the functions around it, the innermost first: what was inlined there comes before what it
/// was inlined into.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// The address.
    pub address: u32,
    /// Function and place each; empty if the image knows no code there.
    pub frames: Vec<String>,
}

/// Names what a backtrace, innermost first, leads through. All but the first are return addresses, which lie behind the call.
///
/// # Errors
/// If the image has no usable debug information; in words.
pub fn name(elf: &[u8], backtrace: &[u32]) -> Result<Vec<Call>, String> {
    let file = ElfFile32::<LittleEndian>::parse(elf).map_err(|error| error.to_string())?;
    let context = dwarf::load(&file).and_then(Context::from_dwarf).map_err(|error| error.to_string())?;
    let call = |(index, &address): (usize, &u32)| {
        let inside = u64::from(address).saturating_sub(u64::from(index > 0));
        let mut frames = Vec::new();
        let mut found = context.find_frames(inside).skip_all_loads()?;
        while let Some(frame) = found.next()? {
            let function = frame.function.as_ref().and_then(|function| function.demangle().ok().map(Into::into));
            let place = frame.location.and_then(|place| Some(format!("{}:{}", shortened(place.file?), place.line?)));
            let function: String = function.unwrap_or_else(|| "?".into());
            frames.push(match place {
                Some(place) => format!("{} at {place}", brief(without_hash(&function))),
                None => brief(without_hash(&function)),
            });
        }
        Ok(Call { address, frames })
    };
    backtrace.iter().enumerate().map(call).collect::<Result<_, gimli::Error>>().map_err(|error| error.to_string())
}

/// A path without what only says where this machine keeps its sources.
pub fn shortened(path: &str) -> &str {
    let after = |mark: &str| path.rfind(mark).map(|at| at + mark.len());
    let root = super::workspace::root().map(|root| root.to_string_lossy().into_owned()).unwrap_or_default();
    if let Some(inside) = path.strip_prefix(&root).filter(|_| !root.is_empty()) {
        return inside.trim_start_matches('/');
    }
    // A crate of cargo's registry, `registry/src/HOST-HASH/CRATE-VERSION/...`.
    if let Some(start) = after("/registry/src/") {
        return path[start..].split_once('/').map_or(path, |(_, rest)| rest);
    }
    after("/library/").map_or(path, |start| &path[start..])
}

/// A function's name without what it is generic over, which may fill a page: `<A<B>>::f::<C>` as `<A>::f`.
fn brief(name: &str) -> String {
    let mut brief = String::new();
    let mut depth = 0_u32;
    let mut before = ' ';
    for (index, letter) in name.char_indices() {
        match letter {
            // Arguments follow a name or `::`; any other bracket opens a path, as in `<A as B>::f`.
            '<' if depth > 0 || before.is_alphanumeric() || matches!(before, '_' | ':') => {
                if depth == 0 && brief.ends_with("::") {
                    brief.truncate(brief.len() - 2);
                }
                depth += 1;
            }
            // The arrow of a function's type closes nothing.
            '>' if depth > 0 && !name[..index].ends_with('-') => depth -= 1,
            _ if depth == 0 => brief.push(letter),
            _ => {}
        }
        before = letter;
    }
    brief
}

/// `a::b::h0123456789abcdef` without the hash.
fn without_hash(name: &str) -> &str {
    match name.rsplit_once("::h") {
        Some((path, hash)) if hash.len() == 16 && hash.bytes().all(|byte| byte.is_ascii_hexdigit()) => path,
        _ => name,
    }
}

/// The calls around an address, a line each.
impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#010x}", self.address)?;
        for (index, frame) in self.frames.iter().enumerate() {
            let indent = if index == 0 { "  " } else { "\n            " };
            write!(f, "{indent}{frame}")?;
        }
        if self.frames.is_empty() { f.write_str("  ?") } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lose_what_is_this_machines_own() {
        let root = crate::firmware::workspace::root().unwrap();
        assert_eq!(shortened(&format!("{}/firmware/src/main.rs", root.display())), "firmware/src/main.rs");
        assert_eq!(
            shortened("/home/me/.cargo/registry/src/host-0123/embassy-time-0.5.1/src/timer.rs"),
            "embassy-time-0.5.1/src/timer.rs"
        );
        assert_eq!(shortened("/rustc/abc/library/core/src/option.rs"), "core/src/option.rs");
        assert_eq!(shortened("src/main.rs"), "src/main.rs");
    }

    #[test]
    fn names_lose_their_arguments_and_keep_their_paths() {
        for (name, expected) in [
            ("a::b::c", "a::b::c"),
            ("<a::B<c::D<4>>>::e::<f::G, fn(u8) -> u16>", "<a::B>::e"),
            ("<&a::B as c::D<e::F>>::g::{closure#0}", "<&a::B as c::D>::g::{closure#0}"),
        ] {
            assert_eq!(brief(name), expected);
        }
    }

    #[test]
    fn hashes_are_left_out() {
        assert_eq!(without_hash("a::b::h0123456789abcdef"), "a::b");
        assert_eq!(without_hash("a::h::height"), "a::h::height");
    }
}
