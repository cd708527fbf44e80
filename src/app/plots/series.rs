//! Plot of a buoy's record: the height of the sea at one point over time.

use super::super::App;
use super::{PLOT_COLOURS, PlotTable, fixed_plot};
use crate::app::language::{say, tr};
use egui_plot::{Line, PlotPoints};

/// Length of time before the current moment that the plot of the height record shows, s.
const PLOTTED_DURATION_S: f64 = 120.0;

impl App {
    /// Name and position (m east and south) of the place where the height is recorded: the first floating object, or
    /// below the camera.
    pub(super) fn record_label_and_position(&self) -> (&'static str, [f64; 2]) {
        match self.params.floating_objects.first() {
            Some(float) => (tr("the first floating object"), [float.x_m, float.z_m]),
            None => (tr("the point below the camera"), [self.params.camera.x_m, self.params.camera.z_m]),
        }
    }

    /// Extends the record of heights at [`Self::record_label_and_position`] to the current time, while there is a
    /// floating object or the plot is visible.
    pub(in crate::app) fn extend_height_record(&mut self) {
        let wanted = self.visible_readouts.height_record.take() || !self.params.floating_objects.is_empty();
        if !wanted || self.params.clock.paused && self.record.is_current(self.params.clock.t_s) {
            return;
        }
        let (_, place) = self.record_label_and_position();
        let (sea, level_m) = (self.derived.strongest_waves(), self.params.sea.still_water_level_m);
        let height = |t_s| sea.sample(place[0], place[1], t_s).height_m - level_m;
        self.record.advance(self.params.clock.t_s, place, height);
    }
}

/// Plots the last two minutes of the height record (at the first floating object or below the camera), and shows the
/// significant wave height of the record and of the spectrum. Returns the data as a table for a CSV file.
pub fn show_height_record_plot(app: &App, ui: &mut egui::Ui) -> PlotTable {
    let record = &app.record;
    let length_scale = app.length_scale();
    let until = record.samples().back().map_or(0.0, |s| s[0]);
    let from = until - PLOTTED_DURATION_S;
    let visible: Vec<[f64; 2]> =
        record.samples().iter().filter(|s| s[0] >= from).map(|s| [s[0], s[1] * length_scale.factor]).collect();
    let place = app.record_label_and_position().0;
    ui.weak(say!("Height at {place} over time, s; {unit}", place = place, unit = length_scale.unit));
    let half = (0.8 * app.derived.theoretical_statistics.hs_m * length_scale.factor).max(0.05);
    let plot = fixed_plot("series").include_x(from).include_x(until).include_y(-half).include_y(half);
    plot.show(ui, |plot| plot.line(Line::new(tr("height"), PlotPoints::from(visible)).color(PLOT_COLOURS[0])));
    let length = record.length_s();
    let hs = record.hs_m().map_or_else(|| tr("after 30 s").to_owned(), |hs| length_scale.format(hs, 2));
    ui.label(say!(
        "Hs of {length} s of record: {measured}; of the spectrum: {theory}",
        length = format!("{length:.0}"),
        measured = hs,
        theory = length_scale.format(app.derived.theoretical_statistics.hs_m, 2)
    ));
    let rows = record.samples().iter().map(|s| s.to_vec()).collect();
    PlotTable { name: "record.csv", heading: "t (s),height (m)".into(), rows }
}
