//! The source tree that this `rig` was built from.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::error::Error;

/// What decides the device's code, relative to the root: [`build_id`] hashes these.
const SOURCES: [&str; 5] = ["Cargo.lock", "Cargo.toml", "firmware", "memory.x", "shared"];

/// The workspace root.
///
/// # Errors
/// If the tree isn't where it was when `rig` was compiled.
pub fn root() -> Result<PathBuf, Error> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."));
    if root.join("firmware/Cargo.toml").is_file() {
        Ok(root.to_owned())
    } else {
        Err(Error::target(
            format!("no firmware sources in {}, where this rig was compiled", root.display()),
            "run it from the source tree with `cargo rig`",
        ))
    }
}

/// Where cargo and `rig` put what they build.
///
/// # Errors
/// As [`root`].
pub fn target_dir() -> Result<PathBuf, Error> {
    let root = root()?;
    // A relative CARGO_TARGET_DIR counts from where cargo is called: the root.
    Ok(env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |dir| root.join(dir)))
}

/// A call of cargo in the workspace root, free of what an outer `cargo run` left in the environment.
///
/// # Errors
/// As [`root`].
pub fn cargo() -> Result<Command, Error> {
    let mut command = Command::new(cargo_program());
    command.current_dir(root()?);
    clear_cargo_run(&mut command);
    Ok(command)
}

/// The cargo that runs `rig`, else the one on the path.
pub fn cargo_program() -> PathBuf {
    env::var_os("CARGO").map_or_else(|| "cargo".into(), PathBuf::from)
}

/// Removes the variables that `cargo run` sets for its program: build scripts watch some of them, and would run again
/// each time a nested cargo sees other values than the user's shell.
pub fn clear_cargo_run(command: &mut Command) {
    const SET_BY_CARGO_RUN: [&str; 4] = ["CARGO_PKG_", "CARGO_MANIFEST_", "CARGO_BIN_", "CARGO_CRATE_NAME"];
    for (name, _) in env::vars_os() {
        if name.to_str().is_some_and(|name| SET_BY_CARGO_RUN.iter().any(|prefix| name.starts_with(prefix))) {
            command.env_remove(name);
        }
    }
}

/// Identifies the device's sources: 16 hexadecimal digits that change when any of [`SOURCES`] does.
///
/// # Errors
/// If a file cannot be read.
pub fn build_id() -> Result<String, Error> {
    build_id_of(&root()?)
}

fn build_id_of(root: &Path) -> Result<String, Error> {
    let mut hash = Fnv1a::new();
    for source in SOURCES {
        hash_tree(root, Path::new(source), &mut hash)?;
    }
    Ok(format!("{:016x}", hash.0))
}

/// Adds a file, or all files below a directory in the order of their names.
fn hash_tree(root: &Path, relative: &Path, hash: &mut Fnv1a) -> Result<(), Error> {
    let path = root.join(relative);
    if !path.is_dir() {
        let contents = fs::read(&path).map_err(|error| {
            Error::target(format!("cannot read {}: {error}", path.display()), "check its permissions")
        })?;
        // Lengths and a separator-independent name keep one tree from hashing like another.
        for component in relative {
            hash.add(component.as_encoded_bytes());
            hash.add(b"/");
        }
        hash.add(&contents.len().to_le_bytes());
        hash.add(&contents);
        return Ok(());
    }
    entries(&path)?.iter().try_for_each(|name| hash_tree(root, &relative.join(name), hash))
}

/// The names in a directory, in their order.
///
/// # Errors
/// If it cannot be read.
pub fn entries(directory: &Path) -> Result<Vec<OsString>, Error> {
    let mut names = fs::read_dir(directory)
        .and_then(|entries| entries.map(|entry| entry.map(|entry| entry.file_name())).collect::<Result<Vec<_>, _>>())
        .map_err(|error| {
            Error::target(format!("cannot list {}: {error}", directory.display()), "check its permissions")
        })?;
    names.sort_unstable();
    Ok(names)
}

/// A short name for any text.
pub fn hash(text: &[u8]) -> u64 {
    let mut hash = Fnv1a::new();
    hash.add(text);
    hash.0
}

/// The 64-bit hash of Fowler, Noll and Vo, variant 1a: no defence against malice, plenty against a stale image.
struct Fnv1a(u64);

impl Fnv1a {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fnv_matches_its_published_vectors() {
        assert_eq!(hash(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(hash(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn the_build_id_follows_contents_and_names() {
        let root = env::temp_dir().join(format!("flat-build-id-{}", std::process::id()));
        let write = |name: &str, text: &str| {
            let path = root.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        };
        for file in ["Cargo.lock", "Cargo.toml", "memory.x", "firmware/main.rs", "shared/a/lib.rs"] {
            write(file, "as it was");
        }
        let first = build_id_of(&root).unwrap();
        assert_eq!(build_id_of(&root).unwrap(), first);

        write("shared/a/lib.rs", "as it is ");
        let edited = build_id_of(&root).unwrap();
        assert_ne!(edited, first);

        fs::rename(root.join("shared/a/lib.rs"), root.join("shared/a/bil.rs")).unwrap();
        assert_ne!(build_id_of(&root).unwrap(), edited);
        fs::remove_dir_all(&root).unwrap();
    }
}
