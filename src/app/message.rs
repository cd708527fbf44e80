//! The short message that appears at the top of the window, such as "Link copied."

use super::App;
use crate::app::language::tr;
use std::time::Duration;

/// Time for which a message stays visible, s.
const MESSAGE_DURATION_S: f64 = 4.0;
/// Place of the message relative to the middle of the window's upper edge, points.
const MESSAGE_PLACE: egui::Vec2 = egui::vec2(0.0, 16.0);

/// A message for the user at the top of the window, and the time on egui's clock at which it disappears.
pub struct Message {
    /// Text of the message, one sentence.
    pub text: String,
    /// Time at which the message disappears, s on egui's clock. The first frame that shows the message sets it.
    end_s: Option<f64>,
}

impl App {
    /// Shows a message at the top of the window for a few seconds.
    pub(super) fn show_brief_message(&mut self, text: &str) {
        self.message = Some(Message { text: text.to_owned(), end_s: None });
        self.ctx.request_repaint();
    }

    /// Draws the current message, and removes it when its time is over.
    pub(super) fn draw_message(&mut self, ctx: &egui::Context) {
        // A brief message, such as that a link was copied, takes the place for its time.
        if self.picture_job.is_some() && self.message.is_none() {
            let area = egui::Area::new(egui::Id::unique("picture")).anchor(egui::Align2::CENTER_TOP, MESSAGE_PLACE);
            area.show(ctx, |ui| {
                egui::Frame::window(ui.style()).show(ui, |ui| {
                    ui.horizontal(|ui| {
                        ui.spinner();
                        ui.label(tr("The picture is being drawn in full."));
                        if ui.button(tr("Cancel")).clicked() {
                            self.picture_job = None;
                        }
                    });
                });
            });
            return;
        }
        let Some(message) = &mut self.message else { return };
        let now_s = ctx.input(|i| i.time);
        let end_s = *message.end_s.get_or_insert(now_s + MESSAGE_DURATION_S);
        if now_s > end_s {
            self.message = None;
            return;
        }
        ctx.request_repaint_after(Duration::from_secs_f64(end_s - now_s));
        let area = egui::Area::new(egui::Id::unique("said")).anchor(egui::Align2::CENTER_TOP, MESSAGE_PLACE);
        area.interactable(false).show(ctx, |ui| {
            egui::Frame::window(ui.style()).show(ui, |ui| ui.label(&message.text));
        });
    }
}
