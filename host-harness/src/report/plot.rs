//! Line and scatter plots as SVG: axes with units, a legend, colours for light and dark, no script and no other file.
//!
//! Colours are CSS classes with a value for light and one for dark, so that the viewer chooses when it shows the plot.

use std::fmt::Write;

use super::scale::{Axis, Scale};

/// The room that a plot takes, and what it leaves around its axes.
#[derive(Clone, Copy, Debug)]
struct Frame {
    width: f64,
    height: f64,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Frame {
    /// One plot across a page, its legend to the right.
    const PAGE: Self = Self { width: 760.0, height: 340.0, left: 76.0, right: 190.0, top: 36.0, bottom: 52.0 };
    /// One of several side by side, which share a legend.
    const TILE: Self = Self { width: 410.0, height: 250.0, left: 64.0, right: 12.0, top: 36.0, bottom: 52.0 };

    /// Where the axes end: left, right, top, bottom.
    fn axes(&self) -> [f64; 4] {
        [self.left, self.width - self.right, self.top, self.height - self.bottom]
    }
}

/// Height of a line of the legend.
const KEY: f64 = 18.0;

/// Colours and strokes, light and dark, for a page's style sheet or inside a lone SVG.
pub const STYLE: &str = "\
.plot text{font:12px system-ui,sans-serif}.plot .title{font-weight:600;font-size:14px}\
.plot .limit{stroke-dasharray:6 4}.plot path.rule,.plot .limit,.plot .line,.plot .halo{fill:none}\
.plot .line{stroke-width:1.8;stroke-linejoin:round}.plot .halo{stroke-width:1.6}\
.plot .dashed{stroke-dasharray:12 8}.plot .dotted{stroke-dasharray:4 10}\
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
    /// Its line is broken, each series' otherwise, so that those below still show where several coincide.
    pub broken: bool,
    /// Colour and shape of the marks; none = those of its place among the others.
    pub look: Option<Look>,
    /// x, y and what a pointer over it shows.
    pub points: Vec<Mark>,
}

/// What tells a series from others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// Of eight.
    pub colour: usize,
    /// Of four: disc, square, triangle, diamond.
    pub shape: usize,
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
        Self { name: name.into(), joined: true, marked: false, broken: false, look: None, points: points.collect() }
    }
}

impl Plot {
    /// A lone SVG file: plots of the same series side by side, so many in a row, under one legend and above a caption.
    pub fn sheet(plots: &[Self], columns: usize, caption: &str) -> String {
        let Frame { width, height, left, .. } = Frame::TILE;
        let keys = plots.first().map_or(&[][..], |plot| &plot.series);
        let across = 3;
        let head = KEY * (1 + keys.len().div_ceil(across)) as f64;
        let size = (width * columns as f64, head + height * plots.len().div_ceil(columns) as f64 + KEY);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\
             <style>{STYLE}</style><rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n<g class=\"plot\">",
            size.0, size.1,
        );
        for (index, series) in keys.iter().enumerate() {
            let x = left + (size.0 - left) / across as f64 * (index % across) as f64;
            series.draw_key(&mut svg, index, x, KEY * (1 + index / across) as f64);
        }
        let _ = writeln!(
            svg,
            "<text class=\"soft\" x=\"{left}\" y=\"{:.1}\">{}</text></g>",
            size.1 - 0.4 * KEY,
            escape(caption)
        );
        for (index, plot) in plots.iter().enumerate() {
            let (x, y) = (width * (index % columns) as f64, head + height * (index / columns) as f64);
            let _ = writeln!(svg, "<g transform=\"translate({x} {y})\">{}</g>", plot.draw(&Frame::TILE));
        }
        svg + "</svg>\n"
    }

    /// An SVG element for a page that has [`STYLE`].
    pub fn svg(&self) -> String {
        self.draw(&Frame::PAGE)
    }

    fn draw(&self, frame: &Frame) -> String {
        let [left, right, top, bottom] = frame.axes();
        let points = || self.series.iter().flat_map(|series| &series.points);
        let limits = self.limits.iter().map(|limit| limit.value);
        let x = Scale::new(&self.x, points().map(|mark| mark.x), left, right);
        let y = Scale::new(&self.y, points().map(|mark| mark.y).chain(limits), bottom, top);
        let Frame { width, height, .. } = frame;
        let title = escape(&self.title);
        let mut svg = format!(
            "<svg class=\"plot\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\" \
             aria-label=\"{title}\">\n<text class=\"title\" x=\"{left:.0}\" y=\"20\">{title}</text>\n",
        );
        self.draw_axes(&mut svg, frame, &x, &y);
        for limit in &self.limits {
            let at = y.place(limit.value);
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
            if frame.right > KEY {
                series.draw_key(&mut svg, index, right + 16.0, top + 10.0 + KEY * index as f64);
            }
        }
        svg + "</svg>\n"
    }

    fn draw_axes(&self, svg: &mut String, frame: &Frame, x: &Scale, y: &Scale) {
        let [left, right, top, bottom] = frame.axes();
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

impl Look {
    /// Of the series in that place: the first eight differ in colour, neighbours also in shape.
    pub fn nth(index: usize) -> Self {
        Self { colour: index % COLOURS, shape: index % 4 }
    }
}

impl Series {
    fn draw(&self, svg: &mut String, index: usize, x: &Scale, y: &Scale) {
        let look = self.look.unwrap_or(Look::nth(index));
        if self.joined && self.points.len() > 1 {
            let mut path = String::new();
            for (place, mark) in self.points.iter().enumerate() {
                let letter = if place == 0 { 'M' } else { 'L' };
                let _ = write!(path, "{letter}{:.1} {:.1}", x.place(mark.x), y.place(mark.y));
            }
            let _ = writeln!(svg, "<path class=\"line l{}{}\" d=\"{path}\"/>", look.colour, self.stroke(index));
        }
        for mark in self.points.iter().filter(|_| self.marked) {
            let (at_x, at_y) = (x.place(mark.x), y.place(mark.y));
            if mark.ringed {
                let _ = writeln!(svg, "<circle class=\"halo\" cx=\"{at_x:.1}\" cy=\"{at_y:.1}\" r=\"8.5\"/>");
            }
            draw_mark(svg, look, at_x, at_y, &mark.note);
        }
    }

    /// The first is whole.
    fn stroke(&self, index: usize) -> &'static str {
        if self.broken { ["", " dashed", " dotted"][index % 3] } else { "" }
    }

    fn draw_key(&self, svg: &mut String, index: usize, left: f64, at: f64) {
        let look = self.look.unwrap_or(Look::nth(index));
        if self.joined {
            let stroke = self.stroke(index);
            let _ = write!(svg, "<path class=\"line l{}{stroke}\" d=\"M{left:.1} {at:.1}h18\"/>", look.colour);
        }
        if self.marked {
            draw_mark(svg, look, left + 9.0, at, &self.name);
        }
        let _ = writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>", left + 26.0, at + 4.0, escape(&self.name));
    }
}

/// A mark: colour and shape go by the series, so that colour alone never tells them apart.
fn draw_mark(svg: &mut String, look: Look, x: f64, y: f64, note: &str) {
    let (element, shape) = match look.shape {
        0 => ("circle", format!("cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\"")),
        1 => ("path", format!("d=\"M{:.1} {:.1}h8v8h-8z\"", x - 4.0, y - 4.0)),
        2 => ("path", format!("d=\"M{x:.1} {:.1}l5 9h-10z\"", y - 5.5)),
        _ => ("path", format!("d=\"M{x:.1} {:.1}l5.5 5.5l-5.5 5.5l-5.5 -5.5z\"", y - 5.5)),
    };
    let (colour, note) = (look.colour, escape(note));
    let _ = writeln!(svg, "<{element} {shape} class=\"f{colour}\"><title>{note}</title></{element}>");
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
            broken: false,
            look: None,
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
        let svg = Plot::sheet(&[plot(), plot(), plot()], 2, "measured <here>");
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
