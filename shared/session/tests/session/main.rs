//! The device program, driven by a clock and a line made of integers.

mod commands;
mod device;
mod line;
mod pace;
mod play;
mod stream;
