//! The small interface (`ui=mini`) of a sea in a frame of another page: one line that says what is seen and opens the
//! whole page, and a button that stops the time.

use super::accessible_names::with_accessible_name;
use super::{App, icons};
use crate::app::language::tr;

/// Shows the caption and the button at the lower left of the window.
pub fn show_caption(app: &mut App, ctx: &egui::Context) {
    let margin = 8.0;
    let area = egui::Area::new(egui::Id::unique("mini"))
        .anchor(egui::Align2::LEFT_BOTTOM, egui::vec2(margin, -margin))
        .constrain_to(ctx.content_rect());
    let shade = egui::Color32::from_rgba_unmultiplied(8, 16, 24, 150);
    let frame = egui::Frame::new().fill(shade).corner_radius(8.0).inner_margin(egui::Margin::symmetric(8, 4));
    area.show(ctx, |ui| {
        frame.show(ui, |ui| {
            ui.set_max_width((ctx.content_rect().width() - 4.0 * margin).max(40.0));
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing.x = 6.0;
                let clock = &mut app.params.clock;
                let (icon, name) = if clock.paused { (icons::PLAY, tr("Play")) } else { (icons::PAUSE, tr("Pause")) };
                let button = egui::Button::new(egui::RichText::new(icon).size(15.0)).frame_when_inactive(false);
                if with_accessible_name(ui.add(button), name).clicked() {
                    clock.paused = !clock.paused;
                }
                let words = format!("{}.", app.sea_in_words());
                ui.label(egui::RichText::new(words).size(13.0).color(egui::Color32::WHITE));
                let link =
                    egui::RichText::new(tr("Open in Seastate")).size(13.0).color(egui::Color32::WHITE).underline();
                if ui.link(link).clicked() {
                    ctx.open_url(egui::OpenUrl::new_tab(app.whole_page_link()));
                }
            });
        });
    });
}
