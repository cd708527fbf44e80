//! S(omega): theory, each system, what the cascades hold, and what was measured.

use super::super::App;
use super::{COLOURS, HEIGHT, Table};
use egui_plot::{Legend, Line, LineStyle, Plot, PlotPoints, VLine};

const POINTS: usize = 240;

/// The whole sea and each system, the peak, the edges of the cascades, and the spectrum of the buoy's record.
pub fn show(app: &App, ui: &mut egui::Ui) -> Table {
    let plan = &app.derived.plan;
    let (low, peak) = (plan.support().0, plan.omega_p);
    let highest = plan.systems.iter().map(|s| s.spectrum.omega_p).fold(peak, f64::max);
    let end = (3.5 * peak).max(2.0 * highest);
    let omega = |i: usize| low + (end - low) * i as f64 / POINTS as f64;
    let curve = |density: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        (0..=POINTS).map(|i| [omega(i), density(omega(i))]).collect()
    };
    ui.weak("Variance density S(ω), m² s, over ω, rad/s");
    let several = plan.systems.len() > 1;
    let measured = app.series.spectrum();
    let plot = Plot::new("spectrum")
        .height(HEIGHT)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .legend(Legend::default().background_alpha(0.4))
        .label_formatter(|pointed| match pointed {
            egui_plot::HoverPosition::NearDataPoint { plot_name, position, .. } => Some(format!(
                "{plot_name}\nω {:.3} rad/s, T {:.1} s\nS {:.3} m² s",
                position.x,
                std::f64::consts::TAU / position.x.max(1e-3),
                position.y
            )),
            egui_plot::HoverPosition::Elsewhere { .. } => None,
        });
    plot.show(ui, |plot| {
        plot.line(Line::new("theory", PlotPoints::from(curve(&|w| plan.density(w)))).color(COLOURS[0]).width(2.0));
        plot.vline(VLine::new("peak", peak).color(COLOURS[0].gamma_multiply(0.6)).width(1.0));
        if several {
            for (i, system) in plan.systems.iter().enumerate() {
                let points = PlotPoints::from(curve(&|w| system.spectrum.density(w)));
                let style = if i == 0 { LineStyle::dashed_loose() } else { LineStyle::dotted_loose() };
                plot.line(Line::new(format!("system {}", i + 1), points).color(COLOURS[1 + i]).style(style));
            }
        }
        for cascade in plan.cascades.iter().skip(1) {
            let edge = plan.dispersion.omega(cascade.k_low);
            if edge < end {
                let line = VLine::new("cascades", edge).style(LineStyle::dotted_dense()).width(1.0);
                plot.vline(line.color(egui::Color32::GRAY));
            }
        }
        if measured.len() > 2 {
            let points: Vec<[f64; 2]> = measured.iter().copied().filter(|p| p[0] <= end).collect();
            plot.line(
                Line::new("buoy's record", PlotPoints::from(points)).color(COLOURS[4]).style(LineStyle::dashed_dense()),
            );
        }
    });
    let rows = (0..=POINTS).map(|i| {
        let w = omega(i);
        let systems = plan.systems.iter().map(move |s| s.spectrum.density(w));
        [w, plan.density(w)].into_iter().chain(systems).collect()
    });
    let names: String = (1..=plan.systems.len()).map(|i| format!(",S{i} (m2 s)")).collect();
    Table { name: "spectrum.csv", heading: format!("omega (rad/s),S (m2 s){names}"), rows: rows.collect() }
}
