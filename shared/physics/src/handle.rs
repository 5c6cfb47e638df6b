//! Names for bodies.

/// Names a body. A handle outlives its body without harm: it then names nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Handle {
    pub(crate) slot: u16,
    pub(crate) generation: u16,
}

impl Handle {
    /// Place of the body in the world's storage.
    pub fn slot(self) -> u16 {
        self.slot
    }

    /// How many bodies the slot had held before (modulo 65 536).
    pub fn generation(self) -> u16 {
        self.generation
    }
}
