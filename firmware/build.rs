//! Linker set-up for the chosen board, and a clear word where none or several are chosen.

use std::path::Path;
use std::{env, fs, io};

/// Board, target architecture, target to name in advice, linker arguments.
type Board = (&'static str, &'static str, &'static str, &'static [&'static str]);

const BOARDS: [Board; 3] = [
    ("qemu_virt", "riscv32", "riscv32imc-unknown-none-elf", &["-Tmemory.x", "-Tlink.x", "-Tdefmt.x"]),
    ("esp32c3", "riscv32", "riscv32imc-unknown-none-elf", &["-Tlinkall.x", "-Tdefmt.x"]),
    ("esp32", "xtensa", "xtensa-esp32-none-elf", &["-nostartfiles", "-Wl,-Tlinkall.x", "-Wl,-Tdefmt.x"]),
];

/// Features that one board alone has.
const ONLY: [(&str, &str); 2] = [("usb", "esp32c3"), ("second-core", "esp32")];

fn main() -> io::Result<()> {
    let chosen = BOARDS.iter().filter(|(name, ..)| is_chosen(name)).collect::<Vec<_>>();
    let [(name, arch, target, link_args)] = chosen[..] else {
        let names = BOARDS.map(|(name, ..)| name).join(", ");
        println!("cargo::error=choose exactly one board with --features, out of {names}; chosen: {}", chosen.len());
        return Ok(());
    };
    if env::var("CARGO_CFG_TARGET_ARCH").as_deref() != Ok(arch) {
        println!("cargo::error=board {name} is built with --target {target}");
        return Ok(());
    }
    for (feature, board) in ONLY {
        if is_chosen(feature) && board != *name {
            println!("cargo::error=feature {feature} is for board {board}; chosen: {name}");
        }
    }

    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    let memory = if *name == "qemu_virt" { "qemu_virt" } else { "esp" };
    provide(&format!("{memory}.x"), Path::new(&out).join("board-memory.x"))?;
    for hook in ["rwtext_hook.x", "rwdata_hook.x"] {
        provide(hook, Path::new(&out).join(hook))?;
    }
    println!("cargo::rustc-link-search={out}");
    for arg in *link_args {
        println!("cargo::rustc-link-arg-bins={arg}");
        println!("cargo::rustc-link-arg-examples={arg}");
    }
    // Asked for by embedded-test's macro.
    println!("cargo::rustc-check-cfg=cfg(rust_analyzer)");
    if is_chosen("tests") {
        // On Xtensa, gcc calls the linker.
        let linker = if *arch == "xtensa" { "-Wl," } else { "" };
        println!("cargo::rustc-link-arg-bins={linker}-Tembedded-test.x");
    }
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=../memory.x");
    Ok(())
}

/// Whether a feature is on.
fn is_chosen(feature: &str) -> bool {
    env::var_os(format!("CARGO_FEATURE_{}", feature.to_uppercase().replace('-', "_"))).is_some()
}

/// Puts a linker script of this crate where the linker looks for it.
fn provide(script: &str, to: impl AsRef<Path>) -> io::Result<()> {
    let from = Path::new("memory").join(script);
    println!("cargo::rerun-if-changed={}", from.display());
    fs::copy(from, to).map(drop)
}
