//! Trials of the device itself: what a bad link must not do to it, and what it must say when it fails.

pub mod disturbance;
pub mod faults;
pub mod stress;
pub mod unit_tests;
