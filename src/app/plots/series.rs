//! The record of a buoy: the height of the sea at one point over time, with its significant wave height and spectrum.

use super::super::App;
use super::{COLOURS, Table, fixed_plot};
use crate::waves::record;
use egui_plot::{Line, PlotPoints};
use std::collections::VecDeque;

/// Samples per second.
const RATE_HZ: f64 = 4.0;
/// Length of the record, s: the half hour that is usual for buoys.
const LENGTH_S: f64 = 1800.0;
/// Length of the plot, s.
const SHOWN_S: f64 = 120.0;
/// Longest gap within a record, s; after a longer one a new record starts.
const LONGEST_GAP_S: f64 = 5.0;

/// A record at one place.
#[derive(Default)]
pub struct Series {
    /// Position, m east and south.
    place: [f64; 2],
    /// Time and height above the still water, s and m.
    samples: VecDeque<[f64; 2]>,
    /// omega and S(omega) of the record, and the number of samples they were computed from.
    spectrum: (Vec<[f64; 2]>, usize),
}

impl Series {
    /// Samples the heights since the last call at a fixed rate, independent of the frame rate.
    pub fn advance(&mut self, t_s: f64, place: [f64; 2], height: impl Fn(f64) -> f64) {
        let moved = place != self.place;
        let last = self.samples.back().map(|s| s[0]);
        let jumped = last.is_some_and(|last| t_s < last || t_s - last > LONGEST_GAP_S);
        if moved || jumped || last.is_none() {
            *self = Self { place, ..Self::default() };
            let first = (t_s * RATE_HZ).floor() / RATE_HZ;
            self.samples.push_back([first, height(first)]);
            return;
        }
        let first = (last.unwrap_or(t_s) * RATE_HZ).round() as i64 + 1;
        for i in first..=(t_s * RATE_HZ).floor() as i64 {
            let t = i as f64 / RATE_HZ;
            self.samples.push_back([t, height(t)]);
        }
        while self.samples.len() > (LENGTH_S * RATE_HZ) as usize {
            self.samples.pop_front();
        }
        // A new spectrum every ten seconds.
        if self.samples.len() >= self.spectrum.1 + (10.0 * RATE_HZ) as usize {
            let heights: Vec<f64> = self.samples.iter().map(|s| s[1]).collect();
            self.spectrum = (record::spectrum(&heights, RATE_HZ), self.samples.len());
        }
    }

    /// Whether the record reaches a time.
    pub fn is_current(&self, t_s: f64) -> bool {
        self.samples.back().is_some_and(|last| (0.0..1.0 / RATE_HZ).contains(&(t_s - last[0])))
    }

    /// Clears the record for another sea.
    pub fn clear(&mut self) {
        self.samples.clear();
        self.spectrum = (Vec::new(), 0);
    }

    /// Significant wave height of the record, m: four standard deviations, after 30 s.
    pub fn hs_m(&self) -> Option<f64> {
        let n = self.samples.len() as f64;
        if n < 30.0 * RATE_HZ {
            return None;
        }
        let mean = self.samples.iter().map(|s| s[1]).sum::<f64>() / n;
        Some(4.0 * (self.samples.iter().map(|s| (s[1] - mean).powi(2)).sum::<f64>() / n).sqrt())
    }

    /// omega (rad/s) and S(omega) (m^2 s) of the record; empty at its start.
    pub fn spectrum(&self) -> &[[f64; 2]] {
        &self.spectrum.0
    }
}

impl App {
    /// The name of the place that is recorded, and its position, m east and south.
    fn record_place(&self) -> (&'static str, [f64; 2]) {
        match self.params.floats.first() {
            Some(float) => ("the first buoy", [float.x_m, float.z_m]),
            None => ("the camera's foot", [self.params.camera.x_m, self.params.camera.z_m]),
        }
    }

    /// Continues the record while there is a float or while the plot is shown.
    pub(in crate::app) fn record(&mut self) {
        let wanted = self.shown.record.take() || !self.params.floats.is_empty();
        if !wanted || self.params.clock.paused && self.series.is_current(self.params.clock.t_s) {
            return;
        }
        let (_, place) = self.record_place();
        let (sea, level_m) = (self.derived.heights(), self.params.sea.level_m);
        let height = |t_s| sea.sample(place[0], place[1], t_s).height_m - level_m;
        self.series.advance(self.params.clock.t_s, place, height);
    }
}

/// Draws the last two minutes and the significant wave height.
pub fn show(app: &App, ui: &mut egui::Ui) -> Table {
    let series = &app.series;
    let metres = app.metres();
    let until = series.samples.back().map_or(0.0, |s| s[0]);
    let from = until - SHOWN_S;
    let shown: Vec<[f64; 2]> =
        series.samples.iter().filter(|s| s[0] >= from).map(|s| [s[0], s[1] * metres.factor]).collect();
    ui.weak(format!("Height at {} over time, s; {}", app.record_place().0, metres.unit));
    let half = (0.8 * app.derived.theory.hs_m * metres.factor).max(0.05);
    let plot = fixed_plot("series").include_x(from).include_x(until).include_y(-half).include_y(half);
    plot.show(ui, |plot| plot.line(Line::new("height", PlotPoints::from(shown)).color(COLOURS[0])));
    let length = series.samples.len() as f64 / RATE_HZ;
    let hs = series.hs_m().map_or_else(|| "after 30 s".to_owned(), |hs| metres.text(hs, 2));
    ui.label(format!(
        "Hs of {length:.0} s of record: {hs}; of the spectrum: {}",
        metres.text(app.derived.theory.hs_m, 2)
    ));
    let rows = series.samples.iter().map(|s| s.to_vec()).collect();
    Table { name: "record.csv", heading: "t (s),height (m)".into(), rows }
}
