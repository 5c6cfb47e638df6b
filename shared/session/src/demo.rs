//! What a demo came to: all that a device without a host has to tell.

/// A demo that has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Demo {
    /// The scene's name.
    pub scene: &'static str,
    /// Steps done.
    pub steps: u32,
    /// Digest of the state after the last one.
    pub digest: u64,
    /// The longest time from when a step was due to its beginning, us.
    pub late_us: u32,
    /// The longest time that a step took, us.
    pub took_us: u32,
}
