//! The text over the sea at the top left: wind, waves, time and frame rate.

use super::super::App;
use super::super::accessible_names::with_accessible_name;
use super::super::derived::SystemSize;
use super::super::units::UnitScale;
use super::weather::compass_point;
use super::{Tab, free_part, has_room, is_narrow, numbers};
use crate::app::language::{local_number, say, text, tr};
use crate::waves::beaufort::{self, BEAUFORT_FORCES};

/// Largest width of the text, points.
const MAX_WIDTH_POINTS: f32 = 340.0;
/// Size of the letters of the line about frames, points.
const FRAME_LINE_POINTS: f32 = 10.5;
/// Distance of the text from the edges of what is free, points.
const MARGIN_POINTS: f32 = 12.0;

/// One line about the sea for screen readers, such as `Beaufort 5: waves 2.4 m high and 60 m long, every 6 s`.
#[cfg(target_arch = "wasm32")]
pub fn sea_summary(app: &App) -> String {
    let waves = waves_in_words(app);
    if app.has_measured_waves() {
        return format!("{}: {waves}", tr("Measured waves"));
    }
    let force = beaufort::beaufort_number(app.params.sea.first_system().wind_m_s);
    say!("Beaufort {force}: {waves}", force = force, waves = waves)
}

/// How high and long the waves are; of each wave system, if there are several.
fn waves_in_words(app: &App) -> String {
    let (t, metres) = (&app.derived.theoretical_statistics, app.length_scale());
    let height = metres.format(t.hs_m, 1);
    let systems = &app.derived.systems;
    if systems.is_empty() {
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

/// How the heights of several wave systems make that of the sea, in words; `None` if there is only one.
pub fn heights_in_words(app: &App) -> Option<String> {
    let (systems, metres) = (&app.derived.systems, app.length_scale());
    let square = |system: &SystemSize| local_number(format!("{:.1}²", system.hs_m * metres.factor));
    let squares: Vec<String> = systems.iter().map(square).collect();
    (!systems.is_empty()).then(|| {
        say!(
            "The energies of waves add up, so heights add as squares: √({squares}) = {height}",
            squares = squares.join(" + "),
            height = metres.format(app.derived.theoretical_statistics.hs_m, 1)
        )
    })
}

/// Meanings of the height, the period and the length of waves.
pub const MEANINGS: &str = text!(
    "Height: the mean of the highest third of the waves. Period: the time between two crests of the strongest waves. \
     Length: from one of these crests to the next."
);

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
    app.panel.summary_is_shown = false;
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
    app.panel.summary_is_shown = true;
    area.show(ctx, |ui| {
        frame.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Wrap);
            ui.set_max_width((free.width() - 24.0).clamp(80.0, MAX_WIDTH_POINTS));
            for line in lines(app) {
                if show_line(ui, &line.text, line.points, egui::Color32::WHITE, &line.help).clicked() {
                    app.panel.open(line.tab);
                }
            }
            show_frame_line(app, ui);
        });
    });
}

/// Adds a line that can be clicked.
fn show_line(ui: &mut egui::Ui, text: &str, points: f32, colour: egui::Color32, help: &str) -> egui::Response {
    let text = egui::RichText::new(text).size(points).color(colour);
    let label = ui.add(egui::Label::new(text).sense(egui::Sense::click()));
    label.on_hover_text(help).on_hover_cursor(egui::CursorIcon::PointingHand)
}

/// Adds the last line: the time, and what a frame costs. It is for who cares about the machine, so it is small and
/// muted, and a narrow window shows only dots until they are tapped.
fn show_frame_line(app: &mut App, ui: &mut egui::Ui) {
    let muted = egui::Color32::from_white_alpha(165);
    if is_narrow(ui.ctx()) && !app.panel.shows_frame_line {
        let dots = show_line(
            ui,
            "…",
            FRAME_LINE_POINTS,
            muted,
            tr("Simulated time, and how fast one picture follows another."),
        );
        app.panel.shows_frame_line = with_accessible_name(dots, tr("Time of a frame")).clicked();
        return;
    }
    let ([width, height], n) = (app.picture_size(), app.params_to_draw().grid.n);
    let line = say!(
        "t = {time} s, {ms} ms a frame, {rate} frames/s, n = {n}, {width} x {height} pixels",
        time = format!("{:.0}", app.params.clock.t_s),
        ms = local_number(format!("{:.1}", app.quality.frame_ms())),
        rate = format!("{:.0}", app.quality.frames_per_second()),
        n = n,
        width = width,
        height = height,
    );
    let reduction = app.quality.reduction_in_words(&app.params.grid, &app.params.screen);
    let line = reduction.into_iter().fold(line, |line, why| format!("{line}\n{why}"));
    let help = format!(
        "{}\n{}",
        tr("Simulated time, and how fast one picture follows another."),
        numbers::picture_in_words(app)
    );
    if show_line(ui, &line, FRAME_LINE_POINTS, muted, &help).clicked() {
        app.panel.open(Tab::Study);
        app.panel.shows_frame_times = true;
    }
}

/// A line of the text over the sea.
struct SummaryLine {
    text: String,
    /// Size of the letters, points.
    points: f32,
    help: String,
    /// The tab that explains it.
    tab: Tab,
}

/// The lines of the text about the sea: wind or whence the waves were measured, waves, and how far a coast is.
fn lines(app: &App) -> Vec<SummaryLine> {
    let line = |text, points, help: String, tab| SummaryLine { text, points, help, tab };
    let (headline, about) = headline(app);
    let whence = app.measured_title().map(|title| line(title.to_owned(), 12.5, about.to_owned(), Tab::Study));
    let help = match heights_in_words(app) {
        None => tr(MEANINGS).to_owned(),
        Some(sum) => format!("{}\n{sum}", tr("Height: the mean of the highest third of the waves.")),
    };
    let waves = line(waves_in_words(app), 14.0, help, Tab::Study);
    let help = tr("The depths near the coast turn, grow and break the waves. Until then the open sea is shown.");
    let coast = app.coast_progress().map(|progress| line(progress, 12.0, help.to_owned(), Tab::Weather));
    let first = line(headline, 18.0, about.to_owned(), Tab::Weather);
    [Some(first), whence, Some(waves), coast].into_iter().flatten().collect()
}

/// The first line, about what makes the waves, and its explanation.
fn headline(app: &App) -> (String, &'static str) {
    if app.has_measured_waves() {
        let about = tr(
            "The waves of the spectrum that was opened: a buoy has measured them, or a wave model has computed them. The \
             wind of the panel does not make them.",
        );
        return (tr("Measured waves").to_owned(), about);
    }
    let wind = app.params.sea.first_system();
    let speed = UnitScale::for_unit("m/s", app.params.screen.units).format(wind.wind_m_s, 1);
    let name = tr(BEAUFORT_FORCES[beaufort::beaufort_number(wind.wind_m_s)].name);
    let from = tr(compass_point(wind.from_deg));
    let text = say!("{name}, {speed} from {from}", name = name, speed = speed, from = from);
    (text, tr("Wind speed 10 m above the sea, and the name of its Beaufort force."))
}
