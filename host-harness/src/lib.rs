//! What `rig` checks, for the tests that check it without a target.
#![deny(missing_docs)]

pub mod check;
pub mod input;
pub mod number;
pub mod variant;
