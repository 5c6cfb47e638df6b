//! The largest body count that a budget holds.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// Where a rising cost meets a budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Largest count that fits; none if the smallest doesn't.
    pub fits: Option<u16>,
    /// Smallest count that doesn't, one more than the largest that does; none if the largest fits.
    pub fails: Option<u16>,
}

/// So many counts from one end of a range to the other, evenly on a logarithmic scale, both ends included.
pub fn spread(range: &RangeInclusive<u16>, count: u32) -> Vec<u16> {
    let (first, last) = (f64::from(*range.start()), f64::from(*range.end()));
    let mut points: Vec<u16> = (0..count)
        .map(|index| {
            let part = f64::from(index) / f64::from(count.max(2) - 1);
            (first * (last / first).powf(part)).round() as u16
        })
        .collect();
    points.dedup();
    points
}

/// Finds the edge among what was measured, measuring more until it lies between two neighbours.
///
/// Assumes that the cost rises with the count; where it doesn't, the edge is one of several, and both its sides are still
/// measurements. `cost` is asked for counts inside the range only.
///
/// # Errors
/// Those of `cost`.
pub fn edge<E>(
    measured: &mut BTreeMap<u16, f64>,
    budget: f64,
    mut cost: impl FnMut(u16) -> Result<f64, E>,
) -> Result<Edge, E> {
    let mut bisect = false;
    loop {
        let fails = measured.iter().find(|(_, cost)| **cost > budget).map(|(&count, &cost)| (count, cost));
        let fits = measured
            .iter()
            .rev()
            .find(|(count, cost)| **cost <= budget && fails.is_none_or(|(fails, _)| **count < fails));
        let fits = fits.map(|(&count, &cost)| (count, cost));
        let (Some((low, below)), Some((high, above))) = (fits, fails) else {
            return Ok(Edge { fits: fits.map(|fits| fits.0), fails: fails.map(|fails| fails.0) });
        };
        if high - low == 1 {
            return Ok(Edge { fits: Some(low), fails: Some(high) });
        }
        // A straight line hits the edge soon where the cost is smooth, halving makes sure where it isn't.
        let part = if bisect { 0.5 } else { (budget - below) / (above - below) };
        bisect = !bisect;
        let guess = f64::from(low) + part * f64::from(high - low);
        let next = (guess.round() as u16).clamp(low + 1, high - 1);
        measured.insert(next, cost(next)?);
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    fn search(points: &[u16], budget: f64, cost: impl Fn(u16) -> f64) -> (Edge, usize) {
        let mut measured: BTreeMap<_, _> = points.iter().map(|&count| (count, cost(count))).collect();
        let mut asked = 0;
        let edge = edge(&mut measured, budget, |count| {
            asked += 1;
            Ok::<_, Infallible>(cost(count))
        });
        let Ok(edge) = edge;
        (edge, asked)
    }

    #[test]
    fn the_edge_lies_between_neighbours() {
        let (edge, asked) = search(&[10, 1000], 50_000.0, |count| f64::from(count).powf(1.3) * 30.0);
        let largest = (1..=u16::MAX).take_while(|&count| f64::from(count).powf(1.3) * 30.0 <= 50_000.0).last();
        assert_eq!(edge, Edge { fits: largest, fails: largest.map(|count| count + 1) });
        assert!(asked <= 10, "{asked} measurements");
    }

    #[test]
    fn a_step_in_the_cost_is_found_by_halving() {
        let (edge, asked) = search(&[1, 2000], 10.0, |count| if count < 777 { 9.9 } else { 1e9 });
        assert_eq!(edge, Edge { fits: Some(776), fails: Some(777) });
        assert!(asked <= 24, "{asked} measurements");
    }

    #[test]
    fn ends_of_the_range_that_all_fit_or_all_fail_ask_for_nothing() {
        assert_eq!(search(&[1, 50], 100.0, f64::from), (Edge { fits: Some(50), fails: None }, 0));
        assert_eq!(search(&[1, 50], 0.5, f64::from), (Edge { fits: None, fails: Some(1) }, 0));
    }

    #[test]
    fn points_spread_from_end_to_end() {
        assert_eq!(spread(&(20..=1280), 7), [20, 40, 80, 160, 320, 640, 1280]);
        assert_eq!(spread(&(5..=5), 7), [5]);
    }
}
