//! The ESP32's firmware: a build where espup has installed a compiler for Xtensa, else a type-check.
//!
//! Upstream's rustc knows the Xtensa targets but refuses their inline assembly, and cannot generate code for all of core.
//! What it can do is resolve names, check types and check borrows, if it never sees an assembler template:
//! 1. core comes from a copy in which `asm!` and `naked_asm!` are `loop {}` and `global_asm!` is nothing;
//! 2. the crates with naked functions come from copies without that attribute, since a naked function may hold nothing but
//!    assembly;
//! 3. `-Zno-codegen` ends each crate before code generation.
//!
//! The copies are made at check time, of the very versions in `Cargo.lock`, and kept until a version changes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use super::image::{self, Board, Build};
use super::toolchain::Compiler;
use super::{subprocess, toolchain, workspace};
use crate::error::Error;

/// The target of the board.
pub const XTENSA_TARGET: &str = "xtensa-esp32-none-elf";
/// Crates with naked functions for Xtensa.
const NAKED: [&str; 2] = ["esp-hal", "esp-rtos"];
/// The attribute that the copies go without.
const NAKED_ATTRIBUTE: &str = "#[unsafe(naked)]";

/// What could be done for the ESP32.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// A real image.
    Built(PathBuf),
    /// Types hold; there is no image.
    TypeChecked {
        /// Who checked.
        release: String,
    },
    /// Nothing, for want of what this names.
    Skipped(String),
}

/// Builds the ESP32's firmware where espup's toolchain is, else checks its types where a compiler's library sources are.
///
/// # Errors
/// If the firmware is wrong, or the copies can no longer be made as described above.
pub fn check() -> Result<Outcome, Error> {
    if has_espup() {
        return image::build(Board::Esp32).map(Outcome::Built);
    }
    let Some((compiler, library)) = Compiler::with_library_source() else {
        return Ok(Outcome::Skipped(
            "needs espup's toolchain to build, or library sources to type-check: `rustup component add rust-src`, \
             or on Debian `apt install rustc-web rust-web-src`"
                .into(),
        ));
    };
    type_check(&compiler, &library, Build { second_core: true, ..Build::PRODUCT })?;
    for kind in [Build::PRODUCT, Build::BARE, Build::TESTS] {
        type_check(&compiler, &library, kind)?;
    }
    Ok(Outcome::TypeChecked { release: compiler.release })
}

fn has_espup() -> bool {
    toolchain::installed("rustup").is_some()
        && Command::new("rustup")
            .args(["run", "esp", "rustc", "--version"])
            .env("RUSTUP_AUTO_INSTALL", "0")
            .output()
            .is_ok_and(|output| output.status.success())
}

/// A call of a cargo subcommand with espup's toolchain.
///
/// # Errors
/// If that toolchain isn't there; the error says how to get it.
pub fn cargo(subcommand: &str) -> Result<Command, Error> {
    if !has_espup() {
        return Err(Error::target(
            "no compiler for the ESP32: its Xtensa core takes Espressif's",
            "`firmware/esp32.sh`, which installs it; docs/boards.md has the steps one by one",
        ));
    }
    let mut cargo = Command::new("rustup");
    cargo.current_dir(workspace::root()?).args(["run", "esp", "cargo", subcommand, "--target", XTENSA_TARGET]);
    cargo.args(["-Zbuild-std=core,alloc", "--target-dir"]).arg(workspace::target_dir()?.join("firmware"));
    workspace::clear_cargo_run(&mut cargo);
    // The outer cargo's own choices, which would win over `rustup run`.
    cargo.env_remove("RUSTC").env_remove("RUSTUP_TOOLCHAIN");
    Ok(cargo)
}

fn type_check(compiler: &Compiler, library: &Path, kind: Build) -> Result<(), Error> {
    let directory = workspace::target_dir()?.join("esp32-check");
    let crates = locate_crates()?;
    let copies = Copies { library: directory.join("library"), crates: directory.join("crates") };
    copies.refresh(&directory.join("made-of"), compiler, library, &crates)?;

    let mut cargo = workspace::cargo()?;
    cargo.args(["check", "--locked", "--target", XTENSA_TARGET, "--target-dir"]).arg(directory.join("build"));
    cargo.args(["-Zbuild-std=core,alloc", "--config"]).arg(copies.override_paths());
    compiler.lend_to(&mut cargo);
    cargo.env("__CARGO_TESTS_ONLY_SRC_ROOT", &copies.library);
    cargo.env_remove("CARGO_ENCODED_RUSTFLAGS").env("RUSTFLAGS", "-Zno-codegen -Dwarnings");
    image::choose(Board::Esp32, kind, &mut cargo)?;
    cargo.args(["--bins", "--examples"]);
    subprocess::run("type-checking the esp32 firmware", &mut cargo).map(drop)
}

/// A crate's sources in cargo's registry.
#[derive(Debug)]
struct Crate {
    name: String,
    version: String,
    sources: PathBuf,
}

/// Finds the sources of the crates in [`NAKED`], in the versions of `Cargo.lock`; cargo fetches them if need be.
fn locate_crates() -> Result<Vec<Crate>, Error> {
    let mut cargo = workspace::cargo()?;
    cargo.args(["metadata", "--locked", "--quiet", "--format-version=1", "--all-features"]);
    let output = cargo.output().map_err(|error| Error::target(format!("cannot run cargo metadata: {error}"), ""))?;
    if !output.status.success() {
        let complaint = String::from_utf8_lossy(&output.stderr);
        return Err(Error::target(format!("cargo metadata failed:\n{}", complaint.trim_end()), ""));
    }
    let metadata: Value = serde_json::from_slice(&output.stdout)
        .map_err(|error| Error::target(format!("cargo metadata is no JSON: {error}"), ""))?;
    NAKED.iter().map(|name| locate(&metadata, name)).collect()
}

fn locate(metadata: &Value, name: &str) -> Result<Crate, Error> {
    let packages = metadata["packages"].as_array().into_iter().flatten();
    let found = packages.into_iter().find(|package| package["name"] == name).and_then(|package| {
        let manifest = Path::new(package["manifest_path"].as_str()?);
        Some(Crate {
            name: name.to_owned(),
            version: package["version"].as_str()?.to_owned(),
            sources: manifest.parent()?.to_owned(),
        })
    });
    found.ok_or_else(|| recipe_is_out_of_date(&format!("the firmware no longer depends on {name}")))
}

/// The copies that the compiler sees in place of the originals.
#[derive(Debug)]
struct Copies {
    library: PathBuf,
    crates: PathBuf,
}

impl Copies {
    /// Makes the copies, unless those that are there were made of the same things.
    fn refresh(&self, stamp: &Path, compiler: &Compiler, library: &Path, crates: &[Crate]) -> Result<(), Error> {
        let versions: Vec<_> = crates.iter().map(|Crate { name, version, .. }| format!("{name} {version}")).collect();
        let made_of = format!("rustc {}, {}, {}\n", compiler.release, library.display(), versions.join(", "));
        // Written last: a stamp means that the copies are whole.
        if fs::read_to_string(stamp).is_ok_and(|text| text == made_of) {
            return Ok(());
        }
        for directory in [&self.library, &self.crates] {
            remove(directory)?;
            fs::create_dir_all(directory).map_err(|error| unwritable(directory, &error))?;
        }
        self.copy_library(library)?;
        for found in crates {
            self.copy_crate(found)?;
        }
        fs::write(stamp, made_of).map_err(|error| unwritable(stamp, &error))
    }

    /// Copies core and takes its assembly macros away; the rest of the library is linked to.
    fn copy_library(&self, library: &Path) -> Result<(), Error> {
        for name in workspace::entries(library)? {
            let (from, to) = (library.join(&name), self.library.join(&name));
            if name == "core" {
                copy_tree(&from, &to)?;
            } else {
                link(&from, &to)?;
            }
        }
        let arch = self.library.join("core/src/arch.rs");
        edit(&arch, |text| {
            ["asm", "naked_asm", "global_asm"].into_iter().try_fold(text.to_owned(), |text, name| {
                let expansion = if name == "global_asm" { "" } else { "loop {}" };
                replace_builtin_macro(&text, name, expansion)
            })
        })
    }

    /// Copies a crate and takes its naked functions' attribute away, and warnings about what that leaves unused.
    fn copy_crate(&self, found: &Crate) -> Result<(), Error> {
        let copy = self.crates.join(&found.name);
        copy_tree(&found.sources, &copy)?;
        let mut removed = 0;
        for file in rust_files(&copy.join("src"))? {
            let text = read(&file)?;
            let count = text.matches(NAKED_ATTRIBUTE).count();
            if count > 0 {
                write(&file, &text.replace(NAKED_ATTRIBUTE, ""))?;
                removed += count;
            }
        }
        if removed == 0 {
            let Crate { name, version, .. } = found;
            return Err(recipe_is_out_of_date(&format!("{name} {version} has no {NAKED_ATTRIBUTE}")));
        }
        edit(&copy.join("src/lib.rs"), |text| Some(format!("#![allow(warnings)]\n{text}")))
    }

    /// Cargo's setting that puts the crates' copies in place of the originals and leaves `Cargo.lock` alone.
    fn override_paths(&self) -> String {
        let paths = NAKED.map(|name| Value::from(self.crates.join(name).to_string_lossy()));
        format!("paths={}", Value::from(paths.to_vec()))
    }
}

/// Puts an ordinary macro in place of a compiler's own; none if its definition isn't found as expected.
fn replace_builtin_macro(text: &str, name: &str, expansion: &str) -> Option<String> {
    const ATTRIBUTE: &str = "#[rustc_builtin_macro]\n";
    let head = format!("{ATTRIBUTE}pub macro {name}(");
    let start = text.find(&head)?;
    let end = start + text[start..].find("\n}\n")? + 3;
    let definition = format!("pub macro {name}($($template:tt)*) {{ {expansion} }}\n");
    Some([&text[..start], &definition, &text[end..]].concat())
}

fn recipe_is_out_of_date(why: &str) -> Error {
    Error::target(
        format!("the ESP32 type-check no longer fits its sources: {why}"),
        "see host-harness/src/firmware/esp32.rs",
    )
}

fn unwritable(path: &Path, error: &std::io::Error) -> Error {
    Error::target(format!("cannot write {}: {error}", path.display()), "")
}

fn read(path: &Path) -> Result<String, Error> {
    fs::read_to_string(path).map_err(|error| Error::target(format!("cannot read {}: {error}", path.display()), ""))
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    // The copy keeps the original's permissions, which may forbid writing.
    fs::remove_file(path).and_then(|()| fs::write(path, text)).map_err(|error| unwritable(path, &error))
}

fn edit(path: &Path, change: impl FnOnce(&str) -> Option<String>) -> Result<(), Error> {
    let changed = change(&read(path)?)
        .ok_or_else(|| recipe_is_out_of_date(&format!("{} doesn't define what it used to", path.display())))?;
    write(path, &changed)
}

fn remove(directory: &Path) -> Result<(), Error> {
    match fs::remove_dir_all(directory) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(unwritable(directory, &error)),
        _ => Ok(()),
    }
}

fn copy_tree(from: &Path, to: &Path) -> Result<(), Error> {
    if !from.is_dir() {
        return fs::copy(from, to).map(drop).map_err(|error| unwritable(to, &error));
    }
    fs::create_dir_all(to).map_err(|error| unwritable(to, &error))?;
    workspace::entries(from)?.iter().try_for_each(|name| copy_tree(&from.join(name), &to.join(name)))
}

fn rust_files(directory: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut files = Vec::new();
    for name in workspace::entries(directory)? {
        let path = directory.join(name);
        if path.is_dir() {
            files.extend(rust_files(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(files)
}

#[cfg(unix)]
fn link(from: &Path, to: &Path) -> Result<(), Error> {
    std::os::unix::fs::symlink(from, to).map_err(|error| unwritable(to, &error))
}

#[cfg(not(unix))]
fn link(from: &Path, to: &Path) -> Result<(), Error> {
    copy_tree(from, to)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARCH: &str = "/// Doc.\n#[rustc_builtin_macro]\npub macro asm(\"template\", $(operands,)*) {\n    /* built-in */\n}\n\nnext\n";

    #[test]
    fn a_builtin_macro_becomes_an_ordinary_one() {
        let replaced = replace_builtin_macro(ARCH, "asm", "loop {}").unwrap();
        assert_eq!(replaced, "/// Doc.\npub macro asm($($template:tt)*) { loop {} }\n\nnext\n");
    }

    #[test]
    fn a_macro_that_is_gone_is_not_passed_over() {
        assert_eq!(replace_builtin_macro(ARCH, "naked_asm", ""), None);
    }
}
