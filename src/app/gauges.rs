//! What is measured while the sea runs, and only while somebody looks: how long the passes take, and what the maps hold.
//! Nothing here waits for the GPU; what it gives back arrives in a later frame.

use super::{App, tasks};
use crate::ocean::{Ocean, Probe, Probed};
use crate::waves::map_spectrum::{MapSpectrum, MapSpectrumEstimator};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Between two readings of the maps, s.
const EVERY_S: f64 = 1.0;
/// Points of the maps that are transformed in one frame: a few milliseconds in a browser.
const POINTS_A_FRAME: usize = 1 << 16;
/// Bins of the measured spectrum.
const BINS: usize = 72;
/// Share of a new frame in the smoothed time of recording.
const SHARE: f64 = 0.1;

/// What is measured only because somebody looks at it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Look {
    /// The record of a buoy.
    Record,
    /// What the maps hold.
    Maps,
    /// Times of the passes.
    Times,
}

impl Look {
    fn id(self) -> egui::Id {
        egui::Id::unique(("looked at", self))
    }
}

/// Notes that something is shown in this frame.
pub fn looked_at(ctx: &egui::Context, what: Look) {
    let frame = ctx.cumulative_frame_nr();
    ctx.data_mut(|d| d.insert_temp(what.id(), frame));
}

/// Whether it was shown in the last frame.
pub fn is_looked_at(ctx: &egui::Context, what: Look) -> bool {
    let frame: Option<u64> = ctx.data(|d| d.get_temp(what.id()));
    frame.is_some_and(|f| ctx.cumulative_frame_nr() <= f + 1)
}

/// What the app and the frames that it records tell one another.
#[derive(Clone, Default)]
pub struct Gauges(Arc<Mutex<Inner>>);

#[derive(Default)]
struct Inner {
    wants_times: bool,
    /// Of which sea, see [`Measured`].
    wants_probe: Option<u64>,
    /// Copies that the last frame recorded.
    probe: Option<(u64, Probe)>,
    /// Whether the last frame was painted: only then it was submitted, too.
    is_painted: bool,
    /// Time that the CPU takes to record a frame, s, smoothed.
    record_s: f64,
    /// Whether the GPU tells, and what, ms.
    passes: Option<Vec<(&'static str, f64)>>,
}

impl Gauges {
    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Before a frame is recorded.
    pub fn begin(&self, ocean: &Ocean, encoder: &mut wgpu::CommandEncoder) {
        let mut inner = self.inner();
        let is_submitted = std::mem::take(&mut inner.is_painted);
        // What was recorded and never submitted, because the window had nothing to paint on, holds nothing.
        if !is_submitted && let Some((sea, _)) = inner.probe.take() {
            inner.wants_probe = Some(sea);
        }
        if inner.wants_times {
            ocean.timer().begin(encoder, is_submitted);
        }
    }

    /// After it, `record_s` later; `is_whole` if nothing of the picture is still on its way.
    pub fn end(&self, ocean: &Ocean, encoder: &mut wgpu::CommandEncoder, record_s: f64, is_whole: bool) {
        let mut inner = self.inner();
        ocean.timer().end(encoder);
        inner.record_s =
            if inner.record_s > 0.0 { inner.record_s + SHARE * (record_s - inner.record_s) } else { record_s };
        inner.passes = ocean.timer().is_available().then(|| ocean.timer().times());
        if is_whole && let Some(sea) = inner.wants_probe {
            inner.probe = ocean.probe(encoder).map(|probe| (sea, probe));
            inner.wants_probe = inner.probe.is_none().then_some(sea);
        }
    }

    /// The frame is painted.
    pub fn painted(&self) {
        self.inner().is_painted = true;
    }

    /// Time that the CPU takes to record a frame, ms.
    pub fn record_ms(&self) -> f64 {
        1e3 * self.inner().record_s
    }

    /// Time of each pass on the GPU, ms; None if it does not tell.
    pub fn passes(&self) -> Option<Vec<(&'static str, f64)>> {
        self.inner().passes.clone()
    }
}

/// What was read from the maps of the sea at hand: means over some moments.
#[derive(Default)]
pub struct Measured {
    /// Which sea it is of; what arrives of another is thrown away.
    sea: u64,
    inbox: tasks::Inbox<(u64, Result<Probed, String>)>,
    /// A frame has been asked for copies, or they are on their way.
    waiting: bool,
    estimate: Option<(MapSpectrumEstimator, Probed)>,
    /// When the last reading was asked for: egui's time (s), and that of the sea.
    last: Option<(f64, f64)>,
    sums: Sums,
}

#[derive(Default)]
struct Sums {
    readings: f64,
    hs2_m2: f64,
    mss: f64,
    coverage: f64,
    width_rad_s: f64,
    bins_m2: Vec<f64>,
}

impl Measured {
    /// Forgets the sea: another one is drawn.
    pub fn clear(&mut self) {
        *self = Self { sea: self.sea + 1, inbox: self.inbox.clone(), ..Self::default() };
    }

    /// Number of moments that it is the mean of.
    pub fn readings(&self) -> usize {
        self.sums.readings as usize
    }

    fn mean(&self, sum: f64) -> Option<f64> {
        (self.sums.readings > 0.0).then(|| sum / self.sums.readings)
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

    /// S(omega): width of a bin (rad/s), and density in each (m^2 s).
    pub fn spectrum(&self) -> Option<(f64, Vec<f64>)> {
        let width = self.sums.width_rad_s;
        let unit = 1.0 / (self.sums.readings * width);
        (self.sums.readings > 0.0).then(|| (width, self.sums.bins_m2.iter().map(|sum| sum * unit).collect()))
    }

    fn add(&mut self, probed: &Probed, spectrum: &MapSpectrum, width_rad_s: f64) {
        let sums = &mut self.sums;
        sums.readings += 1.0;
        sums.hs2_m2 += 16.0 * spectrum.m0_m2;
        sums.mss += probed.mss;
        sums.coverage += probed.coverage;
        sums.width_rad_s = width_rad_s;
        sums.bins_m2.resize(spectrum.bins_m2.len(), 0.0);
        sums.bins_m2.iter_mut().zip(&spectrum.bins_m2).for_each(|(sum, x)| *sum += x);
    }
}

impl App {
    /// Another sea is drawn: what was measured of the last one counts no more.
    pub(super) fn forget_measured(&mut self) {
        self.measured.clear();
        let mut inner = self.gauges.inner();
        (inner.wants_probe, inner.probe) = (None, None);
    }

    /// Goes on with what is measured of the sea that is drawn.
    pub(super) fn measure(&mut self, ctx: &egui::Context) {
        let mut inner = self.gauges.inner();
        inner.wants_times = is_looked_at(ctx, Look::Times);
        // Submitted with the last frame.
        let probe = if inner.is_painted { inner.probe.take() } else { None };
        drop(inner);
        if let Some((sea, probe)) = probe {
            let (gpu, inbox, ctx) = (self.gpu(), self.measured.inbox.clone(), ctx.clone());
            tasks::spawn(async move { inbox.put((sea, probe.read(&gpu).await), &ctx) });
        }
        let end = super::plots::highest_omega(&self.derived.plan);
        let width = end / BINS as f64;
        for (of, probed) in self.measured.inbox.take() {
            if of != self.measured.sea {
                continue;
            }
            self.measured.waiting = false;
            match probed {
                Ok(probed) => {
                    self.measured.estimate = Some((MapSpectrumEstimator::new(&probed.plan, width, BINS), probed))
                }
                Err(reason) => {
                    let notice = format!("the sea was not measured: {reason}");
                    if self.notices.last() != Some(&notice) {
                        self.notices.push(notice);
                    }
                }
            }
        }
        if let Some((mut estimator, probed)) = self.measured.estimate.take() {
            ctx.request_repaint();
            match estimator.advance(&probed.plan, POINTS_A_FRAME, |cascade, z| probed.row(cascade, z)) {
                Some(spectrum) => self.measured.add(&probed, spectrum, width),
                None => self.measured.estimate = Some((estimator, probed)),
            }
        }
        let (now_s, t_s) = (ctx.input(|i| i.time), self.params.clock.t_s);
        let due = self.measured.last.is_none_or(|(at_s, of_s)| now_s > at_s + EVERY_S && of_s != t_s);
        if is_looked_at(ctx, Look::Maps) && due && !self.measured.waiting && self.measured.estimate.is_none() {
            self.gauges.inner().wants_probe = Some(self.measured.sea);
            (self.measured.waiting, self.measured.last) = (true, Some((now_s, t_s)));
            ctx.request_repaint();
        }
    }
}
