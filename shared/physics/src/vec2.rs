//! A pair of components along x (right) and y (down).

use core::ops::{Add, Neg, Sub};

/// Two components of the same quantity: x to the right, y down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vec2<T> {
    /// Rightward component.
    pub x: T,
    /// Downward component.
    pub y: T,
}

/// Shorthand for a [`Vec2`].
pub const fn vec2<T>(x: T, y: T) -> Vec2<T> {
    Vec2 { x, y }
}

impl<T> Vec2<T> {
    /// Applies a function to both components.
    #[inline]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Vec2<U> {
        vec2(f(self.x), f(self.y))
    }
}

impl<T: Add<Output = T>> Add for Vec2<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        vec2(self.x + other.x, self.y + other.y)
    }
}

impl<T: Sub<Output = T>> Sub for Vec2<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        vec2(self.x - other.x, self.y - other.y)
    }
}

impl<T: Neg<Output = T>> Neg for Vec2<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        vec2(-self.x, -self.y)
    }
}
