//! What a scene can be varied by.

use core::fmt;
use core::ops::RangeInclusive;

/// Parameters of a scene; made by [`Scene::parameters`](crate::Scene::parameters), which checks them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameters {
    /// Rigid bodies; walls and floors come on top.
    pub bodies: u16,
    /// Seed of everything random.
    pub seed: u32,
    /// Order of insertion.
    pub order: Order,
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

/// A parameter outside its range.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParameterError {
    /// The scene.
    pub scene: &'static str,
    /// Bodies asked for.
    pub bodies: u16,
    /// What the scene can do.
    pub range: RangeInclusive<u16>,
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = (self.range.start(), self.range.end());
        write!(f, "{}: bodies is {}, must be {low}..={high}", self.scene, self.bodies)
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
                let parameters = Parameters { bodies: total, seed: 7, order };
                let seen: BTreeSet<_> = (0..total).map(|place| parameters.nth(place, total)).collect();
                assert_eq!((seen.len(), seen.last()), (usize::from(total), Some(&(total - 1))), "{order:?} {total}");
            }
        }
    }

    #[test]
    fn another_seed_shuffles_otherwise() {
        let order = |seed| {
            let parameters = Parameters { bodies: 100, seed, order: Order::Shuffled };
            (0..100).map(move |place| parameters.nth(place, 100)).collect::<std::vec::Vec<_>>()
        };
        assert_ne!(order(1), order(2));
        assert_ne!(order(1), (0..100).collect::<std::vec::Vec<_>>());
    }

    #[test]
    fn jitter_fills_its_range() {
        let parameters = Parameters { bodies: 1, seed: 1, order: Order::Forward };
        let (mut low, mut high, mut sum) = (0, 0, 0i64);
        for index in 0..10_000 {
            let jitter = parameters.jitter(index);
            (low, high, sum) = (low.min(jitter), high.max(jitter), sum + i64::from(jitter));
        }
        assert!(low < -65_000 && high > 65_000 && low >= -65_536 && high < 65_536, "{low}..{high}");
        assert!((sum / 10_000).abs() < 2_000, "mean {}", sum / 10_000);
    }
}
