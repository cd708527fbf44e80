//! Polar plot of the directional spectrum: the direction that waves come from, long waves in the middle, and the wind.

use super::super::App;
use super::PlotTable;
use crate::app::language::{local_number, say, text, tr};
use crate::waves::Plan;
use egui::{Color32, Mesh, Stroke, vec2};

const DIRECTION_COUNT: usize = 72;
const FREQUENCY_COUNT: usize = 28;
/// Height of the area of the polar plot, points; the plot is a circle in its middle.
const POLAR_PLOT_HEIGHT_POINTS: f32 = 240.0;

/// Directional spectrum, sampled for the polar plot on rings; each ring has one frequency.
pub struct DirectionalSpectrumSamples {
    /// Angular frequency omega at the middle of each ring, rad/s.
    omega: Vec<f64>,
    /// Spectral density per angular frequency and direction, m^2 s/rad, one ring after the other. In a ring: the
    /// directions that the waves come from, in equal steps clockwise from north.
    density: Vec<f64>,
}

impl DirectionalSpectrumSamples {
    /// Samples the directional spectrum of a sea for the plot.
    pub fn new(plan: &Plan) -> Self {
        let (low, high) = (plan.frequency_range().0, 3.0 * plan.omega_p);
        let omega: Vec<f64> =
            (0..FREQUENCY_COUNT).map(|i| low + (high - low) * (i as f64 + 0.5) / FREQUENCY_COUNT as f64).collect();
        let at = |w: f64, i: usize| -> f64 {
            // The wave vector (x east, z south) points away from where the waves come from.
            let from = std::f64::consts::TAU * i as f64 / DIRECTION_COUNT as f64;
            let k = [-from.sin(), from.cos()];
            plan.systems.iter().map(|s| s.spectrum.density(w) * s.direction_density(w, k)).sum()
        };
        let density =
            omega.iter().flat_map(|&w| (0..DIRECTION_COUNT).map(move |i| (w, i))).map(|(w, i)| at(w, i)).collect();
        Self { omega, density }
    }
}

/// Colour of a value from 0 to 1 of the colour map cividis, whose brightness increases in colour-blind sight (Nunez et al.
/// 2018). In the polar plot `x` is the root of the spectral density over the plot's largest.
pub fn cividis(x: f64) -> Color32 {
    const STOPS: [[f64; 3]; 5] =
        [[0.0, 0.13, 0.30], [0.25, 0.30, 0.42], [0.49, 0.48, 0.47], [0.73, 0.68, 0.43], [1.0, 0.91, 0.27]];
    let at = x.clamp(0.0, 1.0) * 4.0;
    let i = (at as usize).min(3);
    let f = at - i as f64;
    let [r, g, b] = std::array::from_fn(|c| (255.0 * (STOPS[i][c] * (1.0 - f) + STOPS[i + 1][c] * f)) as u8);
    Color32::from_rgb(r, g, b)
}

/// Draws the polar plot of the directional spectrum with north up: where the waves come from, long waves in the middle.
/// Returns the data as a table for a CSV file.
pub fn show_direction_plot(app: &App, ui: &mut egui::Ui) -> PlotTable {
    let wheel = app.derived.directional_spectrum();
    ui.weak(tr("Where the waves come from, north up; long waves inside, short ones outside"));
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), POLAR_PLOT_HEIGHT_POINTS), egui::Sense::hover());
    let centre = rect.center();
    let radius = 0.5 * POLAR_PLOT_HEIGHT_POINTS - 16.0;
    let at = |from: f32, r: f32| centre + r * vec2(from.sin(), -from.cos());
    let most = wheel.density.iter().copied().fold(1e-12, f64::max);
    let mut mesh = Mesh::default();
    for ring in 0..FREQUENCY_COUNT {
        let [inner, outer] = [ring, ring + 1].map(|i| radius * i as f32 / FREQUENCY_COUNT as f32);
        for i in 0..DIRECTION_COUNT {
            let [a, b] = [i as f32 - 0.5, i as f32 + 0.5].map(|i| std::f32::consts::TAU * i / DIRECTION_COUNT as f32);
            // The square root makes weak directions visible.
            let fill = cividis((wheel.density[ring * DIRECTION_COUNT + i] / most).sqrt());
            let first = mesh.vertices.len() as u32;
            for p in [at(a, inner), at(b, inner), at(b, outer), at(a, outer)] {
                mesh.colored_vertex(p, fill);
            }
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first, first + 2, first + 3);
        }
    }
    let painter = ui.painter_at(rect);
    painter.add(mesh);
    painter.circle_stroke(centre, radius, Stroke::new(1.0, Color32::GRAY));
    for (name, from) in [(text!("N"), 0.0), (text!("E"), 0.25), (text!("S"), 0.5), (text!("W"), 0.75)] {
        let font = egui::FontId::proportional(12.0);
        painter.text(
            at(std::f32::consts::TAU * from, radius + 9.0),
            egui::Align2::CENTER_CENTER,
            tr(name),
            font,
            Color32::LIGHT_GRAY,
        );
    }
    let wind = app.params.sea.first_system().from_deg.to_radians() as f32;
    let tail = at(wind, radius);
    painter.arrow(tail, 0.38 * (centre - tail), Stroke::new(2.5, Color32::WHITE));
    painter.circle_filled(tail, 2.5, Color32::WHITE);
    if let Some(p) = response.hover_pos() {
        let to = p - centre;
        let ring = (to.length() / radius * FREQUENCY_COUNT as f32) as usize;
        if ring < FREQUENCY_COUNT {
            let from = to.x.atan2(-to.y).rem_euclid(std::f32::consts::TAU);
            let i = (from / std::f32::consts::TAU * DIRECTION_COUNT as f32).round() as usize % DIRECTION_COUNT;
            let omega = wheel.omega[ring];
            let waves = say!(
                "waves of {period} s from {from}°",
                period = local_number(format!("{:.1}", std::f64::consts::TAU / omega)),
                from = format!("{:.0}", from.to_degrees())
            );
            let density = local_number(format!("{:.3}", wheel.density[ring * DIRECTION_COUNT + i]));
            response.on_hover_text_at_pointer(format!("{waves}\nS(ω, θ) = {density} m² s/rad"));
        }
    }
    ui.weak(tr("The arrow is the local wind. Brightness is the root of the density."));
    let rows = (0..FREQUENCY_COUNT * DIRECTION_COUNT).map(|j| {
        vec![
            wheel.omega[j / DIRECTION_COUNT],
            360.0 * (j % DIRECTION_COUNT) as f64 / DIRECTION_COUNT as f64,
            wheel.density[j],
        ]
    });
    PlotTable { name: "directions.csv", heading: "omega (rad/s),from (deg),S (m2 s/rad)".into(), rows: rows.collect() }
}
