//! Plots of the panel: frequency spectrum, directional spectrum, height at a point over time with the exceedance of its
//! crests and heights, and a profile of the sea.
//! Each can be saved as CSV. The colours of Okabe and Ito (2008) stay distinct for colour-blind readers; lines also
//! differ in dashes.

mod axis;
mod exceedance;
pub mod gauge;
mod legend;
pub mod polar;
mod profile;
mod series;
mod spectrum;

use super::App;
use super::accessible_names::with_accessible_name;
use crate::app::language::{local_number, say, tr};
use egui::Color32;
use egui_plot::{AxisHints, GridInput, GridMark, Plot};
use std::fmt::Write as _;

pub use axis::SpectrumAxis;
pub use spectrum::highest_omega;

/// The six colours of the lines and bars in the panel's plots, distinct for colour-blind readers.
const PLOT_COLOURS: [Color32; 6] = [
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(240, 228, 66),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(204, 121, 167),
];
/// Height of a plot on the screen, points.
const PLOT_HEIGHT_POINTS: f32 = 150.0;
/// Distances of marks at the horizontal axis, points, from which on their numbers appear, and are clear.
const NUMBER_SPACING_POINTS: egui::Rangef = egui::Rangef { min: 10.0, max: 20.0 };

/// The data of a plot as a table for a CSV file: file name, column headings separated by commas, rows.
pub struct PlotTable {
    name: &'static str,
    heading: String,
    rows: Vec<Vec<f64>>,
}

impl PlotTable {
    /// Formats the table as CSV, with the state string in a comment line.
    fn csv(&self, state: &str) -> String {
        let mut text = format!("# Seastate {state}\n{}\n", self.heading);
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(|x| format!("{x:.6}")).collect();
            let _ = writeln!(text, "{}", cells.join(","));
        }
        text
    }
}

/// Creates an empty plot of height [`PLOT_HEIGHT_POINTS`] that the pointer cannot move or zoom; `name` is its id in
/// egui.
fn fixed_plot(name: &str) -> Plot<'_> {
    let plot = Plot::new(name).height(PLOT_HEIGHT_POINTS).allow_drag(false).allow_zoom(false).allow_scroll(false);
    // The usual marks at powers of ten, of which only distant ones have numbers, leave most axes with a single number.
    let plot = plot.custom_x_axes(vec![AxisHints::new_x().label_spacing(NUMBER_SPACING_POINTS)]);
    plot.x_grid_spacer(|input| round_marks(&input)).x_axis_formatter(|mark, _| number(mark))
}

/// The number at a mark of an axis, without digits that only rounding errors have.
fn number(mark: GridMark) -> String {
    local_number(format!("{}", (mark.value * 1e6).round() / 1e6 + 0.0))
}

/// Marks along an axis: two to seven multiples of 1, 2 or 5 times a power of ten.
fn round_marks(input: &GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let least = (high - low) / 6.0;
    let power = 10f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0].map(|x| x * power).into_iter().find(|step| *step >= least).unwrap_or(10.0 * power);
    let marks = (0..8).map(|i| ((low / step).ceil() + f64::from(i)) * step).take_while(|value| *value <= high);
    marks.map(|value| GridMark { value, step_size: step }).collect()
}

/// Adds all plots to the panel, one below the other.
pub fn show_all_plots(app: &mut App, ui: &mut egui::Ui) {
    let mut table_to_save = None;
    show_plot_section(ui, tr("Spectrum"), true, &mut table_to_save, |ui| {
        app.visible_readouts.map_statistics.set(true);
        spectrum::show_spectrum_plot(app, ui)
    });
    show_plot_section(ui, tr("Directions"), false, &mut table_to_save, |ui| polar::show_direction_plot(app, ui));
    show_plot_section(ui, tr("Sea at a buoy"), false, &mut table_to_save, |ui| {
        app.visible_readouts.height_record.set(true);
        series::show_height_record_plot(app, ui)
    });
    show_plot_section(ui, tr("Crests at a buoy"), false, &mut table_to_save, |ui| {
        app.visible_readouts.height_record.set(true);
        exceedance::show_exceedance_plot(app, ui)
    });
    show_plot_section(ui, tr("Cut through the sea"), false, &mut table_to_save, |ui| {
        profile::show_profile_plot(app, ui)
    });
    if let Some(table) = table_to_save {
        let text = table.csv(&app.state());
        app.save(table.name, text.as_bytes());
    }
}

/// Adds a collapsible section, open at first if `open`, with what `plot` draws and a button "CSV". A click on the
/// button puts the plot's table into `table_to_save`, which the caller then saves.
fn show_plot_section(
    ui: &mut egui::Ui,
    title: &str,
    open: bool,
    table_to_save: &mut Option<PlotTable>,
    plot: impl FnOnce(&mut egui::Ui) -> PlotTable,
) {
    egui::CollapsingHeader::new(title).default_open(open).show(ui, |ui| {
        let table = plot(ui);
        let button = ui.small_button(tr("CSV")).on_hover_text(tr("Saves these numbers."));
        if with_accessible_name(button, &say!("{title}: save as CSV", title = title)).clicked() {
            *table_to_save = Some(table);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_few_and_round() {
        for bounds in [(-30.0, 90.0), (0.0, 3.2), (0.02, 0.35), (2000.0, 2120.0), (-1e-3, 1e-3)] {
            let marks = round_marks(&GridInput { bounds, base_step_size: 1.0 });
            assert!((2..=7).contains(&marks.len()), "{bounds:?}: {marks:?}");
            for mark in &marks {
                let count = mark.value / mark.step_size;
                assert!(
                    (count - count.round()).abs() < 1e-9 && (bounds.0..=bounds.1).contains(&mark.value),
                    "{mark:?}"
                );
            }
        }
    }
}
