//! From values to places along an axis, and round values for its ticks.

/// What an axis shows.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// Equal distances are equal ratios.
    pub logarithmic: bool,
}

impl Axis {
    /// Equal distances are equal differences; zero is on the axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), logarithmic: false }
    }

    /// Equal distances are equal ratios; what isn't above zero is drawn at the low end.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self { label: label.into(), logarithmic: true }
    }
}

/// An axis with its range.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    logarithmic: bool,
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    /// An axis that holds all the values, from one place of the drawing to another.
    pub fn new(axis: &Axis, values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let shown = values.filter(|value| value.is_finite() && (!axis.logarithmic || *value > 0.0));
        let (mut low, mut high) =
            shown.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low > high {
            (low, high) = (1.0, 1.0);
        }
        if axis.logarithmic {
            // Room on both sides, and never a single point.
            (low, high) = (low / 1.25, high * 1.25);
        } else {
            (low, high) = (low.min(0.0), high.max(0.0));
            let room = 0.05 * if high > low { high - low } else { 1.0 };
            low -= if low < 0.0 { room } else { 0.0 };
            high += room;
        }
        Self { logarithmic: axis.logarithmic, low, high, from, to }
    }

    /// Where a value lies; values off the axis are drawn at its end.
    pub fn place(&self, value: f64) -> f64 {
        let part = if !self.logarithmic {
            (value - self.low) / (self.high - self.low)
        } else if value > 0.0 {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            0.0
        };
        let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
        self.from + part * (self.to - self.from)
    }

    /// Places and labels of round values.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let values = if self.logarithmic { self.decades() } else { self.even() };
        values.into_iter().map(|value| (self.place(value), label(value))).collect()
    }

    fn even(&self) -> Vec<f64> {
        let rough = (self.high - self.low) / 5.0;
        let decade = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * decade).into_iter().find(|step| *step >= rough);
        let step = step.unwrap_or(10.0 * decade);
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last).map(|count| count as f64 * step).collect()
    }

    fn decades(&self) -> Vec<f64> {
        let decades = (self.high / self.low).log10();
        // At least two ticks, at most about eight.
        let factors: &[f64] = match decades {
            ..0.4 => &[1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
            0.4..1.0 => &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0],
            1.0..2.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let every = ((decades / 8.0).ceil() as i32).max(1);
        let (first, last) = (self.low.log10().floor() as i32, self.high.log10().ceil() as i32);
        (first..=last)
            .filter(|exponent| exponent.rem_euclid(every) == 0)
            .flat_map(|exponent| factors.iter().map(move |factor| factor * 10f64.powi(exponent)))
            .filter(|value| (self.low..=self.high).contains(value))
            .collect()
    }
}

/// A number as an axis shows it: `1.5k`, `20M`, `0.02`.
pub fn label(value: f64) -> String {
    let size = value.abs();
    let (scaled, suffix) = match size {
        1e9.. => (value / 1e9, "G"),
        1e6..1e9 => (value / 1e6, "M"),
        1e3..1e6 => (value / 1e3, "k"),
        _ => (value, ""),
    };
    if size > 0.0 && size < 1e-4 {
        return format!("{value:.0e}");
    }
    let text = format!("{scaled:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    format!("{}{suffix}", if text == "-0" { "0" } else { text })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(axis: &Axis, values: &[f64]) -> Scale {
        Scale::new(axis, values.iter().copied(), 0.0, 100.0)
    }

    fn labels(axis: &Axis, values: &[f64]) -> Vec<String> {
        scale(axis, values).ticks().into_iter().map(|tick| tick.1).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(labels(&Axis::linear(""), &[3.0, 47.0]), ["0", "10", "20", "30", "40"]);
        assert_eq!(labels(&Axis::linear(""), &[-0.5, 0.5]), ["-0.5", "0", "0.5"]);
        assert_eq!(labels(&Axis::logarithmic(""), &[900.0, 2e6]), ["1k", "10k", "100k", "1M"]);
        assert_eq!(labels(&Axis::logarithmic(""), &[50e3, 90e3]), ["50k", "70k", "100k"]);
        assert_eq!(labels(&Axis::logarithmic(""), &[10e3, 11e3]), ["8k", "9k", "10k", "12k"]);
    }

    #[test]
    fn places_run_from_end_to_end_and_stay_there() {
        let scale = scale(&Axis::logarithmic(""), &[10.0, 1000.0]);
        assert!((scale.place(100.0) - 50.0).abs() < 1e-9);
        assert!(scale.place(0.0) < 1e-9 && (scale.place(1e9) - 100.0).abs() < 1e-9);
        assert!(scale.place(f64::NAN) < 1e-9);
    }

    #[test]
    fn one_value_or_none_still_makes_an_axis() {
        for values in [&[][..], &[0.0], &[7.0]] {
            for axis in [Axis::linear(""), Axis::logarithmic("")] {
                let scale = scale(&axis, values);
                assert!(scale.low < scale.high && !scale.ticks().is_empty(), "{values:?}");
            }
        }
    }
}
