//! Memory that a restart leaves alone.

use core::ptr;

use flat_wire::MAX_FRAME;

/// How many words: a mark, a length, a frame.
pub(crate) const WORDS: usize = 2 + MAX_FRAME / 4;

/// [`WORDS`] words that a restart leaves as they are. Power-on clears them or leaves them to chance.
pub(crate) struct Kept(*mut u32);

impl Kept {
    /// # Safety
    ///
    /// So many words of RAM lie there, and nothing else ever uses them.
    pub(crate) const unsafe fn at(words: *mut u32) -> Self {
        Self(words)
    }

    /// Reads a word.
    pub(crate) fn get(&self, index: usize) -> u32 {
        assert!(index < WORDS, "word {index} of {WORDS}");
        // SAFETY: inside, as `at` was promised.
        unsafe { ptr::read_volatile(self.0.add(index)) }
    }

    /// Writes a word.
    pub(crate) fn set(&self, index: usize, word: u32) {
        assert!(index < WORDS, "word {index} of {WORDS}");
        // SAFETY: as above.
        unsafe { ptr::write_volatile(self.0.add(index), word) }
    }
}
