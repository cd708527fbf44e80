//! Draws a figure as SVG. The crate plotters rounds positions to whole units, so the figure is drawn at four times its
//! size and scaled down by the view box.

use super::{Figure, FigureSeries, LegendCorner, SeriesData};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// SVG user units per pixel of the figure: integer coordinates then resolve a quarter of a pixel.
const SVG_UNITS_PER_PIXEL: f64 = 4.0;
const FIGURE_WIDTH: f64 = 640.0;
const FIGURE_HEIGHT: f64 = 400.0;
/// Left, top, right and bottom margins around the plot area of a figure, pixels.
const PLOT_MARGINS_PX: [f64; 4] = [74.0, 34.0, 18.0, 50.0];
const TEXT_COLOUR: RGBColor = RGBColor(34, 40, 49);
const GRID_COLOUR: RGBColor = RGBColor(225, 229, 234);
const MINOR_GRID_COLOUR: RGBColor = RGBColor(240, 242, 245);
/// Colours of the curves, points and bars in figures, distinct for colour-blind readers (Okabe and Ito 2008).
const SERIES_COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(90, 90, 90),
];

impl FigureSeries {
    fn colour(&self) -> RGBColor {
        SERIES_COLOURS[self.colour % SERIES_COLOURS.len()]
    }
}

impl Figure {
    /// Draws the figure, and returns the text of an SVG file.
    ///
    /// # Errors
    /// If the crate plotters cannot draw the figure.
    pub fn svg(&self) -> Result<String, String> {
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(
                &mut text,
                (to_svg_units(FIGURE_WIDTH) as u32, to_svg_units(FIGURE_HEIGHT) as u32),
            )
            .into_drawing_area();
            area.fill(&WHITE)
                .and_then(|()| self.draw(&area))
                .map_err(|e| format!("cannot draw {}: {e}", self.title))?;
            area.present().map_err(|e| format!("cannot draw {}: {e}", self.title))?;
        }
        let big = format!("width=\"{}\" height=\"{}\"", to_svg_units(FIGURE_WIDTH), to_svg_units(FIGURE_HEIGHT));
        Ok(text.replacen(&big, &format!("width=\"{FIGURE_WIDTH}\" height=\"{FIGURE_HEIGHT}\""), 1))
    }

    fn draw(&self, area: &SvgArea<'_>) -> DrawResult {
        let [left, top, right, bottom] = PLOT_MARGINS_PX;
        self.draw_axes(area)?;
        for series in &self.series {
            self.draw_series(area, series)?;
        }
        let frame = [(left, top), (FIGURE_WIDTH - right, FIGURE_HEIGHT - bottom)].map(to_svg_point);
        area.draw(&Rectangle::new(frame, ShapeStyle::from(TEXT_COLOUR).stroke_width(SVG_UNITS_PER_PIXEL as u32)))?;
        draw_text(area, &self.title, (left, 12.0), 15.0, (HPos::Left, VPos::Center), FontTransform::None)?;
        self.draw_legend(area)
    }

    fn draw_axes(&self, area: &SvgArea<'_>) -> DrawResult {
        let [left, top, right, bottom] = PLOT_MARGINS_PX;
        let [x, y] = &self.axes;
        let thin =
            |numbered: bool| ShapeStyle::from(if numbered { GRID_COLOUR } else { MINOR_GRID_COLOUR }).stroke_width(3);
        let [floor, ceiling] = [FIGURE_HEIGHT - bottom, top];
        for (v, numbered) in x.grid_lines() {
            let at = self.to_pixel([v, y.low]).0;
            area.draw(&PathElement::new([(at, floor), (at, ceiling)].map(to_svg_point), thin(numbered)))?;
            if numbered {
                draw_text(
                    area,
                    &x.format_tick(v),
                    (at, floor + 6.0),
                    12.0,
                    (HPos::Center, VPos::Top),
                    FontTransform::None,
                )?;
            }
        }
        for (v, numbered) in y.grid_lines() {
            let at = self.to_pixel([x.low, v]).1;
            area.draw(&PathElement::new([(left, at), (FIGURE_WIDTH - right, at)].map(to_svg_point), thin(numbered)))?;
            if numbered {
                draw_text(
                    area,
                    &y.format_tick(v),
                    (left - 6.0, at),
                    12.0,
                    (HPos::Right, VPos::Center),
                    FontTransform::None,
                )?;
            }
        }
        let middle = (0.5 * (left + FIGURE_WIDTH - right), 0.5 * (ceiling + floor));
        let centred = (HPos::Center, VPos::Center);
        draw_text(area, &x.label, (middle.0, FIGURE_HEIGHT - 14.0), 13.0, centred, FontTransform::None)?;
        draw_text(area, &y.label, (16.0, middle.1), 13.0, centred, FontTransform::Rotate270)
    }

    fn draw_series(&self, area: &SvgArea<'_>, series: &FigureSeries) -> DrawResult {
        let colour = series.colour();
        let pen = ShapeStyle::from(colour).stroke_width((1.8 * SVG_UNITS_PER_PIXEL) as u32);
        let path = |points: &[[f64; 2]]| points.iter().map(|&p| self.to_pixel(p)).collect::<Vec<_>>();
        match &series.data {
            SeriesData::Line(points) => {
                for piece in self.pieces_in_plot_area(points) {
                    area.draw(&PathElement::new(path(piece).into_iter().map(to_svg_point).collect::<Vec<_>>(), pen))?;
                }
            }
            SeriesData::Dashes(points) => {
                for piece in self.pieces_in_plot_area(points) {
                    for dash in split_into_dashes(&path(piece)) {
                        area.draw(&PathElement::new(dash, pen))?;
                    }
                }
            }
            SeriesData::Points(points) => {
                let stem = ShapeStyle::from(colour).stroke_width(SVG_UNITS_PER_PIXEL as u32);
                for &[x, y, error] in points.iter().filter(|p| self.is_within_axes([p[0], p[1]])) {
                    let ends = [y - error, y + error].map(|y| to_svg_point(self.to_pixel([x, self.axes[1].clamp(y)])));
                    area.draw(&PathElement::new(ends, stem))?;
                    area.draw(&Circle::new(
                        to_svg_point(self.to_pixel([x, y])),
                        (2.6 * SVG_UNITS_PER_PIXEL) as i32,
                        WHITE.filled(),
                    ))?;
                    area.draw(&Circle::new(
                        to_svg_point(self.to_pixel([x, y])),
                        (2.6 * SVG_UNITS_PER_PIXEL) as i32,
                        stem.stroke_width(6),
                    ))?;
                }
            }
            SeriesData::Band(points) => {
                let edge = |p: &[f64; 3], i: usize| to_svg_point(self.to_pixel([p[0], self.axes[1].clamp(p[i])]));
                let there = points.iter().map(|p| edge(p, 1));
                let outline: Vec<_> = there.chain(points.iter().rev().map(|p| edge(p, 2))).collect();
                area.draw(&Polygon::new(outline, colour.mix(0.18).filled()))?;
            }
            SeriesData::Bars(bars) => {
                for &[low, high, y] in bars {
                    let corners = [[low, self.axes[1].low], [high, y]].map(|p| to_svg_point(self.to_pixel(p)));
                    area.draw(&Rectangle::new(corners, colour.mix(0.35).filled()))?;
                }
            }
        }
        Ok(())
    }

    fn draw_legend(&self, area: &SvgArea<'_>) -> DrawResult {
        let named: Vec<&FigureSeries> = self.series.iter().filter(|s| !s.label.is_empty()).collect();
        let longest = named.iter().map(|s| s.label.chars().count()).max().unwrap_or(0) as f64;
        let (wide, high) = (46.0 + 6.4 * longest, 8.0 + 17.0 * named.len() as f64);
        let [left, top, right, bottom] = PLOT_MARGINS_PX;
        let x = match self.legend {
            LegendCorner::UpperLeft => left + 8.0,
            LegendCorner::UpperRight | LegendCorner::LowerRight => FIGURE_WIDTH - right - 8.0 - wide,
        };
        let y = match self.legend {
            LegendCorner::UpperLeft | LegendCorner::UpperRight => top + 8.0,
            LegendCorner::LowerRight => FIGURE_HEIGHT - bottom - 8.0 - high,
        };
        area.draw(&Rectangle::new([(x, y), (x + wide, y + high)].map(to_svg_point), WHITE.mix(0.85).filled()))?;
        for (i, series) in named.iter().enumerate() {
            let at = y + 12.0 + 17.0 * i as f64;
            let pen = ShapeStyle::from(series.colour()).stroke_width((1.8 * SVG_UNITS_PER_PIXEL) as u32);
            let ends = [(x + 6.0, at), (x + 30.0, at)];
            let patch = [(x + 6.0, at - 5.0), (x + 30.0, at + 5.0)].map(to_svg_point);
            match &series.data {
                SeriesData::Line(_) => area.draw(&PathElement::new(ends.map(to_svg_point), pen))?,
                SeriesData::Dashes(_) => {
                    for dash in split_into_dashes(&ends) {
                        area.draw(&PathElement::new(dash, pen))?;
                    }
                }
                SeriesData::Points(_) => {
                    area.draw(&Circle::new(
                        to_svg_point((x + 18.0, at)),
                        (2.6 * SVG_UNITS_PER_PIXEL) as i32,
                        pen.stroke_width(6),
                    ))?;
                }
                SeriesData::Band(_) => area.draw(&Rectangle::new(patch, series.colour().mix(0.18).filled()))?,
                SeriesData::Bars(_) => area.draw(&Rectangle::new(patch, series.colour().mix(0.35).filled()))?,
            }
            draw_text(area, &series.label, (x + 38.0, at), 12.0, (HPos::Left, VPos::Center), FontTransform::None)?;
        }
        Ok(())
    }

    fn to_pixel(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        let [left, top, right, bottom] = PLOT_MARGINS_PX;
        let across = left + self.axes[0].fraction_along(x) * (FIGURE_WIDTH - left - right);
        let up =
            FIGURE_HEIGHT - bottom - self.axes[1].fraction_along(y).clamp(-9.0, 9.0) * (FIGURE_HEIGHT - top - bottom);
        (across, up)
    }

    fn is_within_axes(&self, point: [f64; 2]) -> bool {
        self.axes
            .iter()
            .zip(point)
            .all(|(axis, v)| v.is_finite() && (-1e-9..=1.0 + 1e-9).contains(&axis.fraction_along(v)))
    }

    /// Splits a curve, given as points (x, y) in the units of the axes, into its pieces inside the plot area. Points
    /// outside are left out.
    fn pieces_in_plot_area<'a>(&self, points: &'a [[f64; 2]]) -> Vec<&'a [[f64; 2]]> {
        points.split(|&p| !self.is_within_axes(p)).filter(|piece| piece.len() > 1).collect()
    }
}

type SvgArea<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type DrawResult = Result<(), DrawingAreaErrorKind<std::io::Error>>;

fn to_svg_units(pixels: f64) -> i32 {
    (pixels * SVG_UNITS_PER_PIXEL).round() as i32
}

fn to_svg_point((x, y): (f64, f64)) -> (i32, i32) {
    (to_svg_units(x), to_svg_units(y))
}

/// Cuts a path (x, y in pixels) into dashes of 6 pixels with gaps of 4 pixels. Returns for each dash its points (x, y)
/// in SVG user units.
fn split_into_dashes(path: &[(f64, f64)]) -> Vec<Vec<(i32, i32)>> {
    const DASH_LENGTH_PX: f64 = 6.0;
    const DASH_PERIOD_PX: f64 = 10.0;
    let mut out: Vec<Vec<(i32, i32)>> = Vec::new();
    let mut gone = 0.0;
    for pair in path.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        let along = |s: f64| to_svg_point((a.0 + (b.0 - a.0) * s / length, a.1 + (b.1 - a.1) * s / length));
        let mut s = 0.0;
        while s < length {
            let phase = (gone + s) % DASH_PERIOD_PX;
            let end = if phase < DASH_LENGTH_PX { s + DASH_LENGTH_PX - phase } else { s + DASH_PERIOD_PX - phase }
                .min(length)
                .max(s + 1e-6);
            if phase < DASH_LENGTH_PX {
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

fn draw_text(
    area: &SvgArea<'_>,
    text: &str,
    at: (f64, f64),
    size: f64,
    (across, up): (HPos, VPos),
    turn: FontTransform,
) -> DrawResult {
    let font = ("Helvetica, Arial, sans-serif", size * SVG_UNITS_PER_PIXEL).into_font().transform(turn);
    area.draw(&Text::new(text.to_owned(), to_svg_point(at), font.color(&TEXT_COLOUR).pos(Pos::new(across, up))))
}
