//! Plot of the frequency spectrum: of the whole sea, of each wave system, measured in the GPU's maps, and of
//! the buoy's record.

use super::super::App;
use super::super::panel::system_name;
use super::axis::{SpectrumAxis, show_axis_choice, spectrum_plot};
use super::legend::{Legend, Sample};
use super::{PLOT_COLOURS, PlotTable};
use crate::app::language::tr;
use crate::state::params::MAX_WAVE_SYSTEMS;
use crate::waves::Plan;
use egui_plot::{Line, LineStyle, PlotPoints, VLine};

const CURVE_INTERVALS: usize = 240;
/// Colour of the whole sea, unlike those of its parts.
const SEA_COLOUR: egui::Color32 = egui::Color32::WHITE;
/// Colours of the four wave systems.
const SYSTEM_COLOURS: [egui::Color32; MAX_WAVE_SYSTEMS] =
    [PLOT_COLOURS[1], PLOT_COLOURS[0], PLOT_COLOURS[5], PLOT_COLOURS[2]];
/// Colour of the line at the highest peak, and of the edges of the grids.
const MARK_COLOUR: egui::Color32 = egui::Color32::GRAY;

/// Highest angular frequency of the spectrum plot and of the spectrum measured in the wave maps, rad/s.
pub fn highest_omega(plan: &Plan) -> f64 {
    let highest = plan.systems.iter().map(|s| s.spectrum.omega_p).fold(plan.omega_p, f64::max);
    (3.5 * plan.omega_p).max(2.0 * highest)
}

/// Plots the frequency spectrum by theory and as measured, and its highest peak, along the axis that the visitor
/// chooses; but for the axis of periods also the frequencies that separate the cascades. Returns the data as a table
/// for a CSV file.
pub fn show_spectrum_plot(app: &mut App, ui: &mut egui::Ui) -> PlotTable {
    show_axis_choice(app, ui);
    let app = &*app;
    let plan = &app.derived.plan;
    let (low, end) = (plan.frequency_range().0, highest_omega(plan));
    let omega = |i: usize| low + (end - low) * i as f64 / CURVE_INTERVALS as f64;
    let axis = app.visitor.preferences.spectrum_axis;
    let curve = |density: &dyn Fn(f64) -> f64| -> PlotPoints<'_> {
        (0..=CURVE_INTERVALS).map(|i| axis.point([omega(i), density(omega(i))])).collect()
    };
    let record = app.record.spectrum();
    let maps = app.sea_measurement.bin_width_and_spectrum();
    let mut legend = Legend::default();
    spectrum_plot(app, "spectrum", ui).show(ui, |plot| {
        if let Some((width, density)) = &maps {
            let colour = PLOT_COLOURS[3].gamma_multiply(0.35);
            plot.bar_chart(axis.bars(tr("Drawn waves"), *width, density).color(colour));
            legend.add(tr("Drawn waves"), colour, Sample::Bars);
        }
        plot.line(Line::new(tr("This sea"), curve(&|w| plan.density(w))).color(SEA_COLOUR).width(2.0));
        legend.add(tr("This sea"), SEA_COLOUR, Sample::Line);
        let peak = VLine::new(tr("Highest peak"), axis.at(plan.omega_p));
        plot.vline(peak.color(MARK_COLOUR).style(LineStyle::dashed_dense()).width(1.0));
        legend.add(tr("Highest peak"), MARK_COLOUR, Sample::Dashed);
        if plan.systems.len() > 1 {
            for system in &plan.systems {
                let points = curve(&|w| system.spectrum.density(w));
                let (style, sample) = match system.number {
                    1 => (LineStyle::dashed_loose(), Sample::Dashed),
                    _ => (LineStyle::dotted_loose(), Sample::Dotted),
                };
                let (name, colour) = (system_name(system.number), SYSTEM_COLOURS[system.number - 1]);
                plot.line(Line::new(name, points).color(colour).style(style).width(2.0));
                legend.add(name, colour, sample);
            }
        }
        // Where one grid of waves ends and the next begins concerns only who looks at the machine.
        let edges = plan.cascades.iter().skip(1).filter(|_| axis != SpectrumAxis::Period);
        for edge in edges.map(|cascade| plan.dispersion.omega(cascade.k_low)).filter(|edge| *edge < end) {
            let line = VLine::new(tr("Edges of the grids"), axis.at(edge)).style(LineStyle::dotted_dense()).width(1.0);
            plot.vline(line.color(MARK_COLOUR));
            legend.add(tr("Edges of the grids"), MARK_COLOUR, Sample::Dotted);
        }
        if record.len() > 2 {
            let points: PlotPoints<'_> = record.iter().filter(|p| p[0] <= end).map(|p| axis.point(*p)).collect();
            let line = Line::new(tr("Buoy's record"), points).color(PLOT_COLOURS[4]);
            plot.line(line.style(LineStyle::dashed_dense()));
            legend.add(tr("Buoy's record"), PLOT_COLOURS[4], Sample::Dashed);
        }
    });
    legend.show(ui);
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
