//! The smallest game, built for boxes of equal mass alone.
#![no_std]
#![no_main]
#![deny(clippy::undocumented_unsafe_blocks)]

use flat_physics::Variety;

/// The entry.
// SAFETY: the only symbol of that name; the linker script enters here.
#[unsafe(no_mangle)]
extern "C" fn probe() -> ! {
    flat_probe::game::run::<{ Variety::BOXES.bits() }>()
}
