//! Measurements of the running sea, taken only while the panel shows them: times of the GPU passes, and statistics of
//! the maps. No frame waits for the GPU; its results arrive in a later frame.

use super::{App, plots, tasks};
use crate::ocean::{Ocean, Probe, Probed};
use crate::waves::map_spectrum::{MapSpectrum, MapSpectrumEstimator};
use std::cell::Cell;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Least time between two readings of the maps, s.
const EVERY_S: f64 = 1.0;
/// Points of the maps that one frame transforms: a few milliseconds in a browser.
const POINTS_PER_FRAME: usize = 1 << 16;
/// Bins of the measured spectrum.
const BINS: usize = 72;
/// Weight of a new frame in the smoothed recording time.
const SMOOTHING: f64 = 0.1;

/// Read-outs that cost work only while they are visible. Drawing one sets its flag, and the next frame takes the flag.
#[derive(Default)]
pub struct Shown {
    /// The record of a buoy.
    pub record: Cell<bool>,
    /// The statistics of the maps.
    pub maps: Cell<bool>,
    /// The times of the passes.
    pub times: Cell<bool>,
}

/// Requests and results that the app exchanges with the frames it records.
#[derive(Clone, Default)]
pub struct FrameMeasurements(Arc<Mutex<Inner>>);

#[derive(Default)]
struct Inner {
    wants_times: bool,
    /// Number of the sea whose maps the next frame copies, see [`SeaMeasurement`].
    wants_probe: Option<u64>,
    /// Copies that the last frame recorded.
    probe: Option<(u64, Probe)>,
    /// Whether the last frame was painted, because only then it was submitted.
    is_painted: bool,
    /// Smoothed CPU time of recording a frame, s.
    record_s: f64,
    /// Time of each pass, ms; None without timestamp queries.
    passes: Option<Vec<(&'static str, f64)>>,
}

impl FrameMeasurements {
    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Call before a frame is recorded.
    pub fn begin(&self, ocean: &Ocean, encoder: &mut wgpu::CommandEncoder) {
        let mut inner = self.inner();
        let is_submitted = std::mem::take(&mut inner.is_painted);
        // Copies of a frame that was never submitted are empty: they are requested again.
        if !is_submitted && let Some((sea, _)) = inner.probe.take() {
            inner.wants_probe = Some(sea);
        }
        if inner.wants_times {
            ocean.timer().begin(encoder, is_submitted);
        }
    }

    /// Call after a frame was recorded in `record_s`; `is_whole` if no foam replay and no cross-fade is in progress.
    pub fn end(&self, ocean: &Ocean, encoder: &mut wgpu::CommandEncoder, record_s: f64, is_whole: bool) {
        let mut inner = self.inner();
        ocean.timer().end(encoder);
        inner.record_s =
            if inner.record_s > 0.0 { inner.record_s + SMOOTHING * (record_s - inner.record_s) } else { record_s };
        inner.passes = ocean.timer().is_available().then(|| ocean.timer().times());
        if is_whole && let Some(sea) = inner.wants_probe {
            inner.probe = ocean.probe(encoder).map(|probe| (sea, probe));
            inner.wants_probe = inner.probe.is_none().then_some(sea);
        }
    }

    /// Call when the frame is painted.
    pub fn painted(&self) {
        self.inner().is_painted = true;
    }

    /// Smoothed CPU time of recording a frame, ms.
    pub fn record_ms(&self) -> f64 {
        1e3 * self.inner().record_s
    }

    /// Time of each pass on the GPU, ms; None without timestamp queries.
    pub fn passes(&self) -> Option<Vec<(&'static str, f64)>> {
        self.inner().passes.clone()
    }
}

/// Statistics read from the maps of the current sea: means over several moments.
#[derive(Default)]
pub struct SeaMeasurement {
    /// Number of the current sea; readings of an earlier sea are discarded.
    sea: u64,
    inbox: tasks::Inbox<(u64, Result<Probed, String>)>,
    /// Whether a read-back of the maps has been requested and has not arrived.
    waiting: bool,
    /// The reading that is being transformed.
    survey: Option<(MapSpectrumEstimator, Probed)>,
    /// egui's time and the sea's time of the last request, s.
    last: Option<(f64, f64)>,
    sums: Sums,
}

/// Sums over the readings.
#[derive(Default)]
struct Sums {
    readings: usize,
    hs2_m2: f64,
    mss: f64,
    coverage: f64,
    width_rad_s: f64,
    bins_m2: Vec<f64>,
}

impl SeaMeasurement {
    /// Discards everything: another sea is drawn.
    fn clear(&mut self) {
        *self = Self { sea: self.sea + 1, inbox: self.inbox.clone(), ..Self::default() };
    }

    /// Number of moments that the means are taken over.
    pub fn readings(&self) -> usize {
        self.sums.readings
    }

    fn mean(&self, sum: f64) -> Option<f64> {
        (self.sums.readings > 0).then(|| sum / self.sums.readings as f64)
    }

    /// Significant wave height, m.
    pub fn hs_m(&self) -> Option<f64> {
        self.mean(self.sums.hs2_m2).map(f64::sqrt)
    }

    /// Mean square slope.
    pub fn mss(&self) -> Option<f64> {
        self.mean(self.sums.mss)
    }

    /// Share of the sea around the camera that foam covers.
    pub fn coverage(&self) -> Option<f64> {
        self.mean(self.sums.coverage)
    }

    /// Width of a frequency bin (rad/s), and S(omega) in each bin (m^2 s).
    pub fn spectrum(&self) -> Option<(f64, Vec<f64>)> {
        let width = self.sums.width_rad_s;
        let unit = self.mean(1.0)? / width;
        Some((width, self.sums.bins_m2.iter().map(|sum| sum * unit).collect()))
    }

    fn add(&mut self, probed: &Probed, found: &MapSpectrum, width_rad_s: f64) {
        let sums = &mut self.sums;
        sums.readings += 1;
        sums.hs2_m2 += 16.0 * found.m0_m2;
        sums.mss += probed.mss;
        sums.coverage += probed.coverage;
        sums.width_rad_s = width_rad_s;
        sums.bins_m2.resize(found.bins_m2.len(), 0.0);
        sums.bins_m2.iter_mut().zip(&found.bins_m2).for_each(|(sum, x)| *sum += x);
    }
}

impl App {
    /// Discards the measurement, because another sea is drawn.
    pub(super) fn forget_measurement(&mut self) {
        self.sea_measurement.clear();
        let mut inner = self.frame_measurements.inner();
        (inner.wants_probe, inner.probe) = (None, None);
    }

    /// Continues the measurements that the panel shows.
    pub(super) fn measure(&mut self, ctx: &egui::Context) {
        self.read_probe(ctx);
        let width = plots::highest_omega(&self.derived.plan) / BINS as f64;
        let measurement = &mut self.sea_measurement;
        for (sea, probed) in measurement.inbox.take() {
            if sea != measurement.sea {
                continue;
            }
            measurement.waiting = false;
            match probed {
                Ok(probed) => measurement.survey = Some((MapSpectrumEstimator::new(&probed.plan, width, BINS), probed)),
                Err(reason) => {
                    let notice = format!("the sea was not measured: {reason}");
                    if self.notices.last() != Some(&notice) {
                        self.notices.push(notice);
                    }
                }
            }
        }
        if let Some((mut survey, probed)) = measurement.survey.take() {
            ctx.request_repaint();
            match survey.advance(&probed.plan, POINTS_PER_FRAME, |cascade, z| probed.row(cascade, z)) {
                Some(found) => measurement.add(&probed, found, width),
                None => measurement.survey = Some((survey, probed)),
            }
        }
        let (now_s, t_s) = (ctx.input(|i| i.time), self.params.clock.t_s);
        let due = measurement.last.is_none_or(|(at_s, of_s)| now_s > at_s + EVERY_S && of_s != t_s);
        if self.shown.maps.take() && due && !measurement.waiting && measurement.survey.is_none() {
            self.frame_measurements.inner().wants_probe = Some(measurement.sea);
            (measurement.waiting, measurement.last) = (true, Some((now_s, t_s)));
            ctx.request_repaint();
        }
    }

    /// Starts reading the copies that the last frame recorded, if it was submitted.
    fn read_probe(&self, ctx: &egui::Context) {
        let mut inner = self.frame_measurements.inner();
        inner.wants_times = self.shown.times.take();
        let probe = if inner.is_painted { inner.probe.take() } else { None };
        drop(inner);
        if let Some((sea, probe)) = probe {
            let (gpu, inbox, ctx) = (self.gpu(), self.sea_measurement.inbox.clone(), ctx.clone());
            tasks::spawn(async move { inbox.put((sea, probe.read(&gpu).await), &ctx) });
        }
    }
}
