//! Plots of the panel.

use crate::model::Plan;
use egui_plot::{Line, Plot, PlotPoints, VLine};

const POINTS: usize = 240;

/// S(omega) with the peak marked.
pub fn spectrum(plan: &Plan, ui: &mut egui::Ui) {
    let peak = plan.omega_p;
    let points: Vec<[f64; 2]> = (1..=POINTS)
        .map(|i| {
            let omega = 3.5 * peak * i as f64 / POINTS as f64;
            [omega, plan.density(omega)]
        })
        .collect();
    ui.weak("Variance density S(ω), m² s, over ω, rad/s");
    Plot::new("spectrum").height(140.0).allow_drag(false).allow_zoom(false).allow_scroll(false).show(ui, |plot| {
        plot.line(Line::new("S", PlotPoints::from(points)));
        plot.vline(VLine::new("peak", peak));
    });
}
