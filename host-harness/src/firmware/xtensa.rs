//! The device program for an Xtensa core: built without Espressif's compiler, and run in QEMU.
//!
//! Upstream's LLVM generates code for Xtensa, but not yet all there is to a program:
//! 1. rustc and LLVM disagree about the layout of data: the target is rustc's own with LLVM's layout;
//! 2. LLVM's own assembler misplaces literals: it writes text, which binutils assemble;
//! 3. it can't generate all of core: only what is linked is generated, since all crates are optimised as one;
//! 4. Debian's binutils know one such core, the `lx106` of the ESP8266: an ESP32's without register windows and floating point.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use super::image::PROFILE;
use super::product::Turn;
use super::toolchain::{self, Compiler};
use super::{subprocess, workspace};
use crate::error::Error;

/// The program.
const PACKAGE: &str = "flat-xtensa";
/// What the generated code calls for what the processor can't do.
const INTRINSICS: &str = "compiler_builtins";

/// The target whose definition ours departs from, and ours.
const UPSTREAM: &str = "xtensa-esp32-none-elf";
const TARGET: &str = "xtensa-lx106-none-elf";
/// As LLVM calls the core, and the layout of data that it has for it.
const CPU: &str = "esp8266";
const DATA_LAYOUT: &str = "e-m:e-p:32:32-i8:8:32-i16:16:32-i64:64-n32";
/// The release of LLVM that all this was found to hold for.
const LLVM: &str = "22.";

/// One of Debian's tools; the others come with it.
pub const ASSEMBLER: &str = "xtensa-lx106-elf-as";
const LINKER: &str = "xtensa-lx106-elf-ld";
const QEMU: &str = "qemu-system-xtensa";
/// QEMU's simulator of that core.
const MACHINE: &str = "-M sim -cpu lx106 -semihosting -display none -serial none -monitor none -kernel";
/// Debian's package of assembler and linker.
pub const BINUTILS: &str = "binutils-xtensa-lx106";

/// Builds the program; or says what it takes.
///
/// # Errors
/// If it doesn't compile, or the workspace cannot be written to.
pub fn build() -> Result<Result<PathBuf, String>, Error> {
    let tools = [(ASSEMBLER, BINUTILS), (QEMU, "qemu-system-misc")];
    if let Some((tool, package)) = tools.iter().find(|(tool, _)| toolchain::installed(tool).is_none()) {
        return Ok(Err(format!("needs {tool}: on Debian `apt install {package}`")));
    }
    let Some((compiler, _)) = Compiler::with_library_source().filter(|(compiler, _)| compiler.llvm.starts_with(LLVM))
    else {
        return Ok(Err(format!(
            "needs a rustc on LLVM {LLVM}x with its library's sources: `rustup component add rust-src`, or on Debian \
             `apt install {}`",
            toolchain::DEBIAN_COMPILER[..2].join(" ")
        )));
    };
    let directory = workspace::target_dir()?.join("xtensa");
    let turn = Turn::wait(&directory)?;
    let target = define(&compiler, &directory)?;
    let package = workspace::root()?.join("host-harness/xtensa");
    let mut sources = vec![package.join("start.S")];

    let mut cargo = workspace::cargo()?;
    cargo.args(["build", "--locked", "--package", PACKAGE, "--profile", PROFILE, "--target"]).arg(&target);
    cargo.arg("--target-dir").arg(directory.join("build"));
    cargo.args(["-Zbuild-std=core", "-Zjson-target-spec", "-Zprofile-rustflags"]);
    cargo.args(["--config", &format!("profile.{PROFILE}.debug=false")]);
    for name in [PACKAGE, INTRINSICS] {
        let source = directory.join(name).with_extension("s");
        let flags = Value::from(vec![format!("--emit=asm={}", source.display())]);
        cargo.args(["--config", &format!("profile.{PROFILE}.package.{name}.rustflags={flags}")]);
        sources.push(source);
    }
    compiler.lend_to(&mut cargo);
    cargo.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
    cargo.env("FLAT_BUILD", workspace::build_id()?);
    subprocess::run("building the program for Xtensa", &mut cargo)?;

    let linked = directory.join("linked.elf");
    link(&package.join("simulator.x"), &sources, &linked)?;
    let image = directory.join(PACKAGE).with_extension("elf");
    turn.keep(&linked, &image)?;
    Ok(Ok(image))
}

/// The command that runs a program, its frames on standard input and output.
pub fn emulation(program: &Path) -> String {
    format!("{QEMU} {MACHINE} {}", shell_words::quote(&program.to_string_lossy()))
}

/// Writes the target's definition.
fn define(compiler: &Compiler, directory: &Path) -> Result<PathBuf, Error> {
    let mut rustc = Command::new(&compiler.rustc);
    rustc.env("RUSTC_BOOTSTRAP", "1").args(["-Zunstable-options", "--print=target-spec-json", "--target", UPSTREAM]);
    let text = subprocess::run("rustc's definition of the target", &mut rustc)?;
    let mut definition: Value = serde_json::from_str(&text)
        .map_err(|error| Error::target(format!("rustc's definition of {UPSTREAM} is no JSON: {error}"), ""))?;
    definition["cpu"] = CPU.into();
    definition["data-layout"] = DATA_LAYOUT.into();
    let path = directory.join(TARGET).with_extension("json");
    // Cargo builds all anew for a definition that has changed, by its time.
    let text = definition.to_string();
    if fs::read_to_string(&path).is_ok_and(|present| present == text) {
        return Ok(path);
    }
    fs::write(&path, text).map_err(|error| Error::target(format!("cannot write {}: {error}", path.display()), ""))?;
    Ok(path)
}

/// Assembles sources and links them.
fn link(script: &Path, sources: &[PathBuf], to: &Path) -> Result<(), Error> {
    let mut linker = Command::new(LINKER);
    linker.args(["--gc-sections", "-z", "noexecstack", "-T"]).arg(script);
    for source in sources {
        let object = to.with_file_name(source.file_name().unwrap_or_default()).with_extension("o");
        subprocess::run(ASSEMBLER, Command::new(ASSEMBLER).arg(source).arg("-o").arg(&object))?;
        linker.arg(object);
    }
    subprocess::run(LINKER, linker.arg("-o").arg(to)).map(drop)
}
