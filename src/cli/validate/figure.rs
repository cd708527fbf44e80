//! One clean style of figure: axes, curves, points with their errors, shaded ranges, bars. Drawn at four times its size,
//! because plotters places on whole units, and shown at its size by the view box.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Units per pixel.
const FINE: f64 = 4.0;
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 400.0;
/// Left, top, right and bottom margins, pixels.
const MARGIN: [f64; 4] = [74.0, 34.0, 18.0, 50.0];
const INK: RGBColor = RGBColor(34, 40, 49);
const GRID: RGBColor = RGBColor(225, 229, 234);
const FAINT: RGBColor = RGBColor(240, 242, 245);
/// Colours that the colour-blind tell apart (Okabe and Ito 2008).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(90, 90, 90),
];

/// One axis: label with unit, range, logarithmic or not.
#[derive(Clone, Debug)]
pub struct Axis {
    label: String,
    low: f64,
    high: f64,
    log: bool,
}

/// What a series looks like.
#[derive(Clone, Debug)]
pub enum Mark {
    /// A curve.
    Line(Vec<[f64; 2]>),
    /// A dashed curve.
    Dashes(Vec<[f64; 2]>),
    /// x, y and the standard error of y.
    Points(Vec<[f64; 3]>),
    /// x, low and high y.
    Band(Vec<[f64; 3]>),
    /// Low and high x, y.
    Bars(Vec<[f64; 3]>),
}

/// A series with its place among the colours; without a label it is not in the legend.
#[derive(Clone, Debug)]
pub struct Series {
    label: String,
    colour: usize,
    mark: Mark,
}

/// Where the legend stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Legend {
    /// Top left.
    Left,
    /// Top right.
    Right,
    /// Bottom left.
    LowerLeft,
    /// Bottom right.
    LowerRight,
}

/// A figure.
#[derive(Clone, Debug)]
pub struct Figure {
    title: String,
    axes: [Axis; 2],
    legend: Legend,
    series: Vec<Series>,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: &str, low: f64, high: f64) -> Self {
        Self { label: label.to_owned(), low, high, log: false }
    }

    /// A logarithmic axis.
    pub fn log(label: &str, low: f64, high: f64) -> Self {
        Self { log: true, ..Self::linear(label, low, high) }
    }

    /// Place along the axis, 0 to 1 within its range.
    fn place(&self, value: f64) -> f64 {
        if self.log {
            (value.max(1e-30) / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// Grid lines and whether they carry a number.
    fn ticks(&self) -> Vec<(f64, bool)> {
        let inside = |v: f64| (-1e-9..=1.0 + 1e-9).contains(&self.place(v));
        if self.log {
            let decades = (self.high / self.low).log10();
            let every = (decades / 8.0).ceil().max(1.0) as i32;
            let digits: &[i32] = if decades < 2.2 { &[1, 2, 5] } else { &[1] };
            let range = self.low.log10().floor() as i32..=self.high.log10().ceil() as i32;
            return range
                .flat_map(|e| (1..10).map(move |d| (e, d)))
                .map(|(e, d)| (f64::from(d) * 10f64.powi(e), digits.contains(&d) && e % every == 0))
                .filter(|&(v, numbered)| inside(v) && (numbered || decades < 4.0))
                .collect();
        }
        let rough = (self.high - self.low) / 6.0;
        let unit = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * unit).into_iter().find(|s| *s >= rough).unwrap_or(rough);
        let first = (self.low / step).ceil() as i64;
        (first..first + 20).map(|i| (i as f64 * step, true)).filter(|&(v, _)| inside(v)).collect()
    }

    fn number(&self, value: f64) -> String {
        if self.log && !(1e-3..1e5).contains(&value) {
            let exponent = value.log10().floor() as i32;
            let raised: String = exponent.to_string().chars().map(superscript).collect();
            let digit = (value / 10f64.powi(exponent)).round();
            return if digit == 1.0 { format!("10{raised}") } else { format!("{digit}·10{raised}") };
        }
        let rounded = format!("{:.6}", value + 0.0);
        rounded.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

fn superscript(c: char) -> char {
    match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit.to_digit(10).unwrap_or_default()).unwrap_or(digit),
    }
}

impl Series {
    /// A series in a colour of the palette.
    pub fn new(label: &str, colour: usize, mark: Mark) -> Self {
        Self { label: label.to_owned(), colour, mark }
    }

    /// The largest y.
    pub fn highest(&self) -> f64 {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        match &self.mark {
            Mark::Line(p) | Mark::Dashes(p) => largest(&mut p.iter().map(|p| p[1])),
            Mark::Points(p) => largest(&mut p.iter().map(|p| p[1] + p[2])),
            Mark::Band(p) | Mark::Bars(p) => largest(&mut p.iter().map(|p| p[2])),
        }
    }

    fn colour(&self) -> RGBColor {
        COLOURS[self.colour % COLOURS.len()]
    }
}

/// `count` + 1 points of a function, evenly along an axis.
pub fn curve(axis: &Axis, count: u32, f: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let at = |i: u32| {
        let t = f64::from(i) / f64::from(count);
        if axis.log { axis.low * (axis.high / axis.low).powf(t) } else { axis.low + t * (axis.high - axis.low) }
    };
    (0..=count).map(at).map(|x| [x, f(x)]).collect()
}

impl Figure {
    /// An empty figure.
    pub fn new(title: &str, x: Axis, y: Axis, legend: Legend) -> Self {
        Self { title: title.to_owned(), axes: [x, y], legend, series: vec![] }
    }

    /// Adds a series above the ones before.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Its title.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The figure as SVG.
    ///
    /// # Errors
    /// If plotters cannot draw.
    pub fn svg(&self) -> Result<String, String> {
        let mut text = String::new();
        {
            let area =
                SVGBackend::with_string(&mut text, (units(WIDTH) as u32, units(HEIGHT) as u32)).into_drawing_area();
            area.fill(&WHITE)
                .and_then(|()| self.draw(&area))
                .map_err(|e| format!("cannot draw {}: {e}", self.title))?;
            area.present().map_err(|e| format!("cannot draw {}: {e}", self.title))?;
        }
        let big = format!("width=\"{}\" height=\"{}\"", units(WIDTH), units(HEIGHT));
        Ok(text.replacen(&big, &format!("width=\"{WIDTH}\" height=\"{HEIGHT}\""), 1))
    }

    fn draw(&self, area: &Area<'_>) -> Drawn {
        let [left, top, right, bottom] = MARGIN;
        self.draw_axes(area)?;
        for series in &self.series {
            self.draw_series(area, series)?;
        }
        let frame = [(left, top), (WIDTH - right, HEIGHT - bottom)].map(whole);
        area.draw(&Rectangle::new(frame, ShapeStyle::from(INK).stroke_width(FINE as u32)))?;
        words(area, &self.title, (left, 12.0), 15.0, (HPos::Left, VPos::Center), FontTransform::None)?;
        self.draw_legend(area)
    }

    fn draw_axes(&self, area: &Area<'_>) -> Drawn {
        let [left, top, right, bottom] = MARGIN;
        let [x, y] = &self.axes;
        let thin = |numbered: bool| ShapeStyle::from(if numbered { GRID } else { FAINT }).stroke_width(3);
        let [floor, ceiling] = [HEIGHT - bottom, top];
        for (v, numbered) in x.ticks() {
            let at = self.pixel([v, y.low]).0;
            area.draw(&PathElement::new([(at, floor), (at, ceiling)].map(whole), thin(numbered)))?;
            if numbered {
                words(area, &x.number(v), (at, floor + 6.0), 12.0, (HPos::Center, VPos::Top), FontTransform::None)?;
            }
        }
        for (v, numbered) in y.ticks() {
            let at = self.pixel([x.low, v]).1;
            area.draw(&PathElement::new([(left, at), (WIDTH - right, at)].map(whole), thin(numbered)))?;
            if numbered {
                words(area, &y.number(v), (left - 6.0, at), 12.0, (HPos::Right, VPos::Center), FontTransform::None)?;
            }
        }
        let middle = (0.5 * (left + WIDTH - right), 0.5 * (ceiling + floor));
        let centred = (HPos::Center, VPos::Center);
        words(area, &x.label, (middle.0, HEIGHT - 14.0), 13.0, centred, FontTransform::None)?;
        words(area, &y.label, (16.0, middle.1), 13.0, centred, FontTransform::Rotate270)
    }

    fn draw_series(&self, area: &Area<'_>, series: &Series) -> Drawn {
        let colour = series.colour();
        let pen = ShapeStyle::from(colour).stroke_width((1.8 * FINE) as u32);
        let path = |points: &[[f64; 2]]| points.iter().map(|&p| self.pixel(p)).collect::<Vec<_>>();
        match &series.mark {
            Mark::Line(points) => {
                for piece in self.visible(points) {
                    area.draw(&PathElement::new(path(piece).into_iter().map(whole).collect::<Vec<_>>(), pen))?;
                }
            }
            Mark::Dashes(points) => {
                for piece in self.visible(points) {
                    for dash in dashes(&path(piece)) {
                        area.draw(&PathElement::new(dash, pen))?;
                    }
                }
            }
            Mark::Points(points) => {
                let stem = ShapeStyle::from(colour).stroke_width(FINE as u32);
                for &[x, y, error] in points.iter().filter(|p| self.holds([p[0], p[1]])) {
                    let ends = [y - error, y + error].map(|y| whole(self.pixel([x, self.axes[1].clamp(y)])));
                    area.draw(&PathElement::new(ends, stem))?;
                    area.draw(&Circle::new(whole(self.pixel([x, y])), (2.6 * FINE) as i32, WHITE.filled()))?;
                    area.draw(&Circle::new(whole(self.pixel([x, y])), (2.6 * FINE) as i32, stem.stroke_width(6)))?;
                }
            }
            Mark::Band(points) => {
                let edge = |p: &[f64; 3], i: usize| whole(self.pixel([p[0], self.axes[1].clamp(p[i])]));
                let there = points.iter().map(|p| edge(p, 1));
                let outline: Vec<_> = there.chain(points.iter().rev().map(|p| edge(p, 2))).collect();
                area.draw(&Polygon::new(outline, colour.mix(0.18).filled()))?;
            }
            Mark::Bars(bars) => {
                for &[low, high, y] in bars {
                    let corners = [[low, self.axes[1].low], [high, y]].map(|p| whole(self.pixel(p)));
                    area.draw(&Rectangle::new(corners, colour.mix(0.35).filled()))?;
                }
            }
        }
        Ok(())
    }

    fn draw_legend(&self, area: &Area<'_>) -> Drawn {
        let named: Vec<&Series> = self.series.iter().filter(|s| !s.label.is_empty()).collect();
        let longest = named.iter().map(|s| s.label.chars().count()).max().unwrap_or(0) as f64;
        let (wide, high) = (46.0 + 6.4 * longest, 8.0 + 17.0 * named.len() as f64);
        let [left, top, right, bottom] = MARGIN;
        let x = match self.legend {
            Legend::Left | Legend::LowerLeft => left + 8.0,
            Legend::Right | Legend::LowerRight => WIDTH - right - 8.0 - wide,
        };
        let y = match self.legend {
            Legend::Left | Legend::Right => top + 8.0,
            Legend::LowerLeft | Legend::LowerRight => HEIGHT - bottom - 8.0 - high,
        };
        area.draw(&Rectangle::new([(x, y), (x + wide, y + high)].map(whole), WHITE.mix(0.85).filled()))?;
        for (i, series) in named.iter().enumerate() {
            let at = y + 12.0 + 17.0 * i as f64;
            let pen = ShapeStyle::from(series.colour()).stroke_width((1.8 * FINE) as u32);
            let ends = [(x + 6.0, at), (x + 30.0, at)];
            let patch = [(x + 6.0, at - 5.0), (x + 30.0, at + 5.0)].map(whole);
            match &series.mark {
                Mark::Line(_) => area.draw(&PathElement::new(ends.map(whole), pen))?,
                Mark::Dashes(_) => {
                    for dash in dashes(&ends) {
                        area.draw(&PathElement::new(dash, pen))?;
                    }
                }
                Mark::Points(_) => {
                    area.draw(&Circle::new(whole((x + 18.0, at)), (2.6 * FINE) as i32, pen.stroke_width(6)))?;
                }
                Mark::Band(_) => area.draw(&Rectangle::new(patch, series.colour().mix(0.18).filled()))?,
                Mark::Bars(_) => area.draw(&Rectangle::new(patch, series.colour().mix(0.35).filled()))?,
            }
            words(area, &series.label, (x + 38.0, at), 12.0, (HPos::Left, VPos::Center), FontTransform::None)?;
        }
        Ok(())
    }

    fn pixel(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        let [left, top, right, bottom] = MARGIN;
        let across = left + self.axes[0].place(x) * (WIDTH - left - right);
        let up = HEIGHT - bottom - self.axes[1].place(y).clamp(-9.0, 9.0) * (HEIGHT - top - bottom);
        (across, up)
    }

    fn holds(&self, point: [f64; 2]) -> bool {
        self.axes.iter().zip(point).all(|(axis, v)| v.is_finite() && (-1e-9..=1.0 + 1e-9).contains(&axis.place(v)))
    }

    /// The stretches of a curve inside the frame.
    fn visible<'a>(&self, points: &'a [[f64; 2]]) -> Vec<&'a [[f64; 2]]> {
        points.split(|&p| !self.holds(p)).filter(|piece| piece.len() > 1).collect()
    }
}

impl Axis {
    fn clamp(&self, value: f64) -> f64 {
        value.max(self.low).min(self.high)
    }
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

fn units(pixels: f64) -> i32 {
    (pixels * FINE).round() as i32
}

fn whole((x, y): (f64, f64)) -> (i32, i32) {
    (units(x), units(y))
}

/// Dashes of 6 pixels and gaps of 4 along a path.
fn dashes(path: &[(f64, f64)]) -> Vec<Vec<(i32, i32)>> {
    const DASH: f64 = 6.0;
    const PERIOD: f64 = 10.0;
    let mut out: Vec<Vec<(i32, i32)>> = Vec::new();
    let mut gone = 0.0;
    for pair in path.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        let along = |s: f64| whole((a.0 + (b.0 - a.0) * s / length, a.1 + (b.1 - a.1) * s / length));
        let mut s = 0.0;
        while s < length {
            let phase = (gone + s) % PERIOD;
            let end = if phase < DASH { s + DASH - phase } else { s + PERIOD - phase }.min(length).max(s + 1e-6);
            if phase < DASH {
                if s == 0.0 && phase > 0.0 && !out.is_empty() {
                    out.last_mut().into_iter().for_each(|dash| dash.push(along(end)));
                } else {
                    out.push(vec![along(s), along(end)]);
                }
            }
            s = end;
        }
        gone += length;
    }
    out
}

fn words(
    area: &Area<'_>,
    text: &str,
    at: (f64, f64),
    size: f64,
    (across, up): (HPos, VPos),
    turn: FontTransform,
) -> Drawn {
    let font = ("Helvetica, Arial, sans-serif", size * FINE).into_font().transform(turn);
    area.draw(&Text::new(text.to_owned(), whole(at), font.color(&INK).pos(Pos::new(across, up))))
}
