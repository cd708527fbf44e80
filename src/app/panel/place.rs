//! Place and width of the panel of a wide window: at the right or the left edge, as wide as the user has dragged it. Both
//! are kept for the next visit.

use super::super::App;
use super::handle::Handle;
use super::{PANEL_WIDTH_POINTS, is_narrow, touch};
use crate::app::language::tr;
use egui::Key;

/// Least and greatest width of the panel's contents, points.
const WIDTH_RANGE_POINTS: [f32; 2] = [320.0, 720.0];
/// Width of the window that stays free of the panel's contents at least, points.
const LEAST_FREE_POINTS: f32 = 210.0;
/// Distance of the panel from the edges of the window, points.
pub const MARGIN_POINTS: f32 = 12.0;
/// Width that the panel has beside its contents and its distance from the edge, points.
const FRAME_POINTS: f32 = 20.0;
/// Thickness of the handles at the panel's top and at its inner edge, points.
const HANDLE_POINTS: f32 = 12.0;
/// Width by which one press of an arrow key changes the panel, points.
const WIDTH_STEP_POINTS: f32 = 20.0;

/// Place and width of the panel of a wide window, a preference of the visitor.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    is_left: bool,
    /// Width of the contents that the user has chosen, points. A small window shows less.
    width_points: f32,
}

impl Default for Place {
    fn default() -> Self {
        Self { is_left: false, width_points: PANEL_WIDTH_POINTS }
    }
}

impl Place {
    /// Takes a value of the stored preferences, as [`Self::text`] writes it. What cannot be read gives the usual value;
    /// the key of another preference changes nothing.
    pub fn read(&mut self, key: &str, value: &str) {
        match key {
            "side" => self.is_left = value == "left",
            "width" => {
                let [least, most] = WIDTH_RANGE_POINTS;
                let width = value.parse().ok().filter(|w: &f32| w.is_finite());
                self.width_points = width.map_or(PANEL_WIDTH_POINTS, |w| w.clamp(least, most));
            }
            _ => {}
        }
    }

    /// The place as lines of the stored preferences.
    pub fn text(&self) -> String {
        format!("side={}\nwidth={}\n", if self.is_left { "left" } else { "right" }, self.width_points.round())
    }

    /// Width of the panel's contents in a window whose usable part is `window` points wide.
    pub fn width(&self, window: f32) -> f32 {
        self.width_points.min((window - LEAST_FREE_POINTS).max(WIDTH_RANGE_POINTS[0]))
    }

    /// Corner of the window at which the panel is.
    pub fn corner(&self) -> egui::Align2 {
        if self.is_left { egui::Align2::LEFT_TOP } else { egui::Align2::RIGHT_TOP }
    }

    /// The part of the usable window `content` that the panel leaves free.
    pub fn free_part(&self, content: egui::Rect) -> egui::Rect {
        let taken = self.width(content.width()) + FRAME_POINTS + MARGIN_POINTS;
        if self.is_left {
            content.with_min_x(content.left() + taken)
        } else {
            content.with_max_x(content.right() - taken)
        }
    }
}

/// The part of the window that neither the panel nor the sheet covers.
pub fn free_part(app: &App, ctx: &egui::Context) -> egui::Rect {
    let content = ctx.content_rect();
    if is_narrow(ctx) {
        content.intersect(app.panel.sea.unwrap_or(content))
    } else {
        app.visitor.preferences.panel.free_part(content)
    }
}

/// Adds the handle at the panel's top, which moves the panel to the other edge of the window.
pub fn show_grip(app: &mut App, ui: &mut egui::Ui) {
    let height = if touch::is_used(ui.ctx()) { 2.0 * HANDLE_POINTS } else { HANDLE_POINTS };
    let (rect, _) = ui.allocate_exact_size(egui::vec2(ui.available_width(), height), egui::Sense::hover());
    let handle = Handle {
        name: tr("Side of the panel"),
        help: tr("Drag, or press the arrow keys: the panel at the left or the right. A double click puts it back."),
        value: f64::from(u8::from(!app.visitor.preferences.panel.is_left)),
        range: [0.0, 1.0],
        step: 1.0,
        keys: [Key::ArrowLeft, Key::ArrowRight],
        lies: true,
        cursor: egui::CursorIcon::Grab,
    };
    let (response, chosen) = handle.show(ui, rect, egui::Id::unique("side of the panel"));
    let place = &mut app.visitor.preferences.panel;
    let before = place.clone();
    if response.dragged() {
        app.panel.dragged_points += response.drag_delta().x;
        return;
    }
    if std::mem::take(&mut app.panel.dragged_points) != 0.0 {
        place.is_left = rect.center().x < ui.ctx().content_rect().center().x;
    }
    if let Some(side) = chosen {
        place.is_left = side < 0.5;
    }
    if response.double_clicked() {
        *place = Place::default();
    }
    if response.drag_stopped() || *place != before {
        app.store_preferences();
    }
}

/// Adds the handle at the inner edge of the panel, which changes its width. Call it after the panel's contents.
pub fn show_edge(app: &mut App, ui: &mut egui::Ui) {
    let content = ui.ctx().content_rect();
    let (panel, is_left) = (ui.min_rect(), app.visitor.preferences.panel.is_left);
    // In the margin of the window, so that the bar covers no text.
    let out = 0.5 * ui.style().spacing.window_margin.leftf();
    ui.set_clip_rect(ui.clip_rect().expand(2.0 * out));
    let x = if is_left { panel.right() + out } else { panel.left() - out };
    let rect = egui::Rect::from_center_size(egui::pos2(x, panel.center().y), egui::vec2(HANDLE_POINTS, panel.height()));
    let width = app.visitor.preferences.panel.width(content.width());
    let most = (content.width() - LEAST_FREE_POINTS).clamp(WIDTH_RANGE_POINTS[0], WIDTH_RANGE_POINTS[1]);
    let handle = Handle {
        name: tr("Width of the panel"),
        help: tr("Drag, or press the arrow keys: a wider or a narrower panel. A double click puts it back."),
        value: f64::from(width),
        range: [f64::from(WIDTH_RANGE_POINTS[0]), f64::from(most)],
        step: f64::from(WIDTH_STEP_POINTS),
        keys: if is_left { [Key::ArrowLeft, Key::ArrowRight] } else { [Key::ArrowRight, Key::ArrowLeft] },
        lies: false,
        cursor: egui::CursorIcon::ResizeHorizontal,
    };
    let (response, chosen) = handle.show(ui, rect, egui::Id::unique("width of the panel"));
    let place = &mut app.visitor.preferences.panel;
    let before = place.clone();
    if let Some(chosen) = chosen {
        place.width_points = chosen as f32;
    }
    if response.double_clicked() {
        place.width_points = PANEL_WIDTH_POINTS;
    }
    if response.dragged() {
        let wider = if is_left { response.drag_delta().x } else { -response.drag_delta().x };
        place.width_points = (width + wider).clamp(WIDTH_RANGE_POINTS[0], most);
        return;
    }
    // A drag is stored at its end.
    if response.drag_stopped() || *place != before {
        app.store_preferences();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_damaged_is_usual() {
        let place = Place { is_left: true, width_points: 500.0 };
        for (key, value) in [("width", "NaN"), ("width", ""), ("width", "x"), ("side", "?")] {
            let mut read = place.clone();
            read.read(key, value);
            let usual = Place::default();
            let is_usual = if key == "side" { !read.is_left } else { read.width_points == usual.width_points };
            assert!(is_usual, "{key}={value}: {read:?}");
        }
        let mut read = place.clone();
        read.read("slow-camera", "0");
        assert_eq!(read, place);
        read.read("width", "9999");
        assert_eq!(read.width_points, WIDTH_RANGE_POINTS[1]);
    }

    #[test]
    fn the_free_part_is_beside_the_panel_and_wide_enough() {
        for window in [640.0, 844.0, 1280.0, 3840.0] {
            let content = egui::Rect::from_min_size(egui::pos2(40.0, 0.0), egui::vec2(window, 400.0));
            for is_left in [false, true] {
                for width_points in [320.0, 366.0, 720.0] {
                    let place = Place { is_left, width_points };
                    let free = place.free_part(content);
                    assert!(free.width() >= LEAST_FREE_POINTS - FRAME_POINTS - MARGIN_POINTS, "{window} {place:?}");
                    assert!(content.contains_rect(free), "{window} {place:?}");
                    let edge = if is_left { content.left() } else { content.right() };
                    let panel = place.width(window) + FRAME_POINTS;
                    let gap = if is_left { free.left() - edge } else { edge - free.right() };
                    assert!(gap >= panel + MARGIN_POINTS, "{window} {place:?}: {gap}");
                }
            }
        }
    }
}
