//! Read-outs of the panel: statistics of the sea by theory and as measured, times of the GPU passes, and the device.

use super::super::{App, notices};
use super::summary;
use crate::app::language::{local_number, say, tr};

/// Least width of the panel's contents in which two of the main statistics stand beside each other, points.
const LEAST_WIDTH_OF_TWO_POINTS: f32 = 300.0;

/// Shows the main statistics of the sea by theory: significant wave height, periods, wavelength, direction and spread.
pub fn show_main_statistics(app: &App, ui: &mut egui::Ui) {
    let t = &app.derived.theoretical_statistics;
    let length_scale = app.length_scale();
    // These rows contain no widgets to tap, so they need no height for fingers.
    let tall = std::mem::replace(&mut ui.spacing_mut().interact_size.y, 18.0);
    let from = t.mean_from_deg.map_or(tr("none").to_owned(), |d| format!("{d:.0}°"));
    let hs_help = tr("Significant wave height: the mean of the highest third of the waves.");
    let from_help = tr("Mean direction that the waves come from, clockwise from north.");
    let spread_help = tr("Directional spread sqrt(2 (1 - r1)), weighted by energy: 81° is no direction at all.");
    let rows = [
        (tr("Height Hs"), length_scale.format(t.hs_m, 2), hs_help),
        (tr("Period Tp"), local_number(format!("{:.1} s", t.tp_s)), tr("Period of the peak of the spectrum.")),
        (
            tr("Mean period Tz"),
            local_number(format!("{:.1} s", t.tm02_s)),
            tr("Mean time between two waves, where the water rises through its mean level."),
        ),
        (tr("From"), from, from_help),
        (tr("Spread"), format!("{:.0}°", t.spread_deg), spread_help),
    ];
    // Each of several wave systems has its own length, which stands below the table.
    let length = (tr("Length"), length_scale.format(t.lambda_p_m, 0), tr("Wavelength of the peak."));
    let length = Some(length).filter(|_| app.derived.systems.is_empty());
    let rows: Vec<_> = rows.into_iter().chain(length).collect();
    // In a narrow window with large letters two of them have no room in a line.
    let in_line = if ui.available_width() < LEAST_WIDTH_OF_TWO_POINTS { 1 } else { 2 };
    egui::Grid::new("read-outs").num_columns(2 * in_line).show(ui, |ui| {
        for pair in rows.chunks(in_line) {
            for (label, text, help) in pair {
                ui.weak(*label).on_hover_text(*help);
                ui.strong(text).on_hover_text(*help);
            }
            ui.end_row();
        }
    });
    ui.spacing_mut().interact_size.y = tall;
    ui.weak(tr(summary::MEANINGS));
    for system in &app.derived.systems {
        ui.label(say!(
            "{system}: {height} high, {length} long, every {period} s",
            system = summary::system_name(system.number),
            height = length_scale.format(system.hs_m, 1),
            length = length_scale.format(system.length_m, 0),
            period = local_number(format!("{:.1}", system.period_s)),
        ));
    }
    if let Some(sum) = summary::heights_in_words(app) {
        ui.weak(sum);
    }
}

/// Shows a table of statistics in three columns: by theory, of the waves on the FFT grids, and as measured on the GPU.
pub fn show_all_statistics(app: &App, ui: &mut egui::Ui) {
    app.visible_readouts.map_statistics.set(true);
    let (t, r) = (&app.derived.theoretical_statistics, app.derived.lattice_statistics());
    let length_scale = app.length_scale();
    egui::Grid::new("more numbers").num_columns(4).striped(true).show(ui, |ui| {
        let mut row = |label: &str, values: [String; 3], help: &str| {
            ui.weak(label).on_hover_text(help);
            for value in values {
                ui.label(value).on_hover_text(help);
            }
            ui.end_row();
        };
        let none = String::new;
        let known = |value: Option<f64>, text: &dyn Fn(f64) -> String| value.map_or_else(none, text);
        let (seconds, slope) = (|x: f64| format!("{x:.2} s"), |x: f64| format!("{x:.4}"));
        let (degrees, percent) = (|x: f64| format!("{x:.1}°"), |x: f64| format!("{:.2} %", 100.0 * x));
        let m = &app.sea_measurement;
        let help = tr("What the spectrum promises, what the waves on the grid hold, and what was read from the GPU's \
                    maps.");
        row("", [tr("theory"), tr("computed"), tr("measured")].map(str::to_owned), help);
        let hs = [
            length_scale.format(t.hs_m, 3),
            length_scale.format(r.hs_m, 3),
            known(m.hs_m(), &|x| length_scale.format(x, 3)),
        ];
        row(tr("Hs"), hs, tr("Significant wave height, 4 sqrt(m0)."));
        row(tr("Tm01"), [seconds(t.tm01_s), seconds(r.tm01_s), none()], tr("Mean period, 2 pi m0 / m1."));
        row(tr("Tm02"), [seconds(t.tm02_s), seconds(r.tm02_s), none()], tr("Mean zero-crossing period."));
        let length = [length_scale.format(t.lambda_mean_m, 1), none(), none()];
        row(tr("Mean length"), length, tr("Wavelength of the mean period Tm01."));
        let help = tr("Hs over the wavelength of the peak; waves break near 0.07.");
        row(tr("Steepness"), [slope(t.steepness), none(), none()], help);
        let shortest_m = std::f64::consts::TAU / t.k_max.max(1e-9);
        let help = say!(
            "Mean square slope of waves longer than {length} m.",
            length = local_number(format!("{shortest_m:.2}"))
        );
        row(tr("Slopes"), [slope(t.mss), slope(r.mss), known(m.mss(), &slope)], &help);
        row(tr("Spread"), [degrees(t.spread_deg), degrees(r.spread_deg), none()], tr("Directional spread."));
        let help = tr("Benjamin-Feir index: near 1 freak waves become likely in a narrow, long-crested sea (Janssen \
                    2003).");
        row(tr("Benjamin-Feir"), [format!("{:.2}", t.benjamin_feir), none(), none()], help);
        let help =
            tr("Coverage by whitecaps at this wind (Monahan and O'Muircheartaigh 1980), and the mean of the foam \
                    that is computed around the camera, however much of it is shown.");
        row(tr("Whitecaps"), [percent(t.whitecap_fraction), none(), known(m.foam_coverage(), &percent)], help);
        row(tr("Energy held"), [none(), percent(r.m0_fraction), none()], tr("Share of the variance on the grid."));
    });
    let readings = app.sea_measurement.reading_count();
    if readings > 0 {
        let moments =
            if readings == 1 { tr("one moment").to_owned() } else { say!("{readings} moments", readings = readings) };
        ui.weak(say!("Measured: mean of {moments}.", moments = moments));
    }
    if let Some(note) = &app.derived.plan.resolution_note {
        ui.weak(notices::translate(note));
    }
}

/// The points of the waves' grids and the pixels of the picture, and what a slow machine leaves out, in words.
pub fn picture_in_words(app: &App) -> String {
    let ([width, height], n) = (app.picture_size(), app.params_to_draw().grid.n);
    let pixels = say!("{n} x {n} points, {width} x {height} pixels", n = n, width = width, height = height);
    let reduction = app.quality.reduction_in_words(&app.params.grid, &app.params.screen);
    let quality = reduction.unwrap_or_else(|| say!("Picture: {quality}.", quality = app.quality.describe()));
    format!("{pixels}\n{quality}")
}

/// Shows the time of a frame: what is drawn, the CPU time of recording it, and the GPU time of each pass.
pub fn show_frame_times(app: &App, ui: &mut egui::Ui) {
    app.visible_readouts.pass_times.set(true);
    ui.label(picture_in_words(app)).on_hover_text(tr(
        "Points of the waves' grids (FFT size n), and pixels of the picture that are computed. A slow machine draws \
         fewer; a stopped sea has all.",
    ));
    ui.label(say!(
        "Recording a frame: {ms} ms of the CPU",
        ms = local_number(format!("{:.2}", app.frame_measurements.recording_time_ms()))
    ));
    match app.frame_measurements.pass_times_ms() {
        None => {
            ui.weak(tr("This GPU does not tell how long its passes take: it has no timestamps."));
        }
        Some(passes) => {
            egui::Grid::new("passes").num_columns(2).striped(true).show(ui, |ui| {
                let all: f64 = passes.iter().map(|(_, ms)| ms).sum();
                for (pass, ms) in passes.iter().copied().chain([(tr("all on the GPU"), all)]) {
                    ui.weak(pass);
                    ui.label(format!("{ms:.2} ms"));
                    ui.end_row();
                }
            });
            ui.weak(tr("Without the panel and the last blit, smoothed over frames."));
        }
    }
}

/// Shows information about the program and its GPU, and the wavelengths of each cascade.
pub fn show_system_information(app: &mut App, ui: &mut egui::Ui) {
    let help = tr("Copies all of this, the state and what went wrong as plain text.");
    if super::button_with_help(ui, tr("Copy report"), help) {
        app.copy_report();
    }
    egui::Grid::new("about").num_columns(2).striped(true).max_col_width(210.0).show(ui, |ui| {
        for (name, value) in app.system_information() {
            ui.weak(tr(name));
            ui.add(egui::Label::new(value).wrap());
            ui.end_row();
        }
    });
    let plan = &app.derived.plan;
    for c in &plan.cascades {
        let longest = if c.k_low > 0.0 { std::f64::consts::TAU / c.k_low } else { c.patch_m };
        let number = |metres: f64, digits: usize| local_number(format!("{metres:.digits$}"));
        ui.label(say!(
            "patch {side} m: waves of {shortest} to {longest} m",
            side = number(c.patch_m, 1),
            shortest = number(std::f64::consts::TAU / c.k_high, 2),
            longest = number(longest, 1),
        ));
    }
    ui.label(say!(
        "{percent} % of the sea's energy is computed",
        percent = local_number(format!("{:.1}", 100.0 * plan.resolved_variance_fraction().min(1.0)))
    ));
}
