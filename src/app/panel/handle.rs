//! Handles of the panel: short bars that are dragged by a finger or a mouse, moved by arrow keys, and that screen
//! readers meet as sliders.

use egui::accesskit::{Action, ActionData};
use egui::{EventFilter, Key};

/// Length and thickness of the bar that is drawn, points.
const BAR_POINTS: [f32; 2] = [36.0, 4.0];

/// A handle that has whole numbers as its places.
pub struct Handle<'a> {
    /// Accessible name.
    pub name: &'a str,
    /// Explanation that a mouse gets.
    pub help: &'a str,
    /// Place where the handle is.
    pub value: f64,
    /// Least and greatest place.
    pub range: [f64; 2],
    /// Distance of two places that one press of a key passes.
    pub step: f64,
    /// Keys that go to the next smaller and to the next greater place.
    pub keys: [Key; 2],
    /// Whether the bar lies, instead of standing upright.
    pub lies: bool,
    /// Pointer over the handle.
    pub cursor: egui::CursorIcon,
}

impl Handle<'_> {
    /// Adds the handle in `rect`. Returns egui's response, whose drags and clicks are the caller's, and the place that the
    /// keyboard or a screen reader has chosen.
    pub fn show(&self, ui: &egui::Ui, rect: egui::Rect, id: egui::Id) -> (egui::Response, Option<f64>) {
        let response = ui.interact(rect, id, egui::Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::slider(true, self.value, self.name));
        let [least, greatest] = self.range;
        ui.ctx().accesskit_node_builder(id, |node| {
            node.set_min_numeric_value(least);
            node.set_max_numeric_value(greatest);
            node.set_numeric_value_step(self.step);
            for action in [Action::SetValue, Action::Increment, Action::Decrement] {
                node.add_action(action);
            }
        });
        self.paint(ui, &response);
        let chosen = self.chosen(ui, &response).map(|value| value.clamp(least, greatest));
        (response.on_hover_cursor(self.cursor).on_hover_text(self.help), chosen)
    }

    /// The place that the keyboard or a screen reader has chosen in this frame; `None` if neither has.
    fn chosen(&self, ui: &egui::Ui, response: &egui::Response) -> Option<f64> {
        // Asked before the input is locked for reading.
        let has_focus = response.has_focus();
        if has_focus {
            let vertical_arrows = self.keys.contains(&Key::ArrowUp);
            let filter = EventFilter { vertical_arrows, horizontal_arrows: !vertical_arrows, ..EventFilter::default() };
            ui.memory_mut(|m| m.set_focus_lock_filter(response.id, filter));
        }
        ui.input(|i| {
            let set = i.accesskit_action_requests(response.id, Action::SetValue).find_map(|asked| match asked.data {
                Some(ActionData::NumericValue(value)) => Some(value),
                _ => None,
            });
            let asked = |action| i.num_accesskit_action_requests(response.id, action);
            let pressed = |key| if has_focus { i.num_presses(key) } else { 0 };
            let less = asked(Action::Decrement) + pressed(self.keys[0]);
            let more = asked(Action::Increment) + pressed(self.keys[1]);
            let stepped = (less != more).then_some(self.value + self.step * (more as f64 - less as f64));
            set.or(stepped)
        })
    }

    /// Draws the bar, and a frame around a handle with the keyboard.
    fn paint(&self, ui: &egui::Ui, response: &egui::Response) {
        let visuals = ui.style().interact(response);
        let [length, thickness] = BAR_POINTS;
        let size = if self.lies { [length, thickness] } else { [thickness, length] };
        let bar = egui::Rect::from_center_size(response.rect.center(), size.into());
        ui.painter().rect_filled(bar, 2.0, visuals.fg_stroke.color.gamma_multiply(0.7));
        if response.has_focus() {
            let stroke = ui.visuals().selection.stroke;
            ui.painter().rect_stroke(response.rect.shrink(2.0), 4.0, stroke, egui::StrokeKind::Inside);
        }
    }
}
