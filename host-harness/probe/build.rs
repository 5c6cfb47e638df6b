//! Tells the linker where a probe lies in memory.

fn main() {
    let here = std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets CARGO_MANIFEST_DIR");
    println!("cargo::rustc-link-arg-bins=-T{here}/probe.x");
    println!("cargo::rerun-if-changed=probe.x");
}
