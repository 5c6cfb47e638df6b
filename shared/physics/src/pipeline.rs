//! The stages of a [`step`](crate::step()), and the scheduler that says when one is due.
//!
//! | stage | files |
//! |---|---|
//! | detect | `sleep`; `broadphase`, which takes `order`, `sweep`, `grid` and `pairs`; `narrowphase`, with `one_way` and `terrain` |
//! | integrate velocity | `integrate`, which begins with `bounce` |
//! | solve velocity | `flat`, or `carry`, `warm_start` and `grounded`, by level |
//! | integrate position | `ccd`, and `integrate` again |
//! | correct penetration | `position`, and `carry` again |
//! | events | `events` |

pub mod scheduler;

pub(crate) mod bounce;
pub(crate) mod broadphase;
pub(crate) mod carry;
pub(crate) mod ccd;
pub(crate) mod events;
pub(crate) mod flat;
pub(crate) mod grid;
pub(crate) mod grounded;
pub(crate) mod integrate;
pub(crate) mod narrowphase;
pub(crate) mod one_way;
pub(crate) mod order;
pub(crate) mod pairs;
pub(crate) mod position;
pub(crate) mod sleep;
pub(crate) mod sweep;
pub(crate) mod terrain;
pub(crate) mod warm_start;
