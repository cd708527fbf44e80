//! Plots of the panel: the spectrum, its directions, the sea at a point over time, and a cut through it. Each can be saved
//! as CSV. Colours are those of Okabe and Ito (2008), which the colour-blind tell apart too; lines differ in dashes as well.

pub mod polar;
mod profile;
mod series;
mod spectrum;

use super::App;
use super::access::named;
use super::gauges::{Look, looked_at};
use egui::Color32;
use std::fmt::Write as _;

pub use series::Series;
pub use spectrum::highest_omega;

/// Colours of lines, in order.
const COLOURS: [Color32; 6] = [
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(240, 228, 66),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(204, 121, 167),
];
/// Height of a plot, points.
const HEIGHT: f32 = 150.0;

/// A table to save: name of the file, heading, rows.
pub struct Table {
    name: &'static str,
    heading: String,
    rows: Vec<Vec<f64>>,
}

impl Table {
    /// As CSV, after the state that it belongs to.
    fn csv(&self, state: &str) -> String {
        let mut text = format!("# Seastate {state}\n{}\n", self.heading);
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(|x| format!("{x:.6}")).collect();
            let _ = writeln!(text, "{}", cells.join(","));
        }
        text
    }
}

/// All plots, one below the other.
pub fn show(app: &mut App, ui: &mut egui::Ui) {
    let mut wanted = None;
    section(ui, "Spectrum", true, &mut wanted, |ui| {
        looked_at(ui.ctx(), Look::Maps);
        spectrum::show(app, ui)
    });
    section(ui, "Directions", false, &mut wanted, |ui| polar::show(app, ui));
    section(ui, "Sea at a buoy", false, &mut wanted, |ui| {
        looked_at(ui.ctx(), Look::Record);
        series::show(app, ui)
    });
    section(ui, "Cut through the sea", false, &mut wanted, |ui| profile::show(app, ui));
    if let Some(table) = wanted {
        let text = table.csv(&app.state());
        app.save(table.name, text.as_bytes());
    }
}

/// A plot with its button; the table is made only when it is asked for.
fn section(
    ui: &mut egui::Ui,
    title: &str,
    open: bool,
    wanted: &mut Option<Table>,
    plot: impl FnOnce(&mut egui::Ui) -> Table,
) {
    egui::CollapsingHeader::new(title).default_open(open).show(ui, |ui| {
        let table = plot(ui);
        let button = ui.small_button("CSV").on_hover_text("Saves these numbers.");
        if named(button, &format!("{title}: save as CSV")).clicked() {
            *wanted = Some(table);
        }
    });
}
