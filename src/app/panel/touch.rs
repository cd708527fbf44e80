//! Touch in the panel: whether fingers are used, and sliders that leave scrolling to the panel.

/// Distance that a finger moves sideways at least in a swipe, points.
const SWIPE_DISTANCE_POINTS: f32 = 48.0;
/// Distance that a finger moves before its direction is judged, points.
const DIRECTION_DISTANCE_POINTS: f32 = 8.0;

fn touch_id() -> egui::Id {
    egui::Id::unique("fingers are used")
}

/// Whether fingers are used: in a narrow window, or since the first touch. Until the program ends the answer stays: rows
/// that grow only under a finger would jump away from it.
pub fn is_used(ctx: &egui::Context) -> bool {
    super::is_narrow(ctx) || ctx.data(|d| d.get_temp::<bool>(touch_id())).unwrap_or_default()
}

/// Notes a touch of this frame, once the finger is lifted.
pub fn note(ctx: &egui::Context) {
    let is_lifted =
        ctx.input(|i| i.events.iter().any(|e| matches!(e, egui::Event::Touch { phase: egui::TouchPhase::End, .. })));
    if is_lifted {
        remember(ctx);
    }
}

/// Remembers that fingers are used.
pub fn remember(ctx: &egui::Context) {
    ctx.data_mut(|d| d.insert_temp(touch_id(), true));
}

/// A finger on a slider: where it came down, and whether it then moved sideways, as soon as that is known.
#[derive(Clone, Copy)]
struct FingerOnSlider {
    origin: egui::Pos2,
    is_sideways: Option<bool>,
}

/// Gives a slider's `value` back its value `before`, as long as the finger that came down on the slider may want to
/// scroll the panel. A drag sideways moves the slider, a drag up or down scrolls, a tap sets the value.
pub fn keep_value_while_scrolling(ui: &egui::Ui, response: &egui::Response, value: &mut f64, before: f64) {
    let id = response.id.with("finger");
    let known = ui.data(|d| d.get_temp::<FingerOnSlider>(id));
    let is_down = response.is_pointer_button_down_on();
    if known.is_none() && !(is_down && ui.input(|i| i.any_touches())) {
        return;
    }
    let Some(at) = response.interact_pointer_pos().filter(|_| is_down) else {
        ui.data_mut(|d| d.remove::<FingerOnSlider>(id));
        let scrolled = known.is_some_and(|finger| finger.is_sideways == Some(false));
        if scrolled {
            *value = before;
        }
        return;
    };
    let mut finger = known.unwrap_or(FingerOnSlider { origin: at, is_sideways: None });
    let moved = at - finger.origin;
    if finger.is_sideways.is_none() && moved.length() > DIRECTION_DISTANCE_POINTS {
        finger.is_sideways = Some(moved.x.abs() > moved.y.abs());
    }
    ui.data_mut(|d| d.insert_temp(id, finger));
    if finger.is_sideways != Some(true) {
        *value = before;
    }
    if finger.is_sideways == Some(false) {
        let down = ui.input(|i| i.pointer.delta().y);
        ui.scroll_with_delta_animation(egui::vec2(0.0, down), egui::style::ScrollAnimation::none());
    }
}

/// Which way a swipe sideways that began in `area` and has just ended asks to go: 1 to the next one (a swipe to the left),
/// -1 to the one before. `None` if no such swipe has ended in this frame.
pub fn swiped_sideways(ui: &egui::Ui, area: egui::Rect) -> Option<isize> {
    let id = ui.scope_id().with("swipe");
    let (origin, at) = ui.input(|i| (i.pointer.press_origin(), i.pointer.latest_pos()));
    if ui.input(|i| i.pointer.primary_down()) {
        let (origin, at) = (origin?, at?);
        let begins_here = area.intersect(ui.clip_rect()).contains(origin);
        if begins_here && ui.ctx().layer_id_at(origin) == Some(ui.layer_id()) {
            ui.data_mut(|d| d.insert_temp(id, at - origin));
        }
        return None;
    }
    let moved = ui.data_mut(|d| d.remove_temp::<egui::Vec2>(id))?;
    let is_swipe = moved.x.abs() >= SWIPE_DISTANCE_POINTS && moved.x.abs() > 2.0 * moved.y.abs();
    is_swipe.then_some(if moved.x < 0.0 { 1 } else { -1 })
}
