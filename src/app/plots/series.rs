//! The height of the sea at one point over time, as a wave buoy records it: its running significant height and spectrum.

use super::super::App;
use super::super::units::Scale;
use super::{COLOURS, HEIGHT, Table};
use crate::waves::record;
use egui_plot::{Line, Plot, PlotPoints};
use std::collections::VecDeque;

/// Samples a second.
const RATE_HZ: f64 = 4.0;
/// Length of the record, s: half an hour, as buoys keep it.
const LENGTH_S: f64 = 1800.0;
/// Length of what is plotted, s.
const SHOWN_S: f64 = 120.0;
/// A longer gap than this is another record, s.
const LONGEST_GAP_S: f64 = 5.0;

/// A record at one place.
#[derive(Default)]
pub struct Series {
    /// Where, m east and south.
    place: [f64; 2],
    /// Time and height above the still water, s and m.
    samples: VecDeque<[f64; 2]>,
    /// omega and S(omega) of the record, and how many samples it was made of.
    spectrum: (Vec<[f64; 2]>, usize),
}

impl Series {
    /// Takes the heights since the last time, at a fixed rate, whatever the frame rate is.
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

    /// Whether nothing is missing up to a time.
    pub fn is_current(&self, t_s: f64) -> bool {
        self.samples.back().is_some_and(|last| (0.0..1.0 / RATE_HZ).contains(&(t_s - last[0])))
    }

    /// Begins anew: another sea.
    pub fn clear(&mut self) {
        self.samples.clear();
        self.spectrum = (Vec::new(), 0);
    }

    /// 4 standard deviations of the record, m.
    pub fn hs_m(&self) -> Option<f64> {
        let n = self.samples.len() as f64;
        if n < 30.0 * RATE_HZ {
            return None;
        }
        let mean = self.samples.iter().map(|s| s[1]).sum::<f64>() / n;
        Some(4.0 * (self.samples.iter().map(|s| (s[1] - mean).powi(2)).sum::<f64>() / n).sqrt())
    }

    /// omega (rad/s) and S(omega) (m^2 s) of the record, once it is long enough.
    pub fn spectrum(&self) -> &[[f64; 2]] {
        &self.spectrum.0
    }
}

/// The last two minutes, and the record's numbers.
pub fn show(app: &App, ui: &mut egui::Ui) -> Table {
    let series = &app.series;
    let metres = Scale::of("m", app.params.screen.units);
    let until = series.samples.back().map_or(0.0, |s| s[0]);
    let from = until - SHOWN_S;
    let shown: Vec<[f64; 2]> =
        series.samples.iter().filter(|s| s[0] >= from).map(|s| [s[0], s[1] * metres.factor]).collect();
    ui.weak(format!("Height at {} over time, s; {}", app.series_place().0, metres.unit));
    let half = (0.8 * app.derived.theory.hs_m * metres.factor).max(0.05);
    let plot = Plot::new("series")
        .height(HEIGHT)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .include_x(from)
        .include_x(until)
        .include_y(-half)
        .include_y(half);
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
