//! What a scene can be varied by.

use core::fmt;
use core::ops::{Neg, RangeInclusive};

use fixed::types::I16F16;
use flat_physics::{BodyDef, Fixed, Shape, Vec2, vec2};

/// Parameters of a scene; made by [`Scene::parameters`](crate::Scene::parameters), which checks them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameters {
    /// Rigid bodies; walls and floors come on top.
    pub bodies: u16,
    /// Seed of everything random.
    pub seed: u32,
    /// Order of insertion.
    pub order: Order,
    /// Departures from the scene as it is written.
    pub variant: Variant,
}

/// The same scene, seen otherwise: a result that hangs on one lucky arrangement is none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Variant {
    /// Left and right change places.
    pub mirrored: bool,
    /// x and y change places; gravity then pulls to the right.
    pub transposed: bool,
    /// Shifted by this part of a px, in 1/65 536.
    pub phase: u16,
    /// Shifted by whole px.
    pub shift: [i16; 2],
    /// Strength of gravity, px/s2; none = the scene's.
    pub gravity: Option<i16>,
    /// Space between stacked bodies at the start, px.
    pub gap: u8,
    /// Mixed bodies.
    pub mix: Mix,
}

/// What varies from body to body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mix {
    /// What the scene says.
    #[default]
    None,
    /// Sizes too.
    Sizes,
    /// Masses too.
    Masses,
    /// Circles among boxes, boxes among circles.
    Shapes,
}

impl Variant {
    /// As the scene is written.
    pub const NONE: Self =
        Self { mirrored: false, transposed: false, phase: 0, shift: [0; 2], gravity: None, gap: 0, mix: Mix::None };

    /// A direction, velocity or offset of the scene as it is in the world.
    pub fn turn<T: Neg<Output = T>>(&self, Vec2 { x, y }: Vec2<T>) -> Vec2<T> {
        let x = if self.mirrored { -x } else { x };
        if self.transposed { vec2(y, x) } else { vec2(x, y) }
    }

    /// The inverse of [`turn`](Self::turn).
    pub fn turn_back<T: Neg<Output = T>>(&self, Vec2 { x, y }: Vec2<T>) -> Vec2<T> {
        let (x, y) = if self.transposed { (y, x) } else { (x, y) };
        vec2(if self.mirrored { -x } else { x }, y)
    }

    /// By how much the scene's origin is shifted, px.
    pub fn origin(&self) -> Vec2<I16F16> {
        let along = |whole: i16| I16F16::from_bits(i32::from(whole) << 16 | i32::from(self.phase));
        vec2(along(self.shift[0]), along(self.shift[1]))
    }

    /// A place in the scene as it is in the world. Where a shift leads out of the coordinate range, so does the result.
    pub(crate) fn place(&self, position: Vec2<I16F16>) -> Vec2<I16F16> {
        self.turn(position).saturating_add(self.origin())
    }

    /// A body of the scene as it is in the world.
    pub(crate) fn body(&self, def: BodyDef<Fixed>) -> BodyDef<Fixed> {
        let shape = match def.shape {
            Shape::Box { half } if self.transposed => Shape::Box { half: vec2(half.y, half.x) },
            shape => shape,
        };
        BodyDef { shape, position: self.place(def.position), velocity: self.turn(def.velocity), ..def }
    }
}

/// The departures that a scene can take. Another place suits every scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Takes {
    /// [`Variant::mirrored`], [`Variant::transposed`], [`Variant::phase`].
    pub turns: Turns,
    /// [`Variant::gravity`]: those that the battery tries; none = the scene's gravity is fixed.
    pub gravities: &'static [i16],
    /// [`Variant::gap`].
    pub gap: bool,
    /// [`Variant::mix`].
    pub mixes: &'static [Mix],
}

/// How a scene may be turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turns {
    /// Mirrored, transposed, shifted by parts of a px.
    Any,
    /// As any, but not transposed: it knows up from down.
    Mirror,
    /// Not at all: maps of tiles lie as they lie.
    Never,
}

impl Takes {
    /// Every turn, and nothing else.
    pub(crate) const PLACES: Self = Self { turns: Turns::Any, gravities: &[], gap: false, mixes: &[] };
    /// Other gravities too.
    pub(crate) const GRAVITIES: Self = Self { gravities: &[600], ..Self::PLACES };
    /// Everything.
    pub(crate) const ALL: Self =
        Self { turns: Turns::Any, gravities: &[600], gap: true, mixes: &[Mix::Sizes, Mix::Masses, Mix::Shapes] };

    /// What of a variant a scene can't take, in words.
    pub(crate) fn refused(&self, variant: &Variant) -> Option<&'static str> {
        let mixed = variant.mix != Mix::None && !self.mixes.contains(&variant.mix);
        let turned = variant.mirrored || variant.phase != 0;
        let refusals = [
            (variant.transposed && self.turns != Turns::Any, "it cannot be transposed"),
            (turned && self.turns == Turns::Never, "its tiles cannot be mirrored, nor shifted by parts of a px"),
            (variant.gravity.is_some() && self.gravities.is_empty(), "its gravity is fixed"),
            (variant.gap != 0 && !self.gap, "there is no room for a gap"),
            (mixed, "its bodies cannot be mixed that way"),
        ];
        refusals.into_iter().find(|(refused, _)| *refused).map(|(_, why)| why)
    }
}

/// Order in which a scene's bodies are inserted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// As numbered.
    #[default]
    Forward,
    /// Last first.
    Reverse,
    /// A permutation drawn from the seed.
    Shuffled,
}

/// A parameter that a scene doesn't take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParameterError {
    /// Too few or too many bodies.
    Bodies {
        /// The scene.
        scene: &'static str,
        /// Bodies asked for.
        bodies: u16,
        /// What the scene can do.
        range: RangeInclusive<u16>,
    },
    /// A departure that makes no sense there.
    Variant {
        /// The scene.
        scene: &'static str,
        /// Why not.
        why: &'static str,
    },
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bodies { scene, bodies, range } => {
                write!(f, "{scene}: bodies is {bodies}, must be {}..={}", range.start(), range.end())
            }
            Self::Variant { scene, why } => write!(f, "{scene}: {why}"),
        }
    }
}

impl core::error::Error for ParameterError {}

impl Parameters {
    /// The number of the body that is inserted as the `place`-th of `total`: a permutation of `0..total`.
    pub fn nth(&self, place: u16, total: u16) -> u16 {
        match self.order {
            Order::Forward => place,
            Order::Reverse => total - 1 - place,
            Order::Shuffled => self.shuffled(place, total),
        }
    }

    /// A permutation of the next power of two, walked until it is back inside `0..total`.
    fn shuffled(&self, place: u16, total: u16) -> u16 {
        let bits = u32::from(total).next_power_of_two().trailing_zeros();
        let mask = (1 << bits) - 1;
        let mut number = u32::from(place);
        loop {
            for round in 0..4 {
                // An odd factor and a shift to the right are both one-to-one on `bits` bits.
                let key = hash(self.seed, round);
                number = number.wrapping_mul(key | 1).wrapping_add(key >> 8) & mask;
                number ^= number >> bits.div_ceil(2);
            }
            if number < u32::from(total) {
                return number as u16;
            }
        }
    }

    /// A random number for the `index`-th use, uniform over -65 536..65 536 (Q16: -1..1 px).
    pub(crate) fn jitter(&self, index: u32) -> i32 {
        (hash(self.seed, index) >> 15) as i32 - 65_536
    }
}

/// Scrambles a seed and a counter (C. Wellons' `lowbias32`, 2018).
fn hash(seed: u32, index: u32) -> u32 {
    let mut x = seed.wrapping_mul(0x9e37_79b9) ^ index;
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_order_inserts_each_body_once() {
        for order in [Order::Forward, Order::Reverse, Order::Shuffled] {
            for total in (1..70).chain([100, 1000, 4096]) {
                let parameters = Parameters { bodies: total, seed: 7, order, variant: Variant::NONE };
                let seen: BTreeSet<_> = (0..total).map(|place| parameters.nth(place, total)).collect();
                assert_eq!((seen.len(), seen.last()), (usize::from(total), Some(&(total - 1))), "{order:?} {total}");
            }
        }
    }

    #[test]
    fn another_seed_shuffles_otherwise() {
        let order = |seed| {
            let parameters = Parameters { bodies: 100, seed, order: Order::Shuffled, variant: Variant::NONE };
            (0..100).map(move |place| parameters.nth(place, 100)).collect::<std::vec::Vec<_>>()
        };
        assert_ne!(order(1), order(2));
        assert_ne!(order(1), (0..100).collect::<std::vec::Vec<_>>());
    }

    #[test]
    fn a_turn_back_undoes_a_turn() {
        for (mirrored, transposed) in [(false, false), (true, false), (false, true), (true, true)] {
            let variant = Variant { mirrored, transposed, ..Variant::NONE };
            assert_eq!(variant.turn_back(variant.turn(vec2(3, 5))), vec2(3, 5), "{variant:?}");
        }
        let both = Variant { mirrored: true, transposed: true, ..Variant::NONE };
        assert_eq!(both.turn(vec2(3, 5)), vec2(5, -3), "mirrored first");
    }

    #[test]
    fn jitter_fills_its_range() {
        let parameters = Parameters { bodies: 1, seed: 1, order: Order::Forward, variant: Variant::NONE };
        let (mut low, mut high, mut sum) = (0, 0, 0i64);
        for index in 0..10_000 {
            let jitter = parameters.jitter(index);
            (low, high, sum) = (low.min(jitter), high.max(jitter), sum + i64::from(jitter));
        }
        assert!(low < -65_000 && high > 65_000 && low >= -65_536 && high < 65_536, "{low}..{high}");
        assert!((sum / 10_000).abs() < 2_000, "mean {}", sum / 10_000);
    }
}
