//! Plots of a gauge at a coast: its spectrum beside that of the open sea, and the height of the sea there over time.

use super::super::App;
use super::super::coast_maps::{PlacedGauge, RECORD_AHEAD_S};
use super::axis::{show_caption, spectrum_plot};
use super::legend::{Legend, Sample};
use super::spectrum::highest_omega;
use super::{PLOT_COLOURS, fixed_plot};
use crate::app::language::{say, tr};
use crate::coast::gauges::Gauge;
use crate::coast::transfer::SpectrumBand;
use egui_plot::{Line, LineStyle, PlotPoints, VLine};

/// Time before and after the present that the plot of the record shows, s.
const SHOWN_S: [f64; 2] = [90.0, 30.0];

/// Plots the spectrum at the gauge `number` by theory, that of the open sea, and that of the gauge's record.
pub fn show_spectrum(app: &App, (number, gauge): (usize, &PlacedGauge), ui: &mut egui::Ui) {
    let Some(statistics) = app.coast.maps.statistics() else { return };
    let plan = &app.derived.plan;
    let end = highest_omega(plan);
    let bands = statistics.spectrum(gauge.point[0], gauge.point[1]);
    let bands = || bands.iter().filter(|band| band.omega_rad_s <= end);
    let axis = app.visitor.preferences.spectrum_axis;
    show_caption(app, ui);
    let plot = spectrum_plot(app, "gauge spectrum", ui).id(egui::Id::unique(("gauge spectrum", number)));
    let mut legend = Legend::default();
    plot.show(ui, |plot| {
        let open: Vec<[f64; 2]> = bands().map(|b| axis.point([b.omega_rad_s, plan.density(b.omega_rad_s)])).collect();
        let share = bands().map(SpectrumBand::share);
        let here: Vec<[f64; 2]> = open.iter().zip(share).map(|([at, density], s)| [*at, density * s]).collect();
        let line = Line::new(tr("Open sea"), PlotPoints::from(open)).color(PLOT_COLOURS[0]);
        plot.line(line.style(LineStyle::dashed_loose()));
        legend.add(tr("Open sea"), PLOT_COLOURS[0], Sample::Dashed);
        plot.line(Line::new(tr("gauge"), PlotPoints::from(here)).color(PLOT_COLOURS[1]).width(2.0));
        legend.add(tr("gauge"), PLOT_COLOURS[1], Sample::Line);
        let record = gauge.record.spectrum();
        if record.len() > 2 {
            let points: PlotPoints<'_> = record.iter().filter(|p| p[0] <= end).map(|p| axis.point(*p)).collect();
            let line = Line::new(tr("record"), points).color(PLOT_COLOURS[4]);
            plot.line(line.style(LineStyle::dashed_dense()));
            legend.add(tr("record"), PLOT_COLOURS[4], Sample::Dashed);
        }
    });
    legend.show(ui);
}

/// Plots the height of the drawn sea at the gauge `number` before and after the present, and shows the significant wave
/// height of the record beside that of theory, `sea`.
pub fn show_record(app: &App, (number, gauge): (usize, &PlacedGauge), sea: &Gauge, ui: &mut egui::Ui) {
    let (scale, t_s) = (app.length_scale(), app.params.clock.t_s);
    let [from, to] = [t_s - SHOWN_S[0], t_s + SHOWN_S[1].min(RECORD_AHEAD_S)];
    let samples = gauge.record.samples().iter().filter(|s| (from..=to).contains(&s[0]));
    let shown: Vec<[f64; 2]> = samples.map(|s| [s[0] - t_s, s[1] * scale.factor]).collect();
    ui.weak(say!("Height of the drawn sea, {unit}, over the time from now, s", unit = scale.unit));
    let half = (0.8 * sea.hs_m * scale.factor).max(0.05);
    let plot = fixed_plot("gauge record").id(egui::Id::unique(("gauge record", number)));
    let plot = plot.include_x(-SHOWN_S[0]).include_x(SHOWN_S[1]).include_y(-half).include_y(half);
    plot.show(ui, |plot| {
        plot.vline(VLine::new(tr("now"), 0.0).color(egui::Color32::GRAY).width(1.0));
        plot.line(Line::new(tr("height"), PlotPoints::from(shown)).color(PLOT_COLOURS[0]));
    });
    if let Some(hs_m) = gauge.record.hs_m() {
        ui.label(say!(
            "Hs of {minutes} min of record {measured}, by theory {theory}",
            minutes = format!("{:.0}", gauge.record.length_s() / 60.0),
            measured = scale.format(hs_m, 2),
            theory = scale.format(sea.hs_m, 2),
        ));
    }
}

/// The sea at a gauge in one line.
pub fn in_words(app: &App, sea: &Gauge) -> String {
    let scale = app.length_scale();
    say!(
        "depth {depth}, Hs {height}, Tp {period} s, from {from}°, breaking {percent} %",
        depth = scale.format(sea.depth_m, 1),
        height = scale.format(sea.hs_m, 2),
        period = crate::app::language::local_number(format!("{:.1}", sea.tp_s)),
        from = format!("{:.0}", sea.from_deg),
        percent = format!("{:.0}", 100.0 * sea.breaking_fraction),
    )
}
