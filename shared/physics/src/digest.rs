//! 64 bits that differ when the state does.

use crate::scalar::{Quantity, Scalar};
use crate::vec2::Vec2;
use crate::world::World;

/// FNV-1a (Fowler, Noll, Vo) over 32-bit words, with a final mix. Every step of it is a bijection, so two states that differ in
/// one word always differ in their digests.
struct Hasher(u64);

impl Hasher {
    const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn word(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3);
    }

    fn quantity(&mut self, quantity: impl Quantity) {
        let bits = quantity.bits();
        self.word(bits as u32);
        // Formats of 32 bits leave nothing in the upper half that the lower doesn't tell.
        if size_of_val(&quantity) > 4 {
            self.word((bits >> 32) as u32);
        }
    }

    fn vector(&mut self, vector: Vec2<impl Quantity>) {
        self.quantity(vector.x);
        self.quantity(vector.y);
    }

    fn finish(self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }
}

/// Digest of all that a step changes: the state of every body and the contacts of the step. Equal on every chip.
pub fn digest<S: Scalar>(world: &World<'_, S>) -> u64 {
    let mut hasher = Hasher::new();
    for (slot, body) in world.slots_from(0) {
        hasher.word(u32::from(slot) << 8 | u32::from(body.status.bits()));
        hasher.vector(body.position);
        hasher.vector(body.velocity);
        hasher.word(u32::from(body.remainder.x as u16) << 16 | u32::from(body.remainder.y as u16));
    }
    for contact in world.pool.waking_and_asleep() {
        hasher.word(u32::from(contact.a) << 16 | u32::from(contact.b));
        hasher.vector(contact.normal);
        hasher.quantity(contact.gap);
        hasher.vector(contact.impulse);
    }
    for tiles in world.tiles.bytes().chunks(4) {
        hasher.word(tiles.iter().fold(0, |word, &tile| word << 8 | u32::from(tile)));
    }
    hasher.finish()
}
