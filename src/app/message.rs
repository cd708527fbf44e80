//! The short message at the top of the window, such as "Link copied.".

use super::App;
use std::time::Duration;

/// How long a message stays visible, s.
const SHOWN_S: f64 = 4.0;

/// A message, and when it disappears.
pub struct Message {
    /// The sentence to show.
    pub text: String,
    /// egui's time at which it disappears, s; set by the first frame that shows it.
    end_s: Option<f64>,
}

impl App {
    /// Shows a message for a few seconds, from the next frame that is painted.
    pub(super) fn say(&mut self, text: &str) {
        self.message = Some(Message { text: text.to_owned(), end_s: None });
        self.ctx.request_repaint();
    }

    /// Draws the current message, if any.
    pub(super) fn show_message(&mut self, ctx: &egui::Context) {
        let Some(message) = &mut self.message else { return };
        let now_s = ctx.input(|i| i.time);
        let end_s = *message.end_s.get_or_insert(now_s + SHOWN_S);
        if now_s > end_s {
            self.message = None;
            return;
        }
        ctx.request_repaint_after(Duration::from_secs_f64(end_s - now_s));
        let area = egui::Area::new(egui::Id::unique("said")).anchor(egui::Align2::CENTER_TOP, egui::vec2(0.0, 16.0));
        area.interactable(false).show(ctx, |ui| {
            egui::Frame::window(ui.style()).show(ui, |ui| ui.label(&message.text));
        });
    }
}
