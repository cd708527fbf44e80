//! Plot of the sea's profile: heights along the direction of view at the current time.

use super::super::App;
use super::{PLOT_COLOURS, PlotTable, fixed_plot};
use crate::app::language::{say, tr};
use egui_plot::{HLine, Line, PlotPoints};

const PROFILE_POINTS: usize = 160;

/// Plots the height of the sea along the direction of view, from the point below the camera to four peak wavelengths
/// ahead. Returns the data as a table for a CSV file.
pub fn show_profile_plot(app: &App, ui: &mut egui::Ui) -> PlotTable {
    let camera = &app.params.camera;
    let (sin, cos) = camera.heading_deg.to_radians().sin_cos();
    let reach = (4.0 * app.derived.theoretical_statistics.lambda_p_m).clamp(2.0, 2000.0);
    let distance = |i: usize| reach * i as f64 / (PROFILE_POINTS - 1) as f64;
    let points: Vec<[f64; 2]> =
        (0..PROFILE_POINTS).map(|i| [camera.x_m + sin * distance(i), camera.z_m - cos * distance(i)]).collect();
    let heights: Vec<f64> =
        app.derived.strongest_waves().sample_many(&points, app.params.clock.t_s).iter().map(|s| s.height_m).collect();
    let length_scale = app.length_scale();
    ui.weak(say!("Height over distance ahead of the camera, {unit}", unit = length_scale.unit));
    let shown: Vec<[f64; 2]> =
        (0..PROFILE_POINTS).map(|i| [distance(i), heights[i]].map(|x| x * length_scale.factor)).collect();
    let half = (0.9 * app.derived.theoretical_statistics.hs_m * length_scale.factor).max(0.05);
    let level = app.params.sea.still_water_level_m * length_scale.factor;
    let plot = fixed_plot("profile").include_y(level - half).include_y(level + half);
    plot.show(ui, |plot| {
        plot.hline(HLine::new(tr("still water"), level).color(egui::Color32::GRAY).width(1.0));
        plot.line(Line::new(tr("surface"), PlotPoints::from(shown)).color(PLOT_COLOURS[0]).fill((level - half) as f32));
    });
    let rows = (0..PROFILE_POINTS).map(|i| vec![points[i][0], points[i][1], distance(i), heights[i]]);
    PlotTable { name: "profile.csv", heading: "x (m),z (m),distance (m),height (m)".into(), rows: rows.collect() }
}
