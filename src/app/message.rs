//! The short message that appears over the sea, such as "Link copied."

use super::accessible_names::with_accessible_name;
use super::{App, panel};
use crate::app::language::tr;
use crate::state::coast::Coast;
use crate::state::params::{Camera, Interface};
use std::time::Duration;

/// Least time for which a message with a button stays visible, s.
const BUTTON_DURATION_S: f64 = 10.0;
/// Least time for which a message stays visible, s.
const MESSAGE_DURATION_S: f64 = 7.0;
/// Time in which one letter of a message is read at leisure, s.
const LETTER_DURATION_S: f64 = 0.07;
/// Distance of the message from the edges of the sea, points.
const MARGIN_POINTS: f32 = 16.0;
/// Largest width of the text of a message, points.
const MAX_WIDTH_POINTS: f32 = 420.0;

/// A message for the user over the sea, and the time on egui's clock at which it disappears.
pub struct Message {
    /// Text of the message, one sentence.
    pub text: String,
    /// Time at which the message disappears, s on egui's clock. The first frame that shows the message sets it.
    end_s: Option<f64>,
    /// Coast, depth and camera that the button Undo beside the message restores; no button without them.
    undo: Option<Box<PlaceBefore>>,
}

/// Where the sea was before another coast was chosen.
#[derive(Clone)]
pub struct PlaceBefore {
    pub coast: Coast,
    pub depth_m: f64,
    pub camera: Camera,
}

impl App {
    /// Shows a message over the sea for a few seconds.
    pub(super) fn show_brief_message(&mut self, text: &str) {
        self.message = Some(Message { text: text.to_owned(), end_s: None, undo: None });
        self.ctx.request_repaint();
    }

    /// Shows a message over the sea with a button that returns to `before`.
    pub(super) fn show_message_with_undo(&mut self, text: String, before: PlaceBefore) {
        self.message = Some(Message { text, end_s: None, undo: Some(Box::new(before)) });
        self.ctx.request_repaint();
    }

    /// Draws the current message, and removes it when its time is over.
    pub(super) fn draw_message(&mut self, ctx: &egui::Context) {
        // A brief message, such as that a link was copied, takes the place for its time.
        if self.picture_job.is_some() && self.message.is_none() {
            self.area("picture", ctx).show(ctx, |ui| {
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
        let (area, free) = (self.area("said", ctx), self.part_for_messages(ctx));
        let Some(message) = &mut self.message else { return };
        let now_s = ctx.input(|i| i.time);
        let least_s = if message.undo.is_some() { BUTTON_DURATION_S } else { MESSAGE_DURATION_S };
        let duration_s = least_s.max(LETTER_DURATION_S * message.text.chars().count() as f64);
        let end_s = *message.end_s.get_or_insert(now_s + duration_s);
        if now_s > end_s {
            self.message = None;
            return;
        }
        ctx.request_repaint_after(Duration::from_secs_f64(end_s - now_s));
        let has_button = message.undo.is_some();
        let shown = area.interactable(has_button).show(ctx, |ui| {
            ui.set_max_width((free.width() - 24.0).clamp(80.0, MAX_WIDTH_POINTS));
            let label = egui::Label::new(&message.text).wrap();
            let frame = egui::Frame::window(ui.style()).show(ui, |ui| {
                ui.add(label);
                has_button && with_accessible_name(ui.button(tr("Undo")), tr("Back to the sea before")).clicked()
            });
            frame.inner
        });
        if shown.inner
            && let Some(before) = self.message.take().and_then(|message| message.undo)
        {
            self.params.coast = before.coast;
            self.params.sea.depth_m = before.depth_m;
            self.params.camera = before.camera;
            self.restarts_foam = true;
        }
    }

    /// The part of the window in which messages appear: the sea that neither a panel nor a hint at its lower edge
    /// covers.
    fn part_for_messages(&self, ctx: &egui::Context) -> egui::Rect {
        let has_panel = self.params.screen.interface == Interface::Panel;
        let mut free = if has_panel { panel::free_part(self, ctx) } else { ctx.content_rect() };
        let hint = ctx.memory(|m| m.area_rect(egui::Id::unique("first steps")));
        if let Some(hint) = hint.filter(|hint| self.visitor.first_steps.is_shown() && hint.top() > free.center().y) {
            free.set_bottom(hint.top().min(free.bottom()));
        }
        free.shrink(MARGIN_POINTS)
    }

    /// The area called `name` of a message: at the lower edge of the sea, away from the sea in words; without the panel
    /// at the upper edge, away from captions.
    fn area(&self, name: &'static str, ctx: &egui::Context) -> egui::Area {
        let area = egui::Area::new(egui::Id::unique(name)).order(egui::Order::Foreground);
        let has_panel = self.params.screen.interface == Interface::Panel;
        let side = if has_panel { egui::Align2::CENTER_BOTTOM } else { egui::Align2::CENTER_TOP };
        area.anchor(side, egui::Vec2::ZERO).constrain_to(self.part_for_messages(ctx))
    }
}
