//! The first steps: four hints for who opens the program for the first time. Each ends by itself when the visitor does
//! what it says, or by a button; whoever has seen or skipped them never sees them again.

use super::accessible_names::with_accessible_name;
use super::{App, panel};
use crate::app::language::{say, text, tr};
use crate::state::params::{Camera, Interface};

/// Wind speed from which a sea counts as a storm in these hints, m/s: force 8, a gale.
const STORM_WIND_M_S: f64 = 17.2;
/// Turn of the view that counts as having looked around, degrees.
const LOOK_DEG: f64 = 3.0;
/// Move of the camera that counts as having looked around, m.
const LOOK_M: f64 = 2.0;
/// Largest width of a hint, points.
const CARD_WIDTH_POINTS: f32 = 260.0;
/// Least width of the free part of the sea in which a hint is shown, points.
const LEAST_WIDTH_POINTS: f32 = 170.0;
/// Distance of a hint from what it speaks of and from the edges of the sea, points.
const GAP_POINTS: f32 = 14.0;

/// What a hint speaks of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    Look,
    Wind,
    Storm,
    Share,
}

impl Step {
    const ALL: [Self; 4] = [Self::Look, Self::Wind, Self::Storm, Self::Share];

    /// Title and explanation.
    fn texts(self) -> [&'static str; 2] {
        match self {
            Self::Look => [text!("Drag to look around"), text!("The wheel or two fingers zoom.")],
            Self::Wind => {
                [text!("Change the wind"), text!("Open Weather and move the slider: the waves follow the wind.")]
            }
            Self::Storm => [
                text!("Try a storm"),
                text!("Open Seas and choose the gale or the hurricane, or raise the wind to force 8 or more."),
            ],
            Self::Share => {
                [text!("Share it"), text!("Under Share you find a link to this very sea, a picture and a film.")]
            }
        }
    }
}

/// The hint that is shown, and what the visitor saw when it appeared; nothing if there is no hint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FirstSteps(Option<(Step, Seen)>);

/// What a step must change.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    camera: Camera,
    wind_m_s: f64,
}

impl FirstSteps {
    /// Whether a hint is to be shown.
    pub fn is_shown(&self) -> bool {
        self.0.is_some()
    }
}

impl App {
    /// Begins the first steps, unless the visitor knows them.
    pub fn offer_first_steps(&mut self) {
        if !self.visitor.preferences.knows_first_steps {
            self.begin_step(Step::Look);
        }
    }

    fn begin_step(&mut self, step: Step) {
        let wind_m_s = self.params.sea.first_system().wind_m_s;
        self.visitor.first_steps = FirstSteps(Some((step, Seen { camera: self.params.camera.clone(), wind_m_s })));
        self.ctx.request_repaint();
    }

    /// Ends the first steps for good.
    pub(super) fn end_first_steps(&mut self) {
        self.visitor.first_steps = FirstSteps::default();
        self.change_preferences(|preferences| preferences.knows_first_steps = true);
    }

    /// Goes on to the step after `step`; after the last one the first steps are over.
    fn go_on_after(&mut self, step: Step) {
        let next = Step::ALL.iter().skip_while(|s| **s != step).nth(1);
        match next {
            Some(next) => self.begin_step(*next),
            None => self.end_first_steps(),
        }
    }

    /// Whether the visitor has done what the step `step` says.
    fn has_done(&self, step: Step, seen: &Seen) -> bool {
        let (camera, before) = (&self.params.camera, &seen.camera);
        let wind_m_s = self.params.sea.first_system().wind_m_s;
        match step {
            Step::Look => {
                let turn_deg = (camera.heading_deg - before.heading_deg + 180.0).rem_euclid(360.0) - 180.0;
                let moved_m = (camera.x_m - before.x_m).hypot(camera.z_m - before.z_m);
                turn_deg.hypot(camera.pitch_deg - before.pitch_deg) > LOOK_DEG || moved_m > LOOK_M
            }
            Step::Wind => wind_m_s != seen.wind_m_s,
            Step::Storm => wind_m_s >= STORM_WIND_M_S,
            Step::Share => self.panel.shows_sharing(&self.ctx),
        }
    }

    /// Shows the hint of the current step near what it speaks of, in the part `sea` of the window that shows the sea.
    pub(super) fn show_first_steps(&mut self, sea: egui::Rect, ctx: &egui::Context) {
        let Some((step, seen)) = self.visitor.first_steps.0.clone() else { return };
        if self.params.screen.interface != Interface::Panel || self.help_is_open {
            return;
        }
        // Whoever still drags is not disturbed by the next hint.
        if self.has_done(step, &seen) && !ctx.input(|i| i.pointer.any_down()) {
            self.go_on_after(step);
            return;
        }
        let target = match step {
            Step::Look => None,
            Step::Wind => self.panel.weather_tab(),
            Step::Storm => self.panel.seas_tab(),
            Step::Share => self.panel.share_tab(),
        };
        let free = panel::part_beside_panel(sea, ctx);
        if free.width() < LEAST_WIDTH_POINTS {
            return;
        }
        if let Some(target) = target {
            let stroke = egui::Stroke::new(2.0, egui::Color32::from_rgb(120, 200, 235));
            let layer = egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("first step's place"));
            ctx.layer_painter(layer).rect_stroke(target, 8.0, stroke, egui::StrokeKind::Outside);
        }
        let id = egui::Id::unique("first steps");
        let width = CARD_WIDTH_POINTS.min(free.width() - 2.0 * GAP_POINTS);
        let size = ctx.memory(|m| m.area_rect(id)).map_or(egui::vec2(width + 28.0, 150.0), |rect| rect.size());
        let summary = ctx.memory(|m| m.area_rect(egui::Id::unique("summary")));
        let Some(at) = place_of_card(size, free, target, summary) else { return };
        let answer = egui::Area::new(id).fixed_pos(at).order(egui::Order::Foreground).show(ctx, |ui| {
            let frame = egui::Frame::window(ui.style()).inner_margin(egui::Margin::symmetric(14, 10));
            frame.show(ui, |ui| show_card(step, width - 28.0, ui)).inner
        });
        match answer.inner {
            Some(Answer::Next) => self.go_on_after(step),
            Some(Answer::Skip) => self.end_first_steps(),
            None => {}
        }
    }
}

/// Upper left corner of a hint of this size in the `free` part of the sea: beside its target if that is beside the sea,
/// else at the lower edge, above the target. It does not cover the sea in words (`summary`); `None` if it has no room.
fn place_of_card(
    size: egui::Vec2,
    free: egui::Rect,
    target: Option<egui::Rect>,
    summary: Option<egui::Rect>,
) -> Option<egui::Pos2> {
    let room = free.shrink(GAP_POINTS);
    let middle = target.filter(|t| t.top() >= free.bottom()).map_or(free.center().x, |t| t.center().x);
    let beside = target.filter(|t| t.center().y < free.bottom());
    let x = match beside {
        Some(t) if t.center().x > free.center().x => room.right() - size.x,
        Some(_) => room.left(),
        None => middle - 0.5 * size.x,
    };
    let x = x.min(room.right() - size.x).max(room.left());
    let y = beside.map_or(room.bottom() - size.y, |t| t.top().max(room.top()));
    let mut card = egui::Rect::from_min_size(egui::pos2(x, y), size);
    if let Some(summary) = summary.filter(|s| s.intersects(card)) {
        card = card.translate(egui::vec2(0.0, summary.bottom() + 8.0 - card.top()));
    }
    (card.top() >= free.top() && card.bottom() <= free.bottom()).then_some(card.min)
}

/// What the visitor answers to a hint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Answer {
    Next,
    Skip,
}

/// Adds the texts and the buttons of a hint that is `width` points wide.
fn show_card(step: Step, width: f32, ui: &mut egui::Ui) -> Option<Answer> {
    ui.set_width(width);
    let number = 1 + Step::ALL.iter().position(|s| *s == step).unwrap_or_default();
    let [title, explanation] = step.texts();
    ui.add(egui::Label::new(egui::RichText::new(tr(title)).size(17.0).strong()).wrap());
    ui.add(egui::Label::new(tr(explanation)).wrap());
    ui.add_space(4.0);
    let mut answer = None;
    if panel::touch::is_used(ui.ctx()) {
        ui.spacing_mut().interact_size.y = panel::TOUCH_TARGET_POINTS;
    }
    ui.horizontal(|ui| {
        let is_last = number == Step::ALL.len();
        if ui.button(if is_last { tr("Done") } else { tr("Next") }).clicked() {
            answer = Some(Answer::Next);
        }
        if !is_last {
            let skip = ui.add(egui::Button::new(tr("Skip")).frame_when_inactive(false));
            if with_accessible_name(skip, tr("Skip the hints")).clicked() {
                answer = Some(Answer::Skip);
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.weak(say!("{number} of {count}", number = number, count = Step::ALL.len()));
        });
    });
    answer
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hint_covers_neither_the_sea_in_words_nor_the_panel() {
        let rect = |x: f32, y: f32, w: f32, h: f32| egui::Rect::from_min_size(egui::pos2(x, y), egui::vec2(w, h));
        let size = egui::vec2(260.0, 130.0);
        let summary = rect(12.0, 12.0, 340.0, 120.0);
        // A wide window: beside the tabs; in a shorter one below the sea in words.
        let tab = rect(920.0, 24.0, 70.0, 52.0);
        let at = place_of_card(size, rect(0.0, 0.0, 870.0, 720.0), Some(tab), Some(summary)).expect("room");
        assert_eq!(at, egui::pos2(870.0 - GAP_POINTS - 260.0, 24.0));
        let tab = rect(480.0, 24.0, 70.0, 52.0);
        let at = place_of_card(size, rect(0.0, 0.0, 430.0, 390.0), Some(tab), Some(summary)).expect("room");
        assert!(at.y >= summary.bottom() && at.y + size.y <= 390.0, "{at}");
        // A phone: above the bar of tabs, within the window.
        let free = rect(0.0, 0.0, 390.0, 784.0);
        for x in [4.0, 160.0, 310.0] {
            let at = place_of_card(size, free, Some(rect(x, 788.0, 70.0, 52.0)), Some(summary)).expect("room");
            assert!(at.x >= 0.0 && at.x + size.x <= 390.0 && at.y + size.y <= 784.0, "{at}");
        }
        assert_eq!(place_of_card(size, rect(0.0, 0.0, 390.0, 240.0), None, Some(summary)), None, "no room");
    }
}
