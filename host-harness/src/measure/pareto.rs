//! What is worth its cost: settings that no other beats in both cost and error.

/// For each (cost, error), whether none is as good in both and better in one; of equals only the first is.
pub fn front(points: &[(f64, f64)]) -> Vec<bool> {
    let as_good = |a: &(f64, f64), b: &(f64, f64)| a.0 <= b.0 && a.1 <= b.1;
    let beaten = |index: usize, point: &(f64, f64)| {
        let by = |(other, rival): (usize, &(f64, f64))| as_good(rival, point) && (rival != point || other < index);
        points.iter().enumerate().any(by)
    };
    points.iter().enumerate().map(|(index, point)| !beaten(index, point)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_nobody_beats_is_on_the_front() {
        let points = [(1.0, 9.0), (2.0, 3.0), (2.0, 4.0), (3.0, 3.0), (4.0, 0.0), (5.0, 0.0)];
        assert_eq!(front(&points), [true, true, false, false, true, false]);
    }

    #[test]
    fn of_equals_the_first_is_and_an_infinite_error_can_still_be_the_cheapest() {
        assert_eq!(front(&[(1.0, 1.0), (1.0, 1.0)]), [true, false]);
        assert_eq!(front(&[(1.0, f64::INFINITY), (2.0, 0.5)]), [true, true]);
    }
}
