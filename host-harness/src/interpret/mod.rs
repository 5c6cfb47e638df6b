//! An interpreter of rv32imc programs that counts what they execute, instruction by instruction and class by class.
//!
//! It runs probes: programs without devices, made of the engine and a scene. Counts are exact, the same as those of any rv32imc
//! processor; cycles are an estimate from the classes.
//!
//! ```text
//! image ─▶ decode ─▶ machine ─▶ Tally of each stretch between two marks ─▶ classes ─▶ cycles
//!          compressed
//! ```

mod classes;
mod compressed;
mod decode;
mod machine;

pub use classes::{Class, Tally};
pub use machine::{Call, Machine};
