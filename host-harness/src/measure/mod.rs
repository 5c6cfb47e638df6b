//! Measuring: what a step costs on a target, stage by stage, and what that says about a chip.
//!
//! ```text
//! Job ─▶ Meter ─▶ Sample ─▶ Summary ─▶ profile, tradeoff, effects, baseline
//!        a target   counts    mean, p99, worst
//! ```

pub mod clock;
pub mod evaluate;
pub mod meter;
pub mod pareto;
pub mod probe;
pub mod provenance;
pub mod sample;
pub mod summary;

pub use clock::{Clock, Cycles};
pub use meter::Meter;
pub use sample::Sample;
pub use summary::Summary;
