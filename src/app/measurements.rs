//! Measurements of the running sea: times of the GPU passes, and statistics of the wave maps. They are taken only while
//! the panel shows them. No frame waits for the GPU: results arrive in a later frame.

use super::{App, plots, tasks};
use crate::ocean::{MapStatistics, Ocean, PendingMapRead};
use crate::waves::map_spectrum::{MapSpectrum, MapSpectrumEstimator};
use std::cell::Cell;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use web_time::Instant;

/// Least time between two read-backs of the wave maps, s.
const READBACK_INTERVAL_S: f64 = 1.0;
/// Number of wave-map texels that the CPU Fourier-transforms in one frame; in a browser this takes a few milliseconds.
const TRANSFORMED_TEXELS_PER_FRAME: usize = 1 << 16;
/// Number of equally wide bins of the spectrum measured in the wave maps, from 0 to `plots::highest_omega`, rad/s.
const SPECTRUM_BINS: usize = 72;
/// Weight of the newest frame, 0 to 1, in the moving average of the CPU time that recording a frame's GPU commands
/// takes.
const RECORDING_TIME_SMOOTHING_WEIGHT: f64 = 0.1;

/// Flags of the parts of the panel whose numbers are measured only while they are visible. Drawing a part sets its
/// flag; the next frame reads and clears it.
#[derive(Default)]
pub struct VisibleReadouts {
    /// Whether the panel shows the plot of the height of the sea over time at the first floating object or below the
    /// camera.
    pub height_record: Cell<bool>,
    /// Whether the panel shows a plot or table of statistics measured in the GPU's wave maps.
    pub map_statistics: Cell<bool>,
    /// Whether the panel shows the GPU time of each pass of a frame (such as `rows`, `foam` or `mesh`).
    pub pass_times: Cell<bool>,
}

/// Requests for the GPU time of each pass of a frame and for copies of the wave maps, and the results of both. The
/// app's frame logic shares them with the paint callback, which records the frame's GPU commands.
#[derive(Clone, Default)]
pub struct FrameMeasurements(Arc<Mutex<FrameMeasurementState>>);

#[derive(Default)]
struct FrameMeasurementState {
    wants_times: bool,
    /// Serial number of the sea (see [`SeaMeasurement`]) whose wave maps the next frame is to copy for read-back;
    /// `None` without a request.
    wants_map_copies: Option<u64>,
    /// Serial number of a sea, and the copies of its wave maps that the last recorded frame makes for read-back.
    map_copies: Option<(u64, PendingMapRead)>,
    /// Completions of frames on the GPU, for adapters without timestamps.
    completions: Arc<Mutex<Completions>>,
    /// Whether the GPU's timestamps have ever given a frame's time.
    has_timestamps: bool,
    /// Tag and GPU time, s, of a frame, until [`FrameMeasurements::take_gpu_time`] takes them.
    gpu_time: Option<(u32, f64)>,
    /// Whether the last recorded frame was painted. A frame that is not painted is not submitted to the GPU, so its
    /// copies and times stay empty.
    is_painted: bool,
    /// Moving average of the CPU time that recording a frame's GPU commands takes, s.
    record_s: f64,
    /// Name and GPU time (ms, smoothed over frames) of each pass of a frame (such as `rows`, `foam` or `mesh`); `None`
    /// before the first frame or if the GPU has no timestamp queries.
    passes: Option<Vec<(&'static str, f64)>>,
}

/// When the GPU completed frames, from which follows how long it worked on each.
#[derive(Default)]
struct Completions {
    /// When the GPU completed the last frame.
    last: Option<Instant>,
    /// Tag and GPU time, s, of the last completed frame, until they are taken.
    gpu_time: Option<(u32, f64)>,
}

impl FrameMeasurements {
    fn lock(&self) -> MutexGuard<'_, FrameMeasurementState> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Starts to time a frame on the GPU if it has a `tag`, and each of its passes if the panel shows their times.
    /// Requests copies of the wave maps anew that were lost because their frame was not submitted. Call this before the
    /// frame's commands are recorded. [`Self::take_gpu_time`] returns the tag with the frame's time.
    pub fn begin_frame(&self, ocean: &Ocean, tag: Option<u32>) {
        let mut inner = self.lock();
        let is_submitted = std::mem::take(&mut inner.is_painted);
        // Copies of a frame that was never submitted are empty, so they are requested again.
        if !is_submitted && let Some((sea, _)) = inner.map_copies.take() {
            inner.wants_map_copies = Some(sea);
        }
        if inner.wants_times || tag.is_some() {
            ocean.timer().begin_frame(is_submitted, inner.wants_times, tag.unwrap_or_default());
        }
    }

    /// Ends the timing of a frame's GPU passes, and stores the latest times and `record_s`, the CPU time of recording
    /// the frame's commands, s. If copies of the wave maps were requested and `is_whole` (no replay of past foam and no
    /// cross-fade is in progress), records the commands that make them.
    pub fn end_frame(&self, ocean: &Ocean, encoder: &mut wgpu::CommandEncoder, record_s: f64, is_whole: bool) {
        let mut inner = self.lock();
        ocean.timer().end_frame(encoder);
        inner.record_s = if inner.record_s > 0.0 {
            inner.record_s + RECORDING_TIME_SMOOTHING_WEIGHT * (record_s - inner.record_s)
        } else {
            record_s
        };
        let timed = ocean.timer().take_frame_time();
        inner.has_timestamps |= timed.is_some();
        inner.gpu_time = timed.or_else(|| {
            let completed = inner.completions.lock().unwrap_or_else(PoisonError::into_inner).gpu_time.take();
            completed.filter(|_| !inner.has_timestamps)
        });
        inner.passes = ocean.timer().is_available().then(|| ocean.timer().part_times_ms());
        if is_whole && let Some(sea) = inner.wants_map_copies {
            inner.map_copies = ocean.record_map_copies(encoder).map(|probe| (sea, probe));
            inner.wants_map_copies = inner.map_copies.is_none().then_some(sea);
        }
    }

    /// Where the GPU tells no timestamps, measures how long it works on the frame that `encoder` records: from its
    /// submission, or the completion of the frame before it, to its completion. Natively a completion is noticed only
    /// at the next submission, which tells nothing.
    #[cfg_attr(not(target_arch = "wasm32"), expect(clippy::disallowed_methods, reason = "no browser runs this one"))]
    pub fn watch_completion(&self, encoder: &wgpu::CommandEncoder, tag: Option<u32>) {
        let (inner, Some(tag)) = (self.lock(), tag) else { return };
        if inner.has_timestamps || cfg!(not(target_arch = "wasm32")) {
            return;
        }
        let (completions, submitted) = (inner.completions.clone(), Instant::now());
        encoder.on_submitted_work_done(move || {
            let mut completions = completions.lock().unwrap_or_else(PoisonError::into_inner);
            let begun = completions.last.map_or(submitted, |last| last.max(submitted));
            let now = Instant::now();
            completions.last = Some(now);
            completions.gpu_time = Some((tag, now.duration_since(begun).as_secs_f64()));
        });
    }

    /// Tag and GPU time, s, of the last frame whose time became known, once.
    pub fn take_gpu_time(&self) -> Option<(u32, f64)> {
        self.lock().gpu_time.take()
    }

    /// Notes that the recorded frame was painted, and so will be submitted to the GPU.
    pub fn note_painted(&self) {
        self.lock().is_painted = true;
    }

    /// Moving average of the CPU time that recording a frame's GPU commands takes, ms.
    pub fn recording_time_ms(&self) -> f64 {
        1e3 * self.lock().record_s
    }

    /// Name and GPU time (ms, smoothed over frames) of each pass of a frame (such as `rows`, `foam` or `mesh`); `None`
    /// before the first frame or if the GPU has no timestamp queries.
    pub fn pass_times_ms(&self) -> Option<Vec<(&'static str, f64)>> {
        self.lock().passes.clone()
    }
}

/// Wave height, slope, foam coverage and spectrum measured in the GPU's maps of the current sea, as means over several
/// moments in time.
#[derive(Default)]
pub struct SeaMeasurement {
    /// Serial number of the current sea; each new sea increases it. Measurements of an earlier sea are discarded.
    sea_serial: u64,
    inbox: tasks::Inbox<(u64, Result<MapStatistics, String>)>,
    /// Whether a read-back of the wave maps was requested and its data have not arrived yet.
    readback_pending: bool,
    /// The read-back whose Fourier transform is in progress over several frames: the estimator of its frequency
    /// spectrum, and the maps that were read.
    pending_analysis: Option<(MapSpectrumEstimator, MapStatistics)>,
    /// When the last read-back was requested: time on egui's clock, and simulated time, both in s; `None` before the
    /// first.
    last_request_times_s: Option<(f64, f64)>,
    sums: StatisticSums,
}

/// Sums over the `readings` evaluated read-backs of the current sea: squared significant wave height, mean square
/// slope, foam coverage, and variance per frequency bin of width `width_rad_s`. Divided by `readings` they are means.
#[derive(Default)]
struct StatisticSums {
    readings: usize,
    hs2_m2: f64,
    mss: f64,
    coverage: f64,
    width_rad_s: f64,
    bin_variances_m2: Vec<f64>,
}

impl SeaMeasurement {
    /// Discards all measurements and gives the sea a new serial number, because another sea is drawn.
    fn clear(&mut self) {
        *self = Self { sea_serial: self.sea_serial + 1, inbox: self.inbox.clone(), ..Self::default() };
    }

    /// Number of evaluated read-backs of the current sea's wave maps, each at another simulated time; the statistics
    /// are their means.
    pub fn reading_count(&self) -> usize {
        self.sums.readings
    }

    fn mean(&self, sum: f64) -> Option<f64> {
        (self.sums.readings > 0).then(|| sum / self.sums.readings as f64)
    }

    /// Significant wave height measured in the GPU's wave maps, m; `None` before the first reading of the current sea.
    pub fn hs_m(&self) -> Option<f64> {
        self.mean(self.sums.hs2_m2).map(f64::sqrt)
    }

    /// Mean square slope measured in the GPU's wave maps, dimensionless; `None` before the first reading of the current
    /// sea.
    pub fn mss(&self) -> Option<f64> {
        self.mean(self.sums.mss)
    }

    /// Foam coverage, 0 to 1: mean over all cells of the GPU's foam map, nested squares around the camera, before the
    /// user's factor on the visible foam. `None` before the first reading.
    pub fn foam_coverage(&self) -> Option<f64> {
        self.mean(self.sums.coverage)
    }

    /// Frequency spectrum measured in the GPU's wave maps: width of a bin, rad/s, and mean variance density S(omega) in
    /// each bin, m^2 s. The first bin begins at frequency 0. `None` before the first reading.
    pub fn bin_width_and_spectrum(&self) -> Option<(f64, Vec<f64>)> {
        let width = self.sums.width_rad_s;
        let unit = self.mean(1.0)? / width;
        Some((width, self.sums.bin_variances_m2.iter().map(|sum| sum * unit).collect()))
    }

    fn add_reading(&mut self, probed: &MapStatistics, found: &MapSpectrum, width_rad_s: f64) {
        let sums = &mut self.sums;
        sums.readings += 1;
        sums.hs2_m2 += 16.0 * found.variance_m2;
        sums.mss += probed.mean_square_slope;
        sums.coverage += probed.mean_foam;
        sums.width_rad_s = width_rad_s;
        sums.bin_variances_m2.resize(found.bin_variances_m2.len(), 0.0);
        sums.bin_variances_m2.iter_mut().zip(&found.bin_variances_m2).for_each(|(sum, x)| *sum += x);
    }
}

impl App {
    /// Discards the statistics measured in the wave maps, pending requests for copies of the maps, and copies not yet
    /// read. Called when the sea changes, because these belong to the old sea.
    pub(super) fn discard_measurements(&mut self) {
        self.sea_measurement.clear();
        let mut inner = self.frame_measurements.lock();
        (inner.wants_map_copies, inner.map_copies) = (None, None);
    }

    /// Continues the measurement of the wave maps: takes finished read-backs, Fourier-transforms a part of one, and
    /// requests another while the panel shows the results.
    pub(super) fn advance_sea_measurement(&mut self, ctx: &egui::Context) {
        self.start_map_readback(ctx);
        let width = plots::highest_omega(&self.derived.plan) / SPECTRUM_BINS as f64;
        let measurement = &mut self.sea_measurement;
        for (sea, probed) in measurement.inbox.take() {
            if sea != measurement.sea_serial {
                continue;
            }
            measurement.readback_pending = false;
            match probed {
                Ok(probed) => {
                    measurement.pending_analysis =
                        Some((MapSpectrumEstimator::new(&probed.plan, width, SPECTRUM_BINS), probed));
                }
                Err(reason) => {
                    let notice = format!("the sea was not measured: {reason}");
                    if self.notices.last() != Some(&notice) {
                        self.notices.push(notice);
                    }
                }
            }
        }
        if let Some((mut pending_analysis, probed)) = measurement.pending_analysis.take() {
            ctx.request_repaint();
            match pending_analysis
                .advance(&probed.plan, TRANSFORMED_TEXELS_PER_FRAME, |cascade, z| probed.heights_in_row(cascade, z))
            {
                Some(found) => measurement.add_reading(&probed, found, width),
                None => measurement.pending_analysis = Some((pending_analysis, probed)),
            }
        }
        let (now_s, t_s) = (ctx.input(|i| i.time), self.params.clock.t_s);
        let due = measurement
            .last_request_times_s
            .is_none_or(|(at_s, of_s)| now_s > at_s + READBACK_INTERVAL_S && of_s != t_s);
        if self.visible_readouts.map_statistics.take()
            && due
            && !measurement.readback_pending
            && measurement.pending_analysis.is_none()
        {
            self.frame_measurements.lock().wants_map_copies = Some(measurement.sea_serial);
            (measurement.readback_pending, measurement.last_request_times_s) = (true, Some((now_s, t_s)));
            ctx.request_repaint();
        }
    }

    /// Starts reading back the copies of the wave maps that the last frame recorded, if that frame was submitted.
    fn start_map_readback(&self, ctx: &egui::Context) {
        let mut inner = self.frame_measurements.lock();
        inner.wants_times = self.visible_readouts.pass_times.take();
        let probe = if inner.is_painted { inner.map_copies.take() } else { None };
        drop(inner);
        if let Some((sea, probe)) = probe {
            let (gpu, inbox, ctx) = (self.gpu(), self.sea_measurement.inbox.clone(), ctx.clone());
            tasks::spawn(async move { inbox.put((sea, probe.read(&gpu).await), &ctx) });
        }
    }
}
