//! Draws a figure of maps. As in the other figures, everything is drawn at four times its size: the view box of an SVG
//! scales it down, and a picture is averaged, which smooths its edges.

use super::contours::contours;
use super::palette::Colour;
use super::{MapFigure, MapPanel, png, raster};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use std::cell::RefCell;

/// Units of the drawing per pixel of the figure.
const UNITS: f64 = 4.0;
const WIDTH: f64 = 880.0;
/// Height of the title and the line below it, and margin at the foot, pixels.
const HEAD: f64 = 62.0;
const FOOT: f64 = 8.0;
/// Around a map within its half of the width, pixels: left, top, right (for the colour bar), bottom.
const MARGINS: [f64; 4] = [56.0, 26.0, 74.0, 44.0];
/// Largest height of a map, pixels.
const MAX_MAP_HEIGHT: f64 = 430.0;
const FONT: &str = "Helvetica, Arial, sans-serif";
const INK: RGBColor = RGBColor(34, 40, 49);
const SHORE: RGBColor = RGBColor(84, 66, 44);
const ARROW: RGBColor = RGBColor(186, 40, 20);

type Area<'a, B> = DrawingArea<B, Shift>;
type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// Where the maps of a figure lie, pixels.
struct Layout {
    /// Width and height of a map.
    map: [f64; 2],
    /// Pixels of a metre.
    scale: f64,
    height: f64,
}

impl Layout {
    fn new(figure: &MapFigure) -> Self {
        let [up_m, across_m] = figure.side_m();
        let [left, top, right, bottom] = MARGINS;
        let scale = ((0.5 * WIDTH - left - right) / across_m).min(MAX_MAP_HEIGHT / up_m);
        // Whole pixels, so that a map's picture fits its frame.
        let map = [across_m * scale, up_m * scale].map(f64::round);
        let height = HEAD + FOOT + figure.panels.len().div_ceil(2) as f64 * (top + map[1] + bottom);
        Self { map, scale: map[0] / across_m, height: height.ceil() }
    }

    /// Left top corner of a map.
    fn corner(&self, panel: usize) -> [f64; 2] {
        let [left, top, right, bottom] = MARGINS;
        let free = 0.5 * WIDTH - left - right - self.map[0];
        [
            (panel % 2) as f64 * 0.5 * WIDTH + left + 0.5 * free,
            HEAD + (panel / 2) as f64 * (top + self.map[1] + bottom) + top,
        ]
    }
}

fn units(pixels: f64) -> i32 {
    (pixels * UNITS).round() as i32
}

fn place([x, y]: [f64; 2]) -> (i32, i32) {
    (units(x), units(y))
}

fn pen(colour: RGBColor, width: f64) -> ShapeStyle {
    ShapeStyle::from(colour).stroke_width((width * UNITS).round().max(1.0) as u32)
}

pub(super) fn svg(figure: &MapFigure) -> Result<String, String> {
    let layout = Layout::new(figure);
    let size = [WIDTH, layout.height].map(|v| units(v) as u32);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (size[0], size[1])).into_drawing_area();
        draw(figure, &layout, &area).and_then(|()| area.present()).map_err(|e| format!("cannot draw a map: {e}"))?;
    }
    let mut under = format!("<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", size[0], size[1]);
    for (index, panel) in figure.panels.iter().enumerate() {
        let pixels = layout.map.map(|v| v as usize);
        let picture = png::indexed(pixels[0], &raster::raster(figure, panel, pixels), &panel.scale.colours())?;
        let [x, y] = layout.corner(index).map(units);
        let [wide, high] = layout.map.map(units);
        under += &format!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{wide}\" height=\"{high}\" href=\"data:image/png;base64,{}\"/>\n",
            png::base64(&picture)
        );
    }
    let big = format!("width=\"{}\" height=\"{}\"", size[0], size[1]);
    let text = text.replacen(&big, &format!("width=\"{WIDTH}\" height=\"{}\"", layout.height), 1);
    let start = text.find(">\n").ok_or("the drawing is no SVG")? + 2;
    Ok(format!("{}{under}{}", &text[..start], &text[start..]))
}

pub(super) fn png(figure: &MapFigure) -> Result<Vec<u8>, String> {
    // The same letters on every system. Registered again, they stay the same.
    register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| "the font of the figures cannot be read".to_owned())?;
    let layout = Layout::new(figure);
    let (wide, high) = (units(WIDTH) as usize, units(layout.height) as usize);
    let mut pixels = vec![255; 3 * wide * high];
    let mut used: Vec<Colour> = vec![[255; 3], [INK.0, INK.1, INK.2], [ARROW.0, ARROW.1, ARROW.2]];
    for (index, panel) in figure.panels.iter().enumerate() {
        let [left, top] = layout.corner(index).map(|v| units(v) as usize);
        let size = layout.map.map(|v| units(v) as usize);
        let (indices, colours) = (raster::raster(figure, panel, size), panel.scale.colours());
        used.extend((0..colours.len()).filter(|i| indices.contains(&(*i as u8))).map(|i| colours[i]));
        used.extend((0..panel.scale.bands).map(|band| panel.scale.colour(band)));
        for (row, line) in indices.chunks(size[0]).enumerate() {
            let start = 3 * ((top + row) * wide + left);
            let out = pixels[start..start + 3 * size[0]].chunks_exact_mut(3);
            out.zip(line).for_each(|(pixel, index)| pixel.copy_from_slice(&colours[usize::from(*index)]));
        }
    }
    {
        let area = BitMapBackend::with_buffer(&mut pixels, (wide as u32, high as u32)).into_drawing_area();
        draw(figure, &layout, &area).and_then(|()| area.present()).map_err(|e| format!("cannot draw a map: {e}"))?;
    }
    png::reduced(WIDTH as usize, &averaged(&pixels, wide), &used)
}

/// The picture at a quarter of its width and height: each pixel is the mean of 4 x 4.
fn averaged(pixels: &[u8], wide: usize) -> Vec<u8> {
    let step = UNITS as usize;
    let (width, height) = (wide / step, pixels.len() / 3 / wide / step);
    let mut out = Vec::with_capacity(3 * width * height);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..3 {
                let row = |j: usize| 3 * ((y * step + j) * wide + x * step) + channel;
                let sum: usize = (0..step)
                    .flat_map(|j| (0..step).map(move |i| (i, j)))
                    .map(|(i, j)| usize::from(pixels[row(j) + 3 * i]))
                    .sum();
                out.push(((sum + step * step / 2) / (step * step)) as u8);
            }
        }
    }
    out
}

fn draw<B: DrawingBackend>(figure: &MapFigure, layout: &Layout, area: &Area<'_, B>) -> Drawn<B> {
    text(area, &figure.title, [20.0, 22.0], 19.0, (HPos::Left, VPos::Center))?;
    text(area, &figure.subtitle, [20.0, 45.0], 13.0, (HPos::Left, VPos::Center))?;
    for (index, panel) in figure.panels.iter().enumerate() {
        let map = Map { figure, panel, layout, corner: layout.corner(index), labels: RefCell::default() };
        map.draw(area)?;
        if index == 0 {
            map.draw_compass(area)?;
        }
    }
    Ok(())
}

fn text<B: DrawingBackend>(area: &Area<'_, B>, text: &str, at: [f64; 2], size: f64, (h, v): (HPos, VPos)) -> Drawn<B> {
    let font = (FONT, size * UNITS).into_font().color(&INK).pos(Pos::new(h, v));
    area.draw(&Text::new(text.to_owned(), place(at), font))
}

fn rgb(colour: Colour) -> RGBColor {
    RGBColor(colour[0], colour[1], colour[2])
}

/// One map at its place.
struct Map<'a> {
    figure: &'a MapFigure,
    panel: &'a MapPanel,
    layout: &'a Layout,
    corner: [f64; 2],
    /// Where labels of contours stand, pixels.
    labels: RefCell<Vec<[f64; 2]>>,
}

impl Map<'_> {
    /// Pixel of a point (x, y) in metres.
    fn pixel(&self, [x_m, y_m]: [f64; 2]) -> [f64; 2] {
        let up = self.layout.map[1] / self.figure.side_m()[0];
        [self.corner[0] + y_m * self.layout.scale, self.corner[1] + self.layout.map[1] - x_m * up]
    }

    fn draw<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        for depth_m in &self.panel.depth_contours_m {
            self.draw_contours(area, &self.figure.depth_m, *depth_m, pen(RGBColor(96, 112, 128), 0.5), false)?;
        }
        self.draw_contours(area, &self.figure.depth_m, 0.0, pen(SHORE, 1.2), false)?;
        // Contours end at the shore.
        let depth = |i: usize| if self.figure.depth_m[i] > 0.0 { self.panel.values[i] } else { f32::NAN };
        let values: Vec<f32> = (0..self.panel.values.len()).map(depth).collect();
        for value in &self.panel.contours {
            self.draw_contours(area, &values, *value, pen(INK, 0.7), true)?;
        }
        for arrow in &self.panel.arrows {
            self.draw_arrow(area, *arrow)?;
        }
        for (index, mark) in self.figure.marks_m.iter().enumerate() {
            let at = self.pixel(*mark);
            area.draw(&Circle::new(place(at), units(3.6), WHITE.filled()))?;
            area.draw(&Circle::new(place(at), units(2.6), RGBColor(200, 30, 30).filled()))?;
            self.label(area, &(index + 1).to_string(), [at[0] + 10.0, at[1] - 8.0])?;
        }
        self.draw_frame(area)?;
        if self.panel.scale.has_bar { self.draw_bar(area) } else { Ok(()) }
    }

    fn draw_contours<B: DrawingBackend>(
        &self,
        area: &Area<'_, B>,
        values: &[f32],
        level: f64,
        pen: ShapeStyle,
        has_number: bool,
    ) -> Drawn<B> {
        let cell_m = self.figure.cell_m;
        let lines = contours(values, self.figure.columns, level);
        let on_map = |p: &[f64; 2]| self.pixel([p[0] * cell_m, p[1] * cell_m]);
        for line in lines.iter().filter(|line| line.len() > 3) {
            let mut path: Vec<(i32, i32)> = line.iter().map(|p| place(on_map(p))).collect();
            path.dedup();
            area.draw(&PathElement::new(path, pen))?;
        }
        let longest = lines.iter().max_by_key(|line| line.len()).filter(|line| has_number && line.len() > 40);
        let Some(line) = longest else { return Ok(()) };
        // The first of some places along the contour where no other number stands.
        let is_free = |at: &[f64; 2]| {
            self.labels.borrow().iter().all(|other| (other[0] - at[0]).abs() > 30.0 || (other[1] - at[1]).abs() > 15.0)
        };
        let places = [0.5, 0.38, 0.62, 0.26, 0.74].map(|part| on_map(&line[(line.len() as f64 * part) as usize]));
        match places.into_iter().find(is_free) {
            Some(at) => {
                self.labels.borrow_mut().push(at);
                self.label(area, &number(level, self.panel.scale.step), at)
            }
            None => Ok(()),
        }
    }

    /// A text on a light ground.
    fn label<B: DrawingBackend>(&self, area: &Area<'_, B>, label: &str, [x, y]: [f64; 2]) -> Drawn<B> {
        let half = 3.4 * label.chars().count() as f64 + 1.5;
        // Labels stay on the map.
        let x = x.clamp(self.corner[0] + half, self.corner[0] + self.layout.map[0] - half);
        let ground = [[x - half, y - 6.5], [x + half, y + 6.5]].map(place);
        area.draw(&Rectangle::new(ground, WHITE.mix(0.7).filled()))?;
        text(area, label, [x, y], 11.0, (HPos::Center, VPos::Center))
    }

    fn draw_arrow<B: DrawingBackend>(&self, area: &Area<'_, B>, [x, y, dx, dy]: [f64; 4]) -> Drawn<B> {
        let length = 22.0;
        let [px, py] = self.pixel([x, y]);
        let (ux, uy) = (dy * length, -dx * length);
        let size = ux.hypot(uy);
        if size < 2.0 {
            return Ok(());
        }
        let tip = [px + 0.5 * ux, py + 0.5 * uy];
        let head = (0.4 * size).clamp(3.0, 7.0) / size;
        let back = |side: f64| [tip[0] - head * (ux - side * 0.5 * uy), tip[1] - head * (uy + side * 0.5 * ux)];
        area.draw(&PathElement::new([[px - 0.5 * ux, py - 0.5 * uy], tip].map(place), pen(ARROW, 1.2)))?;
        area.draw(&Polygon::new([tip, back(1.0), back(-1.0)].map(place), ARROW.filled()))
    }

    fn draw_frame<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        let [left, top] = self.corner;
        let [wide, high] = self.layout.map;
        text(area, &self.panel.title, [left, top - 12.0], 14.0, (HPos::Left, VPos::Center))?;
        area.draw(&Rectangle::new([[left, top], [left + wide, top + high]].map(place), pen(INK, 1.0)))?;
        let [up_m, across_m] = self.figure.side_m();
        let step = tick_step(up_m.max(across_m));
        let ticks = |side_m: f64| (0..=(side_m / step + 1e-6) as u32).map(move |i| f64::from(i) * step);
        for v in ticks(across_m) {
            let [x, _] = self.pixel([0.0, v]);
            area.draw(&PathElement::new([[x, top + high], [x, top + high + 4.0]].map(place), pen(INK, 1.0)))?;
            text(area, &format!("{v:.0}"), [x, top + high + 7.0], 11.0, (HPos::Center, VPos::Top))?;
        }
        for v in ticks(up_m) {
            let [_, y] = self.pixel([v, 0.0]);
            area.draw(&PathElement::new([[left - 4.0, y], [left, y]].map(place), pen(INK, 1.0)))?;
            text(area, &format!("{v:.0}"), [left - 7.0, y], 11.0, (HPos::Right, VPos::Center))?;
        }
        text(
            area,
            "y, along the shore (m)",
            [left + 0.5 * wide, top + high + 29.0],
            11.0,
            (HPos::Center, VPos::Center),
        )?;
        let font = (FONT, 11.0 * UNITS).into_font().transform(FontTransform::Rotate270).color(&INK);
        let font = font.pos(Pos::new(HPos::Center, VPos::Center));
        area.draw(&Text::new("x, towards the land (m)".to_owned(), place([left - 44.0, top + 0.5 * high]), font))
    }

    fn draw_bar<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        let scale = &self.panel.scale;
        let (left, top, wide) = (self.corner[0] + self.layout.map[0] + 12.0, self.corner[1], 13.0);
        let high = self.layout.map[1];
        let at = |v: f64| top + high * (1.0 - (v - scale.low) / (scale.high() - scale.low));
        for band in 0..scale.bands {
            let low = scale.low + band as f64 * scale.step;
            let corners = [[left, at(low + scale.step)], [left + wide, at(low)]].map(place);
            area.draw(&Rectangle::new(corners, rgb(scale.colour(band)).filled()))?;
        }
        area.draw(&Rectangle::new([[left, top], [left + wide, top + high]].map(place), pen(INK, 0.8)))?;
        let every = scale.bands.div_ceil(11);
        for band in (0..=scale.bands).step_by(every) {
            let v = scale.low + band as f64 * scale.step;
            text(area, &number(v, scale.step), [left + wide + 5.0, at(v)], 11.0, (HPos::Left, VPos::Center))?;
        }
        Ok(())
    }

    /// A scale bar and an arrow to the north, on the land's side.
    fn draw_compass<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        let step_m = tick_step(self.figure.side_m()[1]);
        let [x, y] = [self.corner[0] + 10.0, self.corner[1] + 18.0];
        let end = x + step_m * self.layout.scale;
        let ground = [[x - 6.0, y - 14.0], [end + 6.0, y + 7.0]].map(place);
        area.draw(&Rectangle::new(ground, WHITE.mix(0.65).filled()))?;
        for line in [[[x, y], [end, y]], [[x, y - 3.0], [x, y + 3.0]], [[end, y - 3.0], [end, y + 3.0]]] {
            area.draw(&PathElement::new(line.map(place), pen(INK, 1.4)))?;
        }
        text(area, &format!("{step_m:.0} m"), [0.5 * (x + end), y - 7.5], 11.0, (HPos::Center, VPos::Center))?;
        // North is turned against the x axis, which points up, by its bearing.
        let (sin, cos) = (-self.figure.toward_deg).to_radians().sin_cos();
        let middle = [self.corner[0] + self.layout.map[0] - 24.0, self.corner[1] + 24.0];
        let at =
            |along: f64, across: f64| [middle[0] + along * sin + across * cos, middle[1] - along * cos + across * sin];
        area.draw(&Circle::new(place(middle), units(19.0), WHITE.mix(0.65).filled()))?;
        area.draw(&Polygon::new(
            [at(11.0, 0.0), at(-10.0, 5.5), at(-6.0, 0.0), at(-10.0, -5.5)].map(place),
            INK.filled(),
        ))?;
        text(area, "N", at(16.0, 0.0), 11.0, (HPos::Center, VPos::Center))
    }
}

/// Round distance of ticks on an axis of a length, m.
fn tick_step(length_m: f64) -> f64 {
    let unit = 10_f64.powf((length_m / 5.0).log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|m| m * unit).into_iter().find(|s| *s >= length_m / 5.0 - 1e-9).unwrap_or(length_m)
}

/// A number with the digits that steps of `step` need.
fn number(v: f64, step: f64) -> String {
    let digits = (0..4).find(|d| (step * 10_f64.powi(*d)).fract() < 1e-6).unwrap_or(4) as usize;
    format!("{:.digits$}", v + 0.0)
}
