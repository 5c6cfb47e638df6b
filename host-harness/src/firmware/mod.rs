//! Everything between the firmware's sources and an image that has been looked at: a compiler for the boards, the build,
//! and checks on what came out.
//!
//! ```text
//!   provision -> toolchain -> image -> elf (instructions), hot_path (dwarf)
//!                    |
//!                    |-> esp32 (a type-check where there is no compiler for the whole chip)
//!                    `-> xtensa (the chip-free crates on such a core)
//! ```

pub mod dwarf;
pub mod elf;
pub mod esp32;
pub mod flash;
pub mod flow;
pub mod hot_path;
pub mod image;
pub mod inspect;
pub mod instructions;
pub mod logs;
pub mod memory;
pub mod operation;
pub mod product;
pub mod provision;
pub mod references;
pub mod subprocess;
pub mod suite;
pub mod symbols;
pub mod toolchain;
pub mod workspace;
pub mod xtensa;
