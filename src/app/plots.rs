//! Plots of the panel.

use crate::model::Plan;
use egui_plot::{Legend, Line, LineStyle, Plot, PlotPoints, VLine};

const POINTS: usize = 240;

/// S(omega) of the whole sea and of each system, with the peak marked.
pub fn spectrum(plan: &Plan, ui: &mut egui::Ui) {
    let (low, peak) = (plan.support().0, plan.omega_p);
    let highest = plan.systems.iter().map(|s| s.spectrum.omega_p).fold(peak, f64::max);
    let end = (3.5 * peak).max(2.0 * highest);
    let curve = |density: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        (0..=POINTS).map(|i| low + (end - low) * i as f64 / POINTS as f64).map(|w| [w, density(w)]).collect()
    };
    ui.weak("Variance density S(ω), m² s, over ω, rad/s");
    let several = plan.systems.len() > 1;
    let mut plot = Plot::new("spectrum").height(140.0).allow_drag(false).allow_zoom(false).allow_scroll(false);
    if several {
        plot = plot.legend(Legend::default());
    }
    plot.show(ui, |plot| {
        plot.line(Line::new("sea", PlotPoints::from(curve(&|w| plan.density(w)))));
        plot.vline(VLine::new("peak", peak));
        if several {
            for (i, system) in plan.systems.iter().enumerate() {
                let points = PlotPoints::from(curve(&|w| system.spectrum.density(w)));
                plot.line(Line::new(format!("system {}", i + 1), points).style(LineStyle::dashed_loose()));
            }
        }
    });
}
