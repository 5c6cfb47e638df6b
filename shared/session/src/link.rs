//! What the receiving end of a link knows.

/// What the receiver has counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LinkCounters {
    /// Frames received intact.
    pub received: u32,
    /// Frames received damaged, and discarded.
    pub damaged: u32,
}
