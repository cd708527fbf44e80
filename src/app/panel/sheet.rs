//! The sheet of a narrow window, above the bar of tabs: closed, a third of the window, or nearly all of it. Its handle
//! is dragged, tapped or moved by keys, and the sea is drawn in what is left above it.

use super::super::accessible_names::with_accessible_name;
use super::super::{App, icons};
use super::handle::Handle;
use super::{TOUCH_TARGET_POINTS, wind};
use super::{Tab, enlarge_for_touch, has_room, is_narrow, show_action_buttons, show_notices, show_tab, show_tabs};
use crate::app::language::tr;
use egui::Key;

/// Height of the handle, points.
const HANDLE_POINTS: f32 = 26.0;
/// Height of the wind's bar, of the slider in it, and size of the letters of its name, points.
const WIND_BAR_POINTS: f32 = 64.0;
const WIND_SLIDER_POINTS: f32 = 36.0;
const WIND_NAME_TEXT_POINTS: f32 = 12.0;
/// Height of the sea that a sheet of nearly the whole window leaves, points.
const LEAST_SEA_POINTS: f32 = 110.0;
/// Least height of an open sheet without its bars, points.
const LEAST_SHEET_POINTS: f32 = 120.0;
/// Time in which a released sheet covers two thirds of the way to its place, s.
const SNAP_TIME_S: f32 = 0.05;
/// Distance from its place within which the sheet has arrived, points.
const ARRIVED_POINTS: f32 = 1.0;
/// Speed of a finger that throws the sheet to the next height, points/s.
const FLICK_POINTS_PER_S: f32 = 400.0;

/// Height at which the sheet rests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum SheetHeight {
    /// Only the bars are seen: handle, wind and tabs.
    #[default]
    Closed,
    /// A third of the window, at most so much that the sea keeps half of it.
    Third,
    /// All but a strip of sea.
    Full,
}

impl SheetHeight {
    const ALL: [Self; 3] = [Self::Closed, Self::Third, Self::Full];

    /// Height of the sheet without its bars, which are `bars` high, in a window of the height `window`, all in points.
    fn points(self, window: f32, bars: f32) -> f32 {
        let third = (window / 3.0).min(window / 2.0 - bars).max(LEAST_SHEET_POINTS);
        match self {
            Self::Closed => 0.0,
            Self::Third => third,
            Self::Full => (window - bars - LEAST_SEA_POINTS).max(third),
        }
    }

    /// The height at which a sheet comes to rest that is released at `shown` points, while the finger moves upwards by
    /// `speed` points/s: the nearest one, or the next one in the direction of a fast finger. The heights are `at`.
    fn after_release(shown: f32, speed: f32, at: impl Fn(Self) -> f32) -> Self {
        let nearest = || {
            let far = |height: &Self| (at(*height) - shown).abs();
            Self::ALL.into_iter().min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or_default()
        };
        if speed > FLICK_POINTS_PER_S {
            Self::ALL.into_iter().find(|height| at(*height) > shown).unwrap_or(Self::Full)
        } else if speed < -FLICK_POINTS_PER_S {
            Self::ALL.into_iter().rev().find(|height| at(*height) < shown).unwrap_or_default()
        } else {
            nearest()
        }
    }
}

/// State of the sheet. Whether it is open follows from the open tab.
#[derive(Debug, Default)]
pub struct Sheet {
    /// Whether an open sheet takes nearly the whole window instead of a third.
    is_full: bool,
    /// Height that is shown, without the bars, points.
    shown_points: f32,
    is_dragged: bool,
    is_moving: bool,
    /// The tab that was open last. It stays visible while the sheet closes, and opens again.
    last_tab: Tab,
}

impl Sheet {
    /// Whether the sheet is dragged or on its way to its place, so that the picture changes its size with each frame.
    pub fn is_moving(&self) -> bool {
        self.is_moving
    }

    /// Moves the shown height towards `target` points for `dt_s` seconds, or at once if nothing is animated. Returns
    /// whether it has not arrived.
    fn approach(&mut self, target: f32, dt_s: f32, is_animated: bool) -> bool {
        let left = (target - self.shown_points) * (-dt_s / SNAP_TIME_S).exp();
        self.shown_points = if is_animated && left.abs() > ARRIVED_POINTS { target - left } else { target };
        self.shown_points != target
    }
}

/// Shows the bar of tabs and the sheet of a narrow window, before the sea takes the rest of `ui`: the sea is drawn
/// above the sheet, so that all of it stays visible.
pub fn show_bottom_sheet(app: &mut App, ui: &mut egui::Ui) {
    let ctx = ui.ctx().clone();
    if !(is_narrow(&ctx) && has_room(&ctx)) {
        return;
    }
    // The colour of the bars goes on under a notch or the system's own bar, their contents keep away.
    let (content, window) = (ctx.content_rect(), ctx.viewport_rect());
    let safe = egui::Margin {
        left: (content.left() - window.left()) as i8,
        right: (window.right() - content.right()) as i8,
        top: 0,
        bottom: 0,
    };
    let bar = |x: i8, y: i8| {
        let margin = safe + egui::Margin::symmetric(x, y);
        egui::Frame::new().fill(ui.visuals().window_fill).inner_margin(margin)
    };
    let (tabs, body) = (bar(8, 4), bar(14, 0));
    let tabs = tabs.inner_margin(
        tabs.inner_margin + egui::Margin { bottom: (window.bottom() - content.bottom()) as i8, ..egui::Margin::ZERO },
    );
    let panel = |name: &'static str| egui::Panel::bottom(name).resizable(false).show_separator_line(false);
    let before = window.height();
    panel("tabs").frame(tabs).show(ui, |ui| show_tabs(app, ui));
    panel("actions").frame(body).show(ui, |ui| {
        enlarge_for_touch(ui);
        if app.panel.open_tab(true).is_some() { show_action_buttons(app, ui) } else { show_wind_bar(app, ui) }
    });
    let bars = before - ui.available_height() + HANDLE_POINTS - (window.bottom() - content.bottom());
    let at = |height: SheetHeight| height.points(content.height(), bars);
    move_sheet(app, &ctx, at);
    if app.panel.sheet.shown_points > 0.0 {
        let tab = app.panel.open_tab(true).unwrap_or(app.panel.sheet.last_tab);
        panel("sheet").frame(body).exact_size(app.panel.sheet.shown_points).show(ui, |ui| {
            enlarge_for_touch(ui);
            egui::ScrollArea::vertical().id_salt(tab).auto_shrink(false).show(ui, |ui| {
                show_notices(app, ui);
                show_tab(app, tab, ui);
            });
        });
    }
    panel("handle").frame(body).exact_size(HANDLE_POINTS).show(ui, |ui| show_handle(app, at, ui));
}

/// Adds the controls that a closed sheet leaves in reach of a thumb: the button of the time, and the wind with its
/// name.
fn show_wind_bar(app: &mut App, ui: &mut egui::Ui) {
    ui.horizontal_top(|ui| {
        let clock = &mut app.params.clock;
        let (icon, name) = if clock.paused { (icons::PLAY, tr("Play")) } else { (icons::PAUSE, tr("Pause")) };
        let button = egui::Button::new(egui::RichText::new(icon).size(17.0)).frame_when_inactive(false);
        let button = button.min_size(egui::vec2(TOUCH_TARGET_POINTS, WIND_BAR_POINTS));
        if with_accessible_name(ui.add(button), name).clicked() {
            clock.paused = !clock.paused;
        }
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.label(egui::RichText::new(wind::wind_in_words(app)).size(WIND_NAME_TEXT_POINTS));
            // Name, slider and marks together are high enough for a thumb.
            ui.spacing_mut().interact_size.y = WIND_SLIDER_POINTS;
            wind::show_force_slider(app, ui);
        });
    });
}

/// Brings the sheet nearer to the height of what is open, unless a finger holds it.
fn move_sheet(app: &mut App, ctx: &egui::Context, at: impl Fn(SheetHeight) -> f32) {
    let open = app.panel.open_tab(true);
    let sheet = &mut app.panel.sheet;
    sheet.last_tab = open.unwrap_or(sheet.last_tab);
    if sheet.is_dragged {
        // A window that has become smaller meanwhile.
        sheet.shown_points = sheet.shown_points.min(at(SheetHeight::Full));
        sheet.is_moving = true;
        return;
    }
    let target = at(sheet.height(open.is_some()));
    let is_animated = ctx.global_style().animation_time > 0.0;
    sheet.is_moving = sheet.approach(target, ctx.input(|i| i.stable_dt).min(0.05), is_animated);
    if sheet.is_moving {
        ctx.request_repaint();
    }
}

impl Sheet {
    fn height(&self, is_open: bool) -> SheetHeight {
        match (is_open, self.is_full) {
            (false, _) => SheetHeight::Closed,
            (true, false) => SheetHeight::Third,
            (true, true) => SheetHeight::Full,
        }
    }
}

/// Adds the handle above the sheet. A drag moves the sheet, a tap opens it further, or closes it if it is at its
/// highest, and arrow keys change its height.
fn show_handle(app: &mut App, at: impl Fn(SheetHeight) -> f32, ui: &mut egui::Ui) {
    let open = app.panel.open_tab(true).is_some();
    let height = app.panel.sheet.height(open);
    let handle = Handle {
        name: tr("Height of the sheet"),
        help: tr("Drag, or press the arrow keys: closed, a third of the window, or nearly all of it."),
        value: f64::from(height as u8),
        range: [0.0, 2.0],
        step: 1.0,
        keys: [Key::ArrowDown, Key::ArrowUp],
        lies: true,
        cursor: egui::CursorIcon::ResizeVertical,
    };
    let (rect, _) = ui.allocate_exact_size(ui.available_size(), egui::Sense::hover());
    let (response, chosen) = handle.show(ui, rect, egui::Id::unique("handle of the sheet"));
    let mut chosen = chosen.map(|value| SheetHeight::ALL[value.round() as usize]);
    if response.clicked() {
        chosen =
            Some(if height == SheetHeight::Full { SheetHeight::Closed } else { SheetHeight::ALL[height as usize + 1] });
    }
    if response.dragged() {
        if !open {
            app.panel.open(app.panel.sheet.last_tab);
        }
        let sheet = &mut app.panel.sheet;
        let shown = sheet.shown_points - response.drag_delta().y;
        (sheet.shown_points, sheet.is_dragged) = (shown.clamp(0.0, at(SheetHeight::Full)), true);
    } else if std::mem::take(&mut app.panel.sheet.is_dragged) {
        let speed = -ui.input(|i| i.pointer.velocity().y);
        chosen = Some(SheetHeight::after_release(app.panel.sheet.shown_points, speed, at));
    }
    let Some(chosen) = chosen else { return };
    app.panel.sheet.is_full = chosen == SheetHeight::Full;
    if chosen == SheetHeight::Closed {
        app.panel.close();
    } else {
        let tab = app.panel.open_tab(true).unwrap_or(app.panel.sheet.last_tab);
        app.panel.open(tab);
    }
    ui.ctx().request_repaint();
}

#[cfg(test)]
mod tests {
    use super::*;

    const BARS: f32 = 134.0;

    fn at(height: SheetHeight) -> f32 {
        height.points(844.0, BARS)
    }

    #[test]
    fn the_sea_keeps_half_of_a_phone_and_a_strip() {
        for window in [640.0, 844.0, 932.0_f32] {
            let sea = |height: SheetHeight| window - BARS - height.points(window, BARS);
            assert!(sea(SheetHeight::Third) >= window / 2.0 - 0.01, "{window}");
            assert!((sea(SheetHeight::Full) - LEAST_SEA_POINTS).abs() < 0.01, "{window}");
        }
        // In a window without room for all, the heights keep their order.
        for window in [100.0, 250.0, 400.0] {
            let [closed, third, full] = SheetHeight::ALL.map(|height| height.points(window, BARS));
            assert!(closed < third && third <= full, "{window}: {closed} {third} {full}");
        }
    }

    #[test]
    fn a_released_sheet_goes_to_the_nearest_height_or_where_it_is_thrown() {
        use SheetHeight::{Closed, Full, Third};
        let [third, full] = [Third, Full].map(at);
        let cases = [
            (0.4 * third, 0.0, Closed),
            (0.6 * third, 0.0, Third),
            (0.9 * full, 100.0, Full),
            // A fast finger decides: up to the next height, down to the one below.
            (0.1 * third, 900.0, Third),
            (third + 5.0, 900.0, Full),
            (third + 5.0, -900.0, Third),
            (third - 5.0, -900.0, Closed),
            (full, 900.0, Full),
            (0.0, -900.0, Closed),
        ];
        for (shown, speed, want) in cases {
            assert_eq!(SheetHeight::after_release(shown, speed, at), want, "{shown} {speed}");
        }
    }

    #[test]
    fn the_sheet_arrives_within_half_a_second_and_at_once_without_animation() {
        let mut sheet = Sheet::default();
        let frames = (0..60).take_while(|_| sheet.approach(300.0, 1.0 / 60.0, true)).count();
        assert!((5..30).contains(&frames) && sheet.shown_points == 300.0, "{frames} frames, {sheet:?}");
        assert!(!sheet.approach(0.0, 1.0 / 60.0, false) && sheet.shown_points == 0.0);
    }
}
