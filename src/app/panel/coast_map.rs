//! The map of the coast in the panel: colours of a quantity with a bar of numbers, contours of the depth, arrows of the
//! waves' direction, the camera, and the gauges. The land is at the top, as one sees it from the sea.

use super::super::App;
use super::super::coast_maps::{Quantity, sea_at, toward_deg};
use super::super::plots::gauge::in_words;
use super::super::plots::polar::cividis;
use super::super::units::UnitScale;
use super::gauges;
use crate::app::language::{local_number, say, tr};
use crate::coast::sea_maps::usual_largest;
use crate::coast::transfer::TransferStatistics;
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, Vec2, pos2, vec2};
use std::sync::Arc;

/// Colour of land.
const LAND: Color32 = Color32::from_rgb(196, 178, 138);
/// Largest height of the map, points.
const MAX_HEIGHT_POINTS: f32 = 420.0;
/// Depths of contours in the shown unit.
const CONTOURS: [f64; 9] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0];
/// Arrows of the direction along the longer side.
const ARROWS: f64 = 12.0;
/// Least distance of two numbers at contours, as a fraction of the map's height.
const LABEL_DISTANCE: f32 = 0.06;

/// The picture of a map: it is made anew when another quantity is shown, or another sea.
pub struct MapPicture {
    of: (Arc<TransferStatistics>, Quantity, UnitScale),
    texture: egui::TextureHandle,
    /// Largest value of the colours, in the shown unit.
    largest: f64,
    /// Contours of the depth as places on the map, 0 to 1 to the right and down.
    contours: Vec<[Pos2; 2]>,
    /// Numbers at the contours.
    numbers: Vec<(Pos2, String)>,
}

/// The map on the screen.
struct View<'a> {
    statistics: &'a TransferStatistics,
    rect: Rect,
}

/// Adds the choice of the quantity, the map, and the gauges on it.
pub fn show_map(app: &mut App, ui: &mut egui::Ui) {
    app.coast.maps.is_visible.set(true);
    ui.horizontal_wrapped(|ui| {
        for (quantity, name) in Quantity::NAMES {
            ui.selectable_value(&mut app.coast.maps.quantity, quantity, tr(name));
        }
    });
    let Some(statistics) = app.coast.maps.statistics().cloned() else {
        ui.weak(tr("The map appears when the waves have found their way ashore."));
        return;
    };
    let of = (statistics.clone(), app.coast.maps.quantity, app.length_scale());
    let is_same = |p: &MapPicture| Arc::ptr_eq(&p.of.0, &of.0) && (p.of.1, p.of.2) == (of.1, of.2);
    let picture = app.panel.coast_map.take().filter(is_same).unwrap_or_else(|| MapPicture::new(of, ui.ctx()));
    let sides = [statistics.bathymetry.rows, statistics.bathymetry.columns].map(|count| (count - 1) as f32);
    let width = ui.available_width().min(MAX_HEIGHT_POINTS * sides[0] / sides[1]);
    let (rect, response) = ui.allocate_exact_size(vec2(width, width * sides[1] / sides[0]), egui::Sense::click());
    let (_, name) = Quantity::NAMES[picture.of.1 as usize];
    let name = say!("Map: {quantity}", quantity = tr(name));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
    let view = View { statistics: &statistics, rect };
    view.draw(app, &picture, &ui.painter_at(rect));
    picture.show_colour_bar(ui, width);
    if let Some(point) = response.hover_pos().and_then(|at| app.coast.maps.wet_point(view.in_frame_m(at))) {
        let text = in_words(app, &sea_at(&statistics, point));
        response.clone().on_hover_text_at_pointer(text);
    }
    if response.clicked() {
        // A key or a screen reader points at no place.
        let camera = [app.params.camera.x_m, app.params.camera.z_m];
        let at_camera = || statistics.transfer().in_frame_m(camera);
        gauges::place(app, response.interact_pointer_pos().map_or_else(at_camera, |at| view.in_frame_m(at)));
    }
    app.panel.coast_map = Some(picture);
    gauges::show_gauges(app, ui);
}

impl MapPicture {
    fn new(of: (Arc<TransferStatistics>, Quantity, UnitScale), ctx: &egui::Context) -> Self {
        let (statistics, quantity, scale) = (&*of.0, of.1, of.2);
        let (grid, maps) = (&statistics.bathymetry, &statistics.maps);
        let (values, factor) = match quantity {
            Quantity::Depth => (&grid.depth_m, scale.factor),
            Quantity::Height | Quantity::Direction => (&maps.hs_m, scale.factor),
            Quantity::Breaking => (&maps.breaking_fraction, 100.0),
        };
        let largest = match quantity {
            Quantity::Breaking => 100.0,
            _ => nice_above(usual_largest(values) * factor),
        };
        let colour = |index: usize| {
            let part = f64::from(values[index]) * factor / largest;
            // Deep water is dark.
            let part = if quantity == Quantity::Depth { 1.0 - part } else { part };
            if grid.depth_m[index] > 0.0 { cividis(part) } else { LAND }
        };
        let (wide, high) = (grid.rows, grid.columns);
        let pixels = (0..high).flat_map(|up| (0..wide).map(move |j| j * high + (high - 1 - up))).map(colour).collect();
        let image = egui::ColorImage::new([wide, high], pixels);
        let texture = ctx.load_texture("map of the coast", image, egui::TextureOptions::LINEAR);
        let (contours, numbers) = contours(statistics, scale.factor);
        Self { of, texture, largest, contours, numbers }
    }

    /// Adds the bar of the colours with its numbers.
    fn show_colour_bar(&self, ui: &mut egui::Ui, width: f32) {
        let (rect, _) = ui.allocate_exact_size(vec2(width, 26.0), egui::Sense::hover());
        let (bar, painter) = (rect.with_max_y(rect.top() + 10.0), ui.painter_at(rect));
        let steps = 64;
        for step in 0..steps {
            let part = (step as f32 + 0.5) / steps as f32;
            let is_depth = self.of.1 == Quantity::Depth;
            let colour = cividis(f64::from(if is_depth { 1.0 - part } else { part }));
            let left = bar.left() + bar.width() * step as f32 / steps as f32;
            let box_of = Rect::from_min_size(pos2(left, bar.top()), vec2(bar.width() / steps as f32 + 1.0, 10.0));
            painter.rect_filled(box_of.intersect(bar), 0.0, colour);
        }
        let unit = if self.of.1 == Quantity::Breaking { "%" } else { self.of.2.unit };
        for (part, align) in [(0.0, Align2::LEFT_BOTTOM), (0.5, Align2::CENTER_BOTTOM), (1.0, Align2::RIGHT_BOTTOM)] {
            let text = format!("{} {unit}", local_number(short_number(part * self.largest)));
            let at = pos2(rect.left() + part as f32 * rect.width(), rect.bottom());
            painter.text(at, align, text, FontId::proportional(11.0), ui.visuals().text_color());
        }
    }
}

impl View<'_> {
    /// Lengths of the map to the right and up, m.
    fn sides_m(&self) -> [f64; 2] {
        let grid = &self.statistics.bathymetry;
        [grid.rows, grid.columns].map(|count| (count - 1) as f64 * grid.cell_m)
    }

    /// Place on the screen of (x, y), m, of the coast's frame.
    fn on_screen(&self, [x_m, y_m]: [f64; 2]) -> Pos2 {
        let [wide, high] = self.sides_m();
        self.rect.left_bottom() + vec2((y_m / wide) as f32, -(x_m / high) as f32) * self.rect.size()
    }

    /// Point (x, y), m, of the coast's frame at a place on the screen.
    fn in_frame_m(&self, at: Pos2) -> [f64; 2] {
        let ([wide, high], part) = (self.sides_m(), (at - self.rect.left_bottom()) / self.rect.size());
        [-f64::from(part.y) * high, f64::from(part.x) * wide]
    }

    /// Direction on the screen of a bearing, degrees clockwise from north.
    fn bearing(&self, deg: f64) -> Vec2 {
        let (sin, cos) = (deg - toward_deg(self.statistics)).to_radians().sin_cos();
        vec2(sin as f32, -cos as f32)
    }

    fn draw(&self, app: &App, picture: &MapPicture, painter: &Painter) {
        let [wide, high] = picture.texture.size().map(|side| side as f32);
        // The outer points lie on the edge of the map, so half of their pixels is outside.
        let margin = vec2(0.5 / wide, 0.5 / high);
        let uv = Rect::from_min_max(margin.to_pos2(), pos2(1.0, 1.0) - margin);
        painter.image(picture.texture.id(), self.rect, uv, Color32::WHITE);
        let place = |at: Pos2| self.rect.min + at.to_vec2() * self.rect.size();
        let stroke = Stroke::new(1.0, Color32::from_white_alpha(90));
        for line in &picture.contours {
            painter.line_segment(line.map(place), stroke);
        }
        if picture.of.1 == Quantity::Direction {
            self.draw_directions(painter);
        }
        if picture.of.1 == Quantity::Depth {
            for (at, number) in &picture.numbers {
                outlined(painter, place(*at), Align2::CENTER_CENTER, number, 10.0);
            }
        }
        self.draw_scale_and_north(app, painter);
        self.draw_camera(app, painter);
        for (index, gauge) in app.coast.maps.gauges.iter().enumerate() {
            let at = self.on_screen(gauge.point.map(|i| i as f64 * self.statistics.bathymetry.cell_m));
            painter.circle(at, 8.0, Color32::from_rgb(213, 94, 0), Stroke::new(1.5, Color32::WHITE));
            let font = FontId::proportional(12.0);
            painter.text(at, Align2::CENTER_CENTER, (index + 1).to_string(), font, Color32::WHITE);
        }
    }

    /// Arrows of the mean direction, as long as the waves are high.
    fn draw_directions(&self, painter: &Painter) {
        let (grid, maps) = (&self.statistics.bathymetry, &self.statistics.maps);
        let step = grid.columns.max(grid.rows) as f64 / ARROWS;
        let places =
            |count: usize| (0..(count as f64 / step) as usize).map(move |i| ((i as f64 + 0.5) * step) as usize);
        let highest = usual_largest(&maps.hs_m).max(1e-9);
        let longest = 0.75 * step as f32 * self.rect.width() / grid.rows as f32;
        for (i, j) in places(grid.columns).flat_map(|i| places(grid.rows).map(move |j| (i, j))) {
            let index = j * grid.columns + i;
            if grid.depth_m[index] > 0.0 && maps.hs_m[index] > 0.0 {
                let (sin, cos) = maps.direction_rad[index].sin_cos();
                let length = longest * (f64::from(maps.hs_m[index]) / highest).sqrt().min(1.0) as f32;
                let way = length * vec2(sin, -cos);
                let from = self.on_screen([i, j].map(|i| i as f64 * grid.cell_m)) - 0.5 * way;
                painter.arrow(from, way, Stroke::new(1.3, Color32::WHITE));
            }
        }
    }

    fn draw_scale_and_north(&self, app: &App, painter: &Painter) {
        let scale = app.length_scale();
        let [wide, _] = self.sides_m();
        let length = nice_above(0.15 * wide * scale.factor);
        let points = (length / scale.factor / wide) as f32 * self.rect.width();
        let left = self.rect.left_bottom() + vec2(8.0, -8.0);
        let line = [left, left + vec2(points, 0.0)];
        painter.line_segment(line, Stroke::new(3.0, Color32::from_black_alpha(160)));
        painter.line_segment(line, Stroke::new(1.5, Color32::WHITE));
        let text = format!("{length:.0} {}", scale.unit);
        outlined(painter, left + vec2(0.0, -4.0), Align2::LEFT_BOTTOM, &text, 11.0);
        let (middle, north) = (self.rect.right_top() + vec2(-20.0, 22.0), self.bearing(0.0));
        painter.circle_filled(middle, 17.0, Color32::from_black_alpha(110));
        painter.arrow(middle - 12.0 * north, 16.0 * north, Stroke::new(1.5, Color32::WHITE));
        outlined(painter, middle + 11.0 * north, Align2::CENTER_CENTER, tr("N"), 11.0);
    }

    /// The camera, if it is over the map: a dot with the limits of the view.
    fn draw_camera(&self, app: &App, painter: &Painter) {
        let camera = &app.params.camera;
        let at = self.on_screen(self.statistics.transfer().in_frame_m([camera.x_m, camera.z_m]));
        if !self.rect.contains(at) {
            return;
        }
        let half_deg = 0.5 * camera.fov_deg;
        for turn_deg in [-half_deg, half_deg] {
            let end = at + 26.0 * self.bearing(camera.heading_deg + turn_deg);
            painter.line_segment([at, end], Stroke::new(1.5, Color32::WHITE));
        }
        painter.circle(at, 4.0, Color32::WHITE, Stroke::new(1.0, Color32::BLACK));
    }
}

/// Text in white that is readable over every colour.
fn outlined(painter: &Painter, at: Pos2, align: Align2, text: &str, points: f32) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(points), Color32::WHITE);
    let rect = align.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(vec2(2.0, 0.0)), 3.0, Color32::from_black_alpha(110));
    painter.galley(rect.min, galley, Color32::WHITE);
}

/// Contours of the depth in the unit that `factor` makes of metres, and their numbers.
fn contours(statistics: &TransferStatistics, factor: f64) -> (Vec<[Pos2; 2]>, Vec<(Pos2, String)>) {
    let grid = &statistics.bathymetry;
    let place = |[i, j]: [f32; 2]| pos2(j / (grid.rows - 1) as f32, 1.0 - i / (grid.columns - 1) as f32);
    let deepest = usual_largest(&grid.depth_m) * factor;
    let (mut lines, mut numbers) = (Vec::new(), Vec::<(Pos2, String)>::new());
    for level in CONTOURS.into_iter().filter(|level| *level < 0.97 * deepest) {
        let first = lines.len();
        // Two triangles a cell: a contour crosses two sides of a triangle or none.
        for (i, j) in (0..grid.columns - 1).flat_map(|i| (0..grid.rows - 1).map(move |j| (i, j))) {
            for triangle in [[[0, 0], [1, 0], [1, 1]], [[0, 0], [0, 1], [1, 1]]] {
                let corners = triangle.map(|[right, down]| [i + right, j + down]);
                let above = corners.map(|[i, j]| (grid.at(i, j) * factor - level) as f32);
                let crossing = |a: usize, b: usize| {
                    ((above[a] > 0.0) != (above[b] > 0.0)).then(|| {
                        let part = above[a] / (above[a] - above[b]);
                        place(
                            [0, 1].map(|axis| corners[a][axis] as f32 * (1.0 - part) + corners[b][axis] as f32 * part),
                        )
                    })
                };
                let mut ends = [(0, 1), (1, 2), (2, 0)].into_iter().filter_map(|(a, b)| crossing(a, b));
                if let (Some(a), Some(b)) = (ends.next(), ends.next()) {
                    lines.push([a, b]);
                }
            }
        }
        let from_middle = |line: &&[Pos2; 2]| (line[0].x - 0.5).abs();
        let nearest = lines[first..].iter().min_by(|a, b| from_middle(a).total_cmp(&from_middle(b)));
        if let Some([at, _]) = nearest
            && numbers.iter().all(|(other, _)| (other.y - at.y).abs() > LABEL_DISTANCE)
        {
            numbers.push((*at, short_number(level)));
        }
    }
    (lines, numbers)
}

/// The least of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten that is not below `value`.
fn nice_above(value: f64) -> f64 {
    let value = value.max(1e-3);
    let power = 10f64.powf(value.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    steps.into_iter().map(|step| step * power).find(|nice| *nice >= value * (1.0 - 1e-9)).unwrap_or(value)
}

/// A number with as many decimals as it has, at most two.
fn short_number(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_end_at_round_numbers() {
        for (value, nice) in [(0.93, 1.0), (1.21, 1.5), (2.0, 2.0), (6.1, 8.0), (83.0, 100.0), (450.0, 500.0)] {
            assert!((nice_above(value) - nice).abs() < 1e-9, "{value}: {}", nice_above(value));
        }
        assert_eq!([0.0, 0.75, 1.5, 20.0].map(short_number), ["0", "0.75", "1.5", "20"]);
        assert_eq!(usual_largest(&[0.0, -1.0]), 0.0);
    }
}
