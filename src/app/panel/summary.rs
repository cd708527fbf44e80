//! The text over the sea at the top left: wind, waves, time and frame rate.

use super::super::App;
use super::super::derived::SystemSize;
use super::super::units::UnitScale;
use super::weather::compass_point;
use super::{Tab, free_part, has_room};
use crate::app::language::{local_number, say, tr};
use crate::state::params::SpectrumKind;
use crate::waves::beaufort::{self, BEAUFORT_FORCES};

/// Largest width of the text, points.
const MAX_WIDTH_POINTS: f32 = 340.0;
/// Distance of the text from the edges of what is free, points.
const MARGIN_POINTS: f32 = 12.0;

/// One line about the sea for screen readers, such as `Hs 2.4 m, Beaufort 5`: significant wave height and Beaufort
/// number.
#[cfg(target_arch = "wasm32")]
pub fn sea_summary(app: &App) -> String {
    let hs = app.length_scale().format(app.derived.theoretical_statistics.hs_m, 1);
    {
        let force = beaufort::beaufort_number(app.params.sea.first_system().wind_m_s);
        say!("Hs {height}, Beaufort {force}", height = hs, force = force)
    }
}

/// How high and long the waves are; of each wave system, if there are several.
fn waves_in_words(app: &App) -> String {
    let (t, metres) = (&app.derived.theoretical_statistics, app.length_scale());
    let height = metres.format(t.hs_m, 1);
    let systems = &app.derived.systems;
    if systems.len() < 2 {
        return say!(
            "waves {height} high and {length} long, every {period} s",
            height = height,
            length = metres.format(t.lambda_p_m, 0),
            period = format!("{:.0}", t.tp_s)
        );
    }
    let in_words = |system: &SystemSize| {
        say!(
            "{system} {height} high and {length} long",
            system = system_name(system.number),
            height = metres.format(system.hs_m, 1),
            length = metres.format(system.length_m, 0)
        )
    };
    let parts: Vec<String> = systems.iter().map(in_words).collect();
    say!("waves {height} high: {parts}", height = height, parts = parts.join(", "))
}

/// Name of a wave system by its number.
pub fn system_name(number: usize) -> &'static str {
    match number {
        1 => tr("wind sea"),
        2 => tr("swell"),
        3 => tr("second swell"),
        _ => tr("third swell"),
    }
}

/// Shows the sea in words at the top left of the window. A click on a line opens the tab that explains it.
pub fn show_summary(app: &mut App, ctx: &egui::Context) {
    if !has_room(ctx) {
        return;
    }
    let (id, free) = (egui::Id::unique("summary"), free_part(app, ctx).shrink(MARGIN_POINTS));
    // A high sheet leaves no room for the text.
    if ctx.memory(|m| m.area_rect(id)).is_some_and(|last| last.height() > free.height()) {
        return;
    }
    let area = egui::Area::new(id).anchor(egui::Align2::LEFT_TOP, egui::Vec2::ZERO).constrain_to(free);
    let shade = egui::Color32::from_rgba_unmultiplied(8, 16, 24, 120);
    let frame = egui::Frame::new().fill(shade).corner_radius(10.0).inner_margin(egui::Margin::symmetric(12, 8));
    area.show(ctx, |ui| {
        frame.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Wrap);
            ui.set_max_width((free.width() - 24.0).clamp(80.0, MAX_WIDTH_POINTS));
            let wind_m_s = app.params.sea.first_system().wind_m_s;
            let name = BEAUFORT_FORCES[beaufort::beaufort_number(wind_m_s)].name;
            let white = |text: String, points: f32| egui::RichText::new(text).size(points).color(egui::Color32::WHITE);
            let speed = UnitScale::for_unit("m/s", app.params.screen.units);
            let from = compass_point(app.params.sea.first_system().from_deg);
            let wind = if app.params.sea.first_system().spectrum == SpectrumKind::Measured {
                tr("Measured waves").to_owned()
            } else {
                say!("{name}, {speed} from {from}", name = tr(name), speed = speed.format(wind_m_s, 1), from = tr(from))
            };
            let waves = waves_in_words(app);
            let (ms, rate) = (app.quality.frame_ms(), app.quality.frames_per_second());
            let keeps_up = say!(
                "t = {time} s, {ms} ms a frame, {rate} frames/s",
                time = format!("{:.0}", app.params.clock.t_s),
                ms = local_number(format!("{ms:.1}")),
                rate = format!("{rate:.0}")
            );
            let ([width, height], n) = (app.picture_size(), app.params_to_draw().grid.n);
            let pixels = say!("{n} x {n} points, {width} x {height} pixels", n = n, width = width, height = height);
            let quality = app.quality.describe();
            let reduction = app.quality.reduction_in_words(&app.params.grid, &app.params.screen);
            let progress = app.coast_progress();
            let mut line = |ui: &mut egui::Ui, text: egui::RichText, help: &str, tab: Tab| {
                let label = egui::Label::new(text).sense(egui::Sense::click());
                let label = ui.add(label).on_hover_text(help).on_hover_cursor(egui::CursorIcon::PointingHand);
                if label.clicked() {
                    app.panel.open(tab);
                }
            };
            line(
                ui,
                white(wind, 18.0),
                tr("Wind speed 10 m above the sea, and the name of its Beaufort force."),
                Tab::Weather,
            );
            let help = tr("Significant wave height Hs, the mean of the highest third, and period Tp of the peak.");
            line(ui, white(waves, 14.0), help, Tab::Study);
            line(ui, white(keeps_up, 12.0), &say!("Simulated time. Picture: {quality}.", quality = quality), Tab::View);
            if let Some(progress) = progress {
                let help =
                    tr("The depths near the coast turn, grow and break the waves. Until then the open sea is shown.");
                line(ui, white(progress, 12.0), help, Tab::Weather);
            }
            let quiet = |text: String| egui::RichText::new(text).size(11.0).color(egui::Color32::from_gray(220));
            let help = tr("Points of the waves' grids (FFT size n), and pixels of the picture that are computed.");
            line(ui, quiet(pixels), help, Tab::Study);
            if let Some(reduction) = reduction {
                line(ui, quiet(reduction), tr("A slow machine draws fewer pixels; a stopped sea has all."), Tab::Study);
            }
        });
    });
}
