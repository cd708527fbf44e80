//! Figures of the validation page in one style: axes, curves, points with error bars, shaded ranges, histogram bars.

mod draw;
pub mod map;

/// An axis of a figure: its label with the unit, its range, and whether it is logarithmic.
#[derive(Clone, Debug)]
pub struct Axis {
    label: String,
    low: f64,
    high: f64,
    log: bool,
}

/// The data of one series in a figure, and how to draw them.
#[derive(Clone, Debug)]
pub enum SeriesData {
    /// A solid curve through points (x, y).
    Line(Vec<[f64; 2]>),
    /// A dashed curve through points (x, y).
    Dashes(Vec<[f64; 2]>),
    /// Circles with vertical error bars: x, y and the standard error of y. The bar extends by it to both sides.
    Points(Vec<[f64; 3]>),
    /// A shaded area between two curves: x, and the lower and upper y there.
    Band(Vec<[f64; 3]>),
    /// Bars of a histogram: lower and upper x of a bar, and its height y.
    Bars(Vec<[f64; 3]>),
}

/// One set of data in a figure, with its label and the index of its colour. Without a label it is not in the legend.
#[derive(Clone, Debug)]
pub struct FigureSeries {
    label: String,
    colour: usize,
    data: SeriesData,
}

/// Corner of the figure in which the legend stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LegendCorner {
    /// Top left corner of the plot area.
    UpperLeft,
    /// Top right corner of the plot area.
    UpperRight,
    /// Bottom right corner of the plot area.
    LowerRight,
}

/// A figure with a title, axes x and y, a legend and series.
#[derive(Clone, Debug)]
pub struct Figure {
    title: String,
    axes: [Axis; 2],
    legend: LegendCorner,
    series: Vec<FigureSeries>,
}

impl Axis {
    /// Creates a linear axis from `low` to `high`. `label` is the text beside it, with the unit.
    pub fn linear(label: &str, low: f64, high: f64) -> Self {
        Self { label: label.to_owned(), low, high, log: false }
    }

    /// Creates a logarithmic axis from `low` to `high`, both positive. `label` is the text beside it, with the unit.
    pub fn log(label: &str, low: f64, high: f64) -> Self {
        Self { log: true, ..Self::linear(label, low, high) }
    }

    /// Position of a value along the axis: 0 at the axis's lower end, 1 at its upper end.
    pub fn fraction_along(&self, value: f64) -> f64 {
        if self.log {
            (value.max(1e-30) / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// The value, or the end of the axis's range that is nearer to it if it lies outside.
    pub fn clamp(&self, value: f64) -> f64 {
        value.max(self.low).min(self.high)
    }

    /// Values at which the axis has grid lines, and whether each grid line carries a number.
    pub fn grid_lines(&self) -> Vec<(f64, bool)> {
        let inside = |v: f64| (-1e-9..=1.0 + 1e-9).contains(&self.fraction_along(v));
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

    /// Formats the number at a grid line of the axis, such as `0.5`. On a logarithmic axis, numbers below 0.001 and
    /// those of at least 100 000 become powers of ten.
    pub fn format_tick(&self, value: f64) -> String {
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

impl FigureSeries {
    /// Creates a series. `colour` is an index of the seven colours of all figures.
    pub fn new(label: &str, colour: usize, data: SeriesData) -> Self {
        Self { label: label.to_owned(), colour, data }
    }

    /// The largest y of the series, including the upper ends of error bars and shaded areas; at least 0.
    pub fn max_y(&self) -> f64 {
        match &self.data {
            SeriesData::Line(p) | SeriesData::Dashes(p) => p.iter().map(|p| p[1]).fold(0.0, f64::max),
            SeriesData::Points(p) => p.iter().map(|p| p[1] + p[2]).fold(0.0, f64::max),
            SeriesData::Band(p) | SeriesData::Bars(p) => p.iter().map(|p| p[2]).fold(0.0, f64::max),
        }
    }
}

/// Points (x, f(x)) at `count` + 1 values of x from one end of an axis to the other, evenly spaced (in the logarithm on
/// a logarithmic axis).
pub fn sample_curve(axis: &Axis, count: u32, f: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let at = |i: u32| {
        let t = f64::from(i) / f64::from(count);
        if axis.log { axis.low * (axis.high / axis.low).powf(t) } else { axis.low + t * (axis.high - axis.low) }
    };
    (0..=count).map(at).map(|x| [x, f(x)]).collect()
}

impl Figure {
    /// Creates a figure without series.
    pub fn new(title: &str, x: Axis, y: Axis, legend: LegendCorner) -> Self {
        Self { title: title.to_owned(), axes: [x, y], legend, series: vec![] }
    }

    /// Adds a series. It is drawn over the earlier series.
    #[must_use]
    pub fn with_series(mut self, series: FigureSeries) -> Self {
        self.series.push(series);
        self
    }

    /// The title of the figure.
    pub fn title(&self) -> &str {
        &self.title
    }
}
