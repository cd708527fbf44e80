//! The caption of a debug view (its name, colour bar and explanation), and the keys that switch between views.

use super::{App, panel};
use crate::state::views::{DisplayedView, ViewChoice};
use crate::waves::colour_scale::{Palette, caption};
use egui::{Color32, Key};

/// Width and height of the colour bar in a debug view's caption (the view shows one quantity, not the sea), points.
const COLOUR_BAR_SIZE: egui::Vec2 = egui::vec2(220.0, 10.0);

/// Changes the debug view (an image of one quantity, such as foam, in place of the sea) by keys: V shows the next one,
/// Shift+V the previous one; 0 to 4 choose the cascade (0: all); Escape returns to the picture. Returns whether Escape
/// has just closed a debug view.
pub fn apply_view_keys(view: &mut ViewChoice, ctx: &egui::Context) -> bool {
    let pressed = |key| ctx.input(|i| i.key_pressed(key));
    if pressed(Key::V) {
        *view = view.cycled_by(if ctx.input(|i| i.modifiers.shift) { -1 } else { 1 });
    }
    if view.displayed == DisplayedView::Picture {
        return false;
    }
    for (cascade, key) in (0..).zip([Key::Num0, Key::Num1, Key::Num2, Key::Num3, Key::Num4]) {
        if pressed(key) {
            view.cascade = cascade;
        }
    }
    let back = pressed(Key::Escape);
    if back {
        *view = ViewChoice::default();
    }
    back
}

impl App {
    /// Shows name, colour bar and explanation of the current debug view (an image of one quantity in place of the sea)
    /// at the lower left of the window, beside the panel if there is one. The ordinary picture has no caption.
    pub(super) fn show_view_caption(&self, has_panel: bool, ctx: &egui::Context) {
        let view = self.params.look.view;
        if view.displayed == DisplayedView::Picture {
            return;
        }
        let free = if has_panel { panel::free_part(self, ctx) } else { ctx.content_rect() };
        let area = egui::Area::new(egui::Id::unique("caption")).anchor(egui::Align2::LEFT_BOTTOM, egui::Vec2::ZERO);
        let area = area.constrain_to(free.shrink(12.0)).interactable(false);
        area.show(ctx, |ui| {
            egui::Frame::window(ui.style()).show(ui, |ui| {
                let caption = caption(view, &self.derived.plan);
                ui.strong(view.name());
                if let Some(palette) = caption.palette {
                    draw_colour_bar(palette, ui);
                }
                for line in caption.lines {
                    ui.label(line);
                }
            });
        });
    }
}

fn draw_colour_bar(palette: Palette, ui: &mut egui::Ui) {
    let (rect, _) = ui.allocate_exact_size(COLOUR_BAR_SIZE, egui::Sense::hover());
    let stops = palette.stops().map(|c| {
        let [r, g, b] = c.map(|x| (255.0 * x).round() as u8);
        Color32::from_rgb(r, g, b)
    });
    let mut mesh = egui::Mesh::default();
    for (i, colour) in stops.into_iter().enumerate() {
        let x = egui::lerp(rect.x_range(), i as f32 / (stops.len() - 1) as f32);
        mesh.colored_vertex(egui::pos2(x, rect.top()), colour);
        mesh.colored_vertex(egui::pos2(x, rect.bottom()), colour);
        if i > 0 {
            let at = 2 * i as u32;
            mesh.add_triangle(at - 2, at - 1, at);
            mesh.add_triangle(at - 1, at, at + 1);
        }
    }
    ui.painter().add(mesh);
}
