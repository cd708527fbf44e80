//! Plot of the frequency spectrum S(omega): of the whole sea, of each wave system, measured in the GPU's maps, and of
//! the buoy's record.

use super::super::App;
use super::super::panel::system_name;
use super::{PLOT_COLOURS, PlotTable, fixed_plot};
use crate::app::language::tr;
use crate::state::params::MAX_WAVE_SYSTEMS;
use crate::waves::Plan;
use egui_plot::{Bar, BarChart, Legend, Line, LineStyle, PlotPoints, VLine};

const CURVE_INTERVALS: usize = 240;
/// Colours of the four wave systems.
const SYSTEM_COLOURS: [egui::Color32; MAX_WAVE_SYSTEMS] =
    [PLOT_COLOURS[1], PLOT_COLOURS[2], PLOT_COLOURS[5], egui::Color32::WHITE];

/// Highest angular frequency of the spectrum plot and of the spectrum measured in the wave maps, rad/s.
pub fn highest_omega(plan: &Plan) -> f64 {
    let highest = plan.systems.iter().map(|s| s.spectrum.omega_p).fold(plan.omega_p, f64::max);
    (3.5 * plan.omega_p).max(2.0 * highest)
}

/// Plots the frequency spectrum by theory and as measured, its peak frequency, and the frequencies that separate the
/// cascades. Returns the data as a table for a CSV file.
pub fn show_spectrum_plot(app: &App, ui: &mut egui::Ui) -> PlotTable {
    let plan = &app.derived.plan;
    let (low, peak) = (plan.frequency_range().0, plan.omega_p);
    let end = highest_omega(plan);
    let omega = |i: usize| low + (end - low) * i as f64 / CURVE_INTERVALS as f64;
    let curve = |density: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        (0..=CURVE_INTERVALS).map(|i| [omega(i), density(omega(i))]).collect()
    };
    ui.weak(tr("Variance density S(ω), m² s, over ω, rad/s"));
    let several = plan.systems.len() > 1;
    let record = app.record.spectrum();
    let maps = app.sea_measurement.bin_width_and_spectrum();
    let plot =
        fixed_plot("spectrum").legend(Legend::default().background_alpha(0.4)).label_formatter(
            |pointed| match pointed {
                egui_plot::HoverPosition::NearDataPoint { plot_name, position, .. } => Some(format!(
                    "{plot_name}\nω {:.3} rad/s, T {:.1} s\nS {:.3} m² s",
                    position.x,
                    std::f64::consts::TAU / position.x.max(1e-3),
                    position.y
                )),
                egui_plot::HoverPosition::Elsewhere { .. } => None,
            },
        );
    plot.show(ui, |plot| {
        if let Some((width, density)) = &maps {
            let bar = |i: usize, s: f64| Bar::new((i as f64 + 0.5) * width, s).width(*width);
            let bars = density.iter().enumerate().map(|(i, s)| bar(i, *s)).collect();
            plot.bar_chart(BarChart::new("measured", bars).color(PLOT_COLOURS[3].gamma_multiply(0.35)));
        }
        plot.line(Line::new("theory", PlotPoints::from(curve(&|w| plan.density(w)))).color(PLOT_COLOURS[0]).width(2.0));
        plot.vline(VLine::new("peak", peak).color(PLOT_COLOURS[0].gamma_multiply(0.6)).width(1.0));
        if several {
            for system in &plan.systems {
                let points = PlotPoints::from(curve(&|w| system.spectrum.density(w)));
                let style = if system.number == 1 { LineStyle::dashed_loose() } else { LineStyle::dotted_loose() };
                let colour = SYSTEM_COLOURS[system.number - 1];
                plot.line(Line::new(system_name(system.number), points).color(colour).style(style));
            }
        }
        for cascade in plan.cascades.iter().skip(1) {
            let edge = plan.dispersion.omega(cascade.k_low);
            if edge < end {
                let line = VLine::new("cascades", edge).style(LineStyle::dotted_dense()).width(1.0);
                plot.vline(line.color(egui::Color32::GRAY));
            }
        }
        if record.len() > 2 {
            let points: Vec<[f64; 2]> = record.iter().copied().filter(|p| p[0] <= end).collect();
            plot.line(
                Line::new("buoy's record", PlotPoints::from(points))
                    .color(PLOT_COLOURS[4])
                    .style(LineStyle::dashed_dense()),
            );
        }
    });
    let measured = |omega: f64| {
        let (width, density) = maps.as_ref()?;
        density.get(((omega / width) as usize).min(density.len() - 1)).copied()
    };
    let rows = (0..=CURVE_INTERVALS).map(|i| {
        let w = omega(i);
        let systems = plan.systems.iter().map(move |s| s.spectrum.density(w));
        [w, plan.density(w)].into_iter().chain(systems).chain(measured(w)).collect()
    });
    let names: String = plan.systems.iter().map(|s| format!(",S{} (m2 s)", s.number)).collect();
    let last = if maps.is_some() { ",measured (m2 s)" } else { "" };
    PlotTable { name: "spectrum.csv", heading: format!("omega (rad/s),S (m2 s){names}{last}"), rows: rows.collect() }
}
