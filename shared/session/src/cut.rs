//! Text in a fixed room.

use core::fmt::{self, Write};

use heapless::String;

/// As much of a text as fits, whole characters only.
pub fn cut<const N: usize>(text: fmt::Arguments<'_>) -> String<N> {
    let mut cut = String::new();
    // The error is how writing stops at the end of the room.
    let _ = Cut(&mut cut).write_fmt(text);
    cut
}

struct Cut<'a, const N: usize>(&'a mut String<N>);

impl<const N: usize> Write for Cut<'_, N> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        text.chars().try_for_each(|character| self.0.push(character).map_err(|_| fmt::Error))
    }
}
