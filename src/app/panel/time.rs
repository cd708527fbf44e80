//! Controls of the simulated time: stop, step, speed, slider and typed time.

use super::super::accessible_names::{with_accessible_name, with_accessible_value};
use super::super::{App, icons};
use super::{button_with_help, sun};
use crate::app::language::tr;
use crate::state::params::Clock;

/// Time by which one press of a step button moves the stopped clock, s: one frame at 60 Hz.
const FRAME_STEP_S: f64 = 1.0 / 60.0;
/// Length of the interval that the time slider covers, s, if the sea does not repeat after a loop; else it covers one
/// loop.
const SLIDER_RANGE_S: f64 = 120.0;

/// Adds the buttons, the slider and the number fields for the simulated time and its speed.
pub fn show_time_controls(app: &mut App, ui: &mut egui::Ui) {
    let loop_s = app.params.sea.repeat_period_s;
    let clock = &mut app.params.clock;
    ui.horizontal_wrapped(|ui| {
        if button_with_help(ui, if clock.paused { tr("Play") } else { tr("Pause") }, tr("Space")) {
            clock.paused = !clock.paused;
        }
        let icon = |ui: &mut egui::Ui, icon: &str, name: &str, help: &str| {
            let width = ui.spacing().interact_size.y.max(28.0);
            let button = egui::Button::new(egui::RichText::new(icon).size(16.0)).min_size(egui::vec2(width, 0.0));
            with_accessible_name(ui.add(button).on_hover_text(help), name).clicked()
        };
        if icon(ui, icons::TO_START, tr("Back to time 0"), tr("Back to time 0 (Home)")) {
            clock.t_s = 0.0;
        }
        if icon(ui, icons::STEP_BACK, tr("One frame back"), tr("One frame back (,)")) {
            step_clock(clock, -1.0);
        }
        if icon(ui, icons::STEP_FORWARD, tr("One frame forward"), tr("One frame forward (.)")) {
            step_clock(clock, 1.0);
        }
        let speed = egui::DragValue::new(&mut clock.speed)
            .range(0.0..=10.0)
            .speed(0.02)
            .prefix(format!("{} ", tr("speed")))
            .suffix("x");
        ui.add(speed).on_hover_text(tr("Simulated seconds per second."));
    });
    ui.horizontal(|ui| {
        // The slider covers the loop, or the interval of SLIDER_RANGE_S, that contains the current time.
        let length = if loop_s > 0.0 { loop_s } else { SLIDER_RANGE_S };
        let from = length * (clock.t_s / length).floor();
        ui.spacing_mut().slider_width = (ui.available_width() - 120.0).max(80.0);
        let mut t = clock.t_s;
        let slider = egui::Slider::new(&mut t, from..=from + length).show_value(false).step_by(0.0);
        if with_accessible_value(ui.add(slider), tr("Time"), t)
            .on_hover_text(tr("Drag through the time; it stands still meanwhile."))
            .changed()
        {
            clock.t_s = t;
            clock.paused = true;
        }
        let t_s = clock.t_s;
        let exact = egui::DragValue::new(&mut clock.t_s)
            .range(0.0..=1e7)
            .speed(0.1)
            .prefix("t = ")
            .suffix(" s")
            .max_decimals(2);
        with_accessible_value(ui.add(exact), tr("Time in seconds"), t_s)
            .on_hover_text(tr("Simulated time: type where to go."));
    });
    sun::show_time_lapse(app, ui);
}

/// Stops the clock, and moves the simulated time forward by `frames` frames of 1/60 s (back if negative).
pub fn step_clock(clock: &mut Clock, frames: f64) {
    clock.paused = true;
    // The time is a whole number of frames, so that steps forward and back return to the same time.
    clock.t_s = ((clock.t_s / FRAME_STEP_S).round() + frames).max(0.0) * FRAME_STEP_S;
}
