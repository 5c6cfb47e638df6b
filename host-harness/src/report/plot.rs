//! Line and scatter plots as SVG: axes with units, a legend, colours for light and dark, no script and no other file.
//!
//! Colours are CSS classes with a value for light and one for dark, so that the viewer chooses when it shows the plot.

use std::fmt::Write;

use super::scale::{Axis, Scale};

/// Width of a whole plot, legend included.
pub const WIDTH: f64 = 760.0;
/// Height of a whole plot.
pub const HEIGHT: f64 = 340.0;
/// Room for title, axis labels and the legend around the frame.
const MARGIN: Margin = Margin { left: 76.0, right: 190.0, top: 36.0, bottom: 52.0 };

struct Margin {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

/// Colours and strokes, light and dark, for a page's style sheet or inside a lone SVG.
pub const STYLE: &str = "\
.plot text{font:12px system-ui,sans-serif}.plot .title{font-weight:600;font-size:14px}\
.plot .limit{stroke-dasharray:6 4}.plot path.rule,.plot .limit,.plot .line,.plot .halo{fill:none}\
.plot .line{stroke-width:1.8;stroke-linejoin:round}.plot .halo{stroke-width:1.6}\
.l0{stroke:#1d5fd1}.f0{fill:#1d5fd1}.l1{stroke:#c04a00}.f1{fill:#c04a00}.l2{stroke:#167a3e}.f2{fill:#167a3e}\
.l3{stroke:#8a2bbd}.f3{fill:#8a2bbd}.l4{stroke:#b3123f}.f4{fill:#b3123f}.l5{stroke:#0b7285}.f5{fill:#0b7285}\
.l6{stroke:#7a6200}.f6{fill:#7a6200}.l7{stroke:#55606e}.f7{fill:#55606e}.plot text{fill:#1c1e21}\
.plot .soft{fill:#5d636b}.plot .rule{stroke:#d9dce1}.plot .limit,.plot .halo{stroke:#1c1e21}.paper{fill:#fff}\
@media(prefers-color-scheme:dark){.l0{stroke:#7fb0ff}.f0{fill:#7fb0ff}.l1{stroke:#ff9a5c}.f1{fill:#ff9a5c}\
.l2{stroke:#5fd38d}.f2{fill:#5fd38d}.l3{stroke:#d39bff}.f3{fill:#d39bff}.l4{stroke:#ff8aa5}.f4{fill:#ff8aa5}\
.l5{stroke:#5cd0e0}.f5{fill:#5cd0e0}.l6{stroke:#e2c45c}.f6{fill:#e2c45c}.l7{stroke:#aab4c0}.f7{fill:#aab4c0}\
.plot text{fill:#e8eaed}.plot .soft{fill:#a4abb5}.plot .rule{stroke:#3a3f47}\
.plot .limit,.plot .halo{stroke:#e8eaed}.paper{fill:#16181c}}";

/// Colours there are; further series repeat them with another mark.
const COLOURS: usize = 8;

/// Points that belong together.
#[derive(Clone, Debug)]
pub struct Series {
    /// In the legend.
    pub name: String,
    /// Joined by a line.
    pub joined: bool,
    /// Each with a mark.
    pub marked: bool,
    /// x, y and what a pointer over it shows.
    pub points: Vec<Mark>,
}

/// One point.
#[derive(Clone, Debug)]
pub struct Mark {
    /// On the horizontal axis.
    pub x: f64,
    /// On the vertical axis.
    pub y: f64,
    /// What a pointer over it shows.
    pub note: String,
    /// Set apart by a ring.
    pub ringed: bool,
}

/// A value that matters, across the whole plot.
#[derive(Clone, Debug)]
pub struct Limit {
    /// What it is.
    pub name: String,
    /// On the vertical axis.
    pub value: f64,
}

/// A plot.
#[derive(Clone, Debug)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// Horizontal.
    pub x: Axis,
    /// Vertical.
    pub y: Axis,
    /// What is drawn.
    pub series: Vec<Series>,
    /// Values that matter.
    pub limits: Vec<Limit>,
}

impl Series {
    /// A line without marks through values at 1, 2, 3 and so on, thinned to what a plot can show: of each bunch, the largest.
    pub fn over_steps(name: impl Into<String>, values: &[f64]) -> Self {
        const SHOWN: usize = 300;
        let bunch = values.len().div_ceil(SHOWN).max(1);
        let points = values.chunks(bunch).enumerate().filter_map(|(index, chunk)| {
            let (offset, y) = chunk.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
            Some(Mark { x: (index * bunch + offset + 1) as f64, y, note: String::new(), ringed: false })
        });
        Self { name: name.into(), joined: true, marked: false, points: points.collect() }
    }
}

impl Plot {
    /// A lone SVG file.
    pub fn file(plots: &[Self]) -> String {
        let height = HEIGHT * plots.len() as f64;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" \
             height=\"{height}\"><style>{STYLE}</style>\
             <rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n"
        );
        for (index, plot) in plots.iter().enumerate() {
            let _ = writeln!(svg, "<g transform=\"translate(0 {})\">{}</g>", HEIGHT * index as f64, plot.svg());
        }
        svg + "</svg>\n"
    }

    /// An SVG element for a page that has [`STYLE`].
    pub fn svg(&self) -> String {
        let points = || self.series.iter().flat_map(|series| &series.points);
        let limits = self.limits.iter().map(|limit| limit.value);
        let x = Scale::new(&self.x, points().map(|mark| mark.x), MARGIN.left, WIDTH - MARGIN.right);
        let y = Scale::new(&self.y, points().map(|mark| mark.y).chain(limits), HEIGHT - MARGIN.bottom, MARGIN.top);
        let mut svg = format!(
            "<svg class=\"plot\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" role=\"img\" \
             aria-label=\"{}\">\n<text class=\"title\" x=\"{:.0}\" y=\"20\">{}</text>\n",
            escape(&self.title),
            MARGIN.left,
            escape(&self.title),
        );
        self.draw_axes(&mut svg, &x, &y);
        for limit in &self.limits {
            let (left, right, at) = (MARGIN.left, WIDTH - MARGIN.right, y.place(limit.value));
            let _ = writeln!(
                svg,
                "<path class=\"limit\" d=\"M{left:.1} {at:.1}H{right:.1}\"/>\
                 <text class=\"soft\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                right - 4.0,
                at - 4.0,
                escape(&limit.name),
            );
        }
        for (index, series) in self.series.iter().enumerate() {
            series.draw(&mut svg, index, &x, &y);
            series.draw_key(&mut svg, index);
        }
        svg + "</svg>\n"
    }

    fn draw_axes(&self, svg: &mut String, x: &Scale, y: &Scale) {
        let (left, right, top, bottom) = (MARGIN.left, WIDTH - MARGIN.right, MARGIN.top, HEIGHT - MARGIN.bottom);
        for (at, label) in x.ticks() {
            let _ = writeln!(
                svg,
                "<path class=\"rule\" d=\"M{at:.1} {top:.1}V{bottom:.1}\"/>\
                 <text class=\"soft\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text>",
                bottom + 18.0,
            );
        }
        for (at, label) in y.ticks() {
            let _ = writeln!(
                svg,
                "<path class=\"rule\" d=\"M{left:.1} {at:.1}H{right:.1}\"/>\
                 <text class=\"soft\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
                left - 8.0,
                at + 4.0,
            );
        }
        let (middle, centre) = (f64::midpoint(left, right), f64::midpoint(top, bottom));
        let _ = writeln!(
            svg,
            "<text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\
             <text transform=\"translate(16 {centre:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            bottom + 40.0,
            escape(&self.x.label),
            escape(&self.y.label),
        );
    }
}

impl Series {
    fn draw(&self, svg: &mut String, index: usize, x: &Scale, y: &Scale) {
        let colour = index % COLOURS;
        if self.joined && self.points.len() > 1 {
            let mut path = String::new();
            for (place, mark) in self.points.iter().enumerate() {
                let letter = if place == 0 { 'M' } else { 'L' };
                let _ = write!(path, "{letter}{:.1} {:.1}", x.place(mark.x), y.place(mark.y));
            }
            let _ = writeln!(svg, "<path class=\"line l{colour}\" d=\"{path}\"/>");
        }
        for mark in self.points.iter().filter(|_| self.marked) {
            let (at_x, at_y) = (x.place(mark.x), y.place(mark.y));
            if mark.ringed {
                let _ = writeln!(svg, "<circle class=\"halo\" cx=\"{at_x:.1}\" cy=\"{at_y:.1}\" r=\"8.5\"/>");
            }
            draw_mark(svg, index, at_x, at_y, &mark.note);
        }
    }

    fn draw_key(&self, svg: &mut String, index: usize) {
        let (left, at) = (WIDTH - MARGIN.right + 16.0, MARGIN.top + 10.0 + 18.0 * index as f64);
        if self.joined {
            let _ = write!(svg, "<path class=\"line l{}\" d=\"M{left:.1} {at:.1}h18\"/>", index % COLOURS);
        }
        if self.marked {
            draw_mark(svg, index, left + 9.0, at, &self.name);
        }
        let _ = writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>", left + 26.0, at + 4.0, escape(&self.name));
    }
}

/// A mark: colour and shape go by the series, so that colour alone never tells them apart.
fn draw_mark(svg: &mut String, series: usize, x: f64, y: f64, note: &str) {
    let shape = match series % 4 {
        0 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\""),
        1 => format!("<path d=\"M{:.1} {:.1}h8v8h-8z\"", x - 4.0, y - 4.0),
        2 => format!("<path d=\"M{x:.1} {:.1}l5 9h-10z\"", y - 5.5),
        _ => format!("<path d=\"M{x:.1} {:.1}l5.5 5.5l-5.5 5.5l-5.5 -5.5z\"", y - 5.5),
    };
    let _ = writeln!(svg, "{shape} class=\"f{}\"><title>{}</title></{}>", series % COLOURS, escape(note), {
        if series.is_multiple_of(4) { "circle" } else { "path" }
    });
}

/// Text that cannot be taken for markup.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot() -> Plot {
        let mark = |x, y| Mark { x, y, note: "a < b".into(), ringed: x > 1.0 };
        let series = |name: &str| Series {
            name: name.into(),
            joined: true,
            marked: true,
            points: vec![mark(1.0, 0.0), mark(100.0, 3.0)],
        };
        Plot {
            title: "cost & error".into(),
            x: Axis::logarithmic("instructions a step"),
            y: Axis::linear("penetration, px"),
            series: (0..5).map(|index| series(&format!("s{index}"))).collect(),
            limits: vec![Limit { name: "bar".into(), value: 5.0 }],
        }
    }

    #[test]
    fn markup_balances_and_text_is_escaped() {
        let svg = Plot::file(&[plot(), plot()]);
        for element in ["svg", "g", "text", "circle", "title", "style"] {
            let (open, close) = (format!("<{element}"), format!("</{element}>"));
            let self_closed = svg.matches(&open).count() - svg.matches(&close).count();
            let expected = if element == "circle" { svg.matches("class=\"halo\"").count() } else { 0 };
            assert_eq!(self_closed, expected, "{element}");
        }
        assert!(svg.contains("a &lt; b") && svg.contains("cost &amp; error") && !svg.contains("a < b"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }

    #[test]
    fn a_thinned_series_keeps_its_peaks() {
        let mut values = vec![1.0; 3000];
        values[1234] = 9.0;
        let series = Series::over_steps("peak", &values);
        assert_eq!(series.points.len(), 300);
        assert!(series.points.iter().any(|mark| mark.y > 8.0 && mark.x > 1234.5 && mark.x < 1235.5));
    }
}
