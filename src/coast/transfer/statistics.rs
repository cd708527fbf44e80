//! Mean statistics of the sea that a transfer draws: wave height, direction, period and breaking at its points, and
//! the spectrum at single ones. It needs no time series.
//!
//! The drawn surface at a point is `weight` times the waves of the transfer, (1 - `weight`) `short_gain` times the same
//! waves of the open sea, and `short_gain` times all other waves ([`SeaAtPoint`]). So a wave of the transfer with the
//! expected variance E has the variance E |weight T + (1 - weight) short_gain e^(i k x)|^2 there, and all others have
//! the rest of the open sea's variance times `short_gain`^2.
//!
//! The transfer holds the strongest of the random waves, so that these are stronger than the spectrum says. The
//! variance of a random wave has an exponential distribution with the mean E0, the spectral density times the cell of
//! its wave vector. Of a wave that has at least the variance c, E0 + c is expected: the distribution has no memory. c
//! is that of the weakest wave of the transfer.

use super::envelopes::mean_drawn;
use super::half_float::unpack;
use super::{SeaAtPoint, Transfer};
use crate::coast::bathymetry::Bathymetry;
use crate::coast::complex::Complex;
use crate::coast::local_wave::LocalWave;
use crate::coast::sea_maps::{BAND_RATIO, SeaMaps};
use crate::waves::Plan;
use crate::waves::statistics::{initial_amplitude, lattice_indices};
use crate::waves::table::{SpectrumTable, entry_index};
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

/// Statistics of the sea that a transfer draws.
#[derive(Clone, Debug)]
pub struct TransferStatistics {
    /// Depths at the points of the transfer.
    pub bathymetry: Bathymetry,
    /// Statistics at these points. The breaking fraction is that of the waves of the transfer.
    pub maps: SeaMaps,
    sea: OpenSea,
}

/// A frequency of the spectrum at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumBand {
    /// Mean angular frequency of the waves of the band in the open sea, rad/s.
    pub omega_rad_s: f64,
    /// Variance of the open sea in the band, m^2.
    pub open_m2: f64,
    /// Variance at the point, m^2.
    pub here_m2: f64,
}

impl SpectrumBand {
    /// Variance at the point divided by that of the open sea.
    pub fn share(&self) -> f64 {
        self.here_m2.max(0.0) / self.open_m2
    }
}

/// The waves of the open sea: those of a transfer, and the sums of all others.
#[derive(Clone, Debug)]
struct OpenSea {
    transfer: Arc<Transfer>,
    gravity_m_s2: f64,
    waves: Vec<ExpectedWave>,
    bands: Vec<Band>,
    /// Variance of the other waves, m^2.
    rest_m2: f64,
    /// Their energy flux along the axes of the coast's frame, m^3/s: variance times group velocity.
    rest_flux_m3_s: [f64; 2],
}

/// A wave of the transfer.
#[derive(Clone, Copy, Debug)]
struct ExpectedWave {
    /// Expected variance in the open sea, m^2.
    variance_m2: f64,
    omega_rad_s: f64,
    band: usize,
    /// Wave vector in the open sea along the axes of the coast's frame, rad/m.
    k_rad_m: [f64; 2],
    /// Phase of the wave of the open sea at the origin of the frame, rad.
    origin_phase_rad: f64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Band {
    omega_rad_s: f64,
    open_m2: f64,
    rest_m2: f64,
}

impl OpenSea {
    /// The waves of `plan`; `None` if the transfer was made for another lattice of waves.
    fn new(transfer: Arc<Transfer>, plan: &Plan) -> Option<Self> {
        if !transfer.fits(plan) {
            return None;
        }
        let lowest = plan.dispersion.omega(plan.cascades.iter().map(|c| c.dk()).fold(f64::INFINITY, f64::min));
        let band_of = |omega: f64| ((omega / lowest).ln() / BAND_RATIO.ln()).max(0.0) as usize;
        let mut bands: Vec<Band> = Vec::new();
        let mut flux = [0.0; 2];
        for (cascade, table) in plan.cascades.iter().zip(SpectrumTable::for_all_cascades(plan)) {
            for (ix, iz) in lattice_indices(plan.n) {
                let wave = &table.waves[entry_index(ix, iz)];
                let variance_m2 = 4.0 * table.variance(ix, iz);
                if wave.k <= 0.0 || variance_m2 <= 0.0 {
                    continue;
                }
                let band = band_of(wave.omega);
                bands.resize(bands.len().max(band + 1), Band::default());
                bands[band].open_m2 += variance_m2;
                bands[band].omega_rad_s += variance_m2 * wave.omega;
                let per_k = variance_m2 * plan.dispersion.group_velocity(wave.k) / wave.k * cascade.dk();
                flux = [flux[0] + per_k * f64::from(ix), flux[1] + per_k * f64::from(iz)];
            }
        }
        for band in &mut bands {
            band.omega_rad_s /= band.open_m2.max(f64::MIN_POSITIVE);
            band.rest_m2 = band.open_m2;
        }
        let mut rest_flux = transfer.placement.turned_into_frame(flux);
        let mut waves = expected_waves(&transfer, plan, band_of);
        for wave in &mut waves {
            wave.k_rad_m = transfer.placement.turned_into_frame(wave.k_rad_m);
            let k = wave.k_rad_m[0].hypot(wave.k_rad_m[1]);
            let per_k = wave.variance_m2 * plan.dispersion.group_velocity(k) / k;
            rest_flux = [0, 1].map(|axis| rest_flux[axis] - per_k * wave.k_rad_m[axis]);
            if let Some(band) = bands.get_mut(wave.band) {
                band.rest_m2 -= wave.variance_m2;
            }
        }
        Some(Self {
            gravity_m_s2: plan.sea.gravity_m_s2,
            waves,
            rest_m2: bands.iter().map(|band| band.rest_m2).sum(),
            rest_flux_m3_s: rest_flux,
            bands,
            transfer,
        })
    }
}

/// The waves of a transfer with their expected variances and, for now, with wave vectors along the axes of the world.
fn expected_waves(transfer: &Transfer, plan: &Plan, band_of: impl Fn(f64) -> usize) -> Vec<ExpectedWave> {
    let Some(cascade) = plan.cascades.first() else { return Vec::new() };
    let table = SpectrumTable::new(plan, cascade);
    let half = plan.n as i32 / 2;
    let is_held = |[ix, iz]: [i32; 2]| ix.abs() < half && iz.abs() < half && table.variance(ix, iz) > 0.0;
    let drawn_m2 = |[ix, iz]: [i32; 2]| {
        let [re, im] = initial_amplitude(plan, cascade, &table, ix, iz);
        2.0 * (re * re + im * im)
    };
    let indices = || transfer.waves.iter().map(|wave| wave.lattice_index);
    let weakest_m2 = indices().filter(|index| is_held(*index)).map(drawn_m2).fold(f64::INFINITY, f64::min);
    let origin_m = transfer.placement.origin_m;
    indices()
        .map(|[ix, iz]| {
            let k_rad_m = [ix, iz].map(|index| f64::from(index) * cascade.dk());
            let omega_rad_s = plan.wave_at_squared_index(cascade, (ix * ix + iz * iz) as u32).omega;
            let held = is_held([ix, iz]);
            ExpectedWave {
                variance_m2: if held { 4.0 * table.variance(ix, iz) + weakest_m2 } else { 0.0 },
                omega_rad_s,
                band: band_of(omega_rad_s),
                k_rad_m,
                origin_phase_rad: k_rad_m[0] * origin_m[0] + k_rad_m[1] * origin_m[1],
            }
        })
        .collect()
}

/// Computes [`TransferStatistics`] in small steps: a step takes about a millisecond, so that a program with one thread
/// can draw frames between steps. All steps together take about 40 ns for each wave and point.
pub struct StatisticsSolver {
    sea: OpenSea,
    next_wave: usize,
    /// Variance of the waves of the transfer at each point, m^2.
    held_m2: Vec<f64>,
    /// Their energy flux along the axes of the frame, m^3/s.
    flux_m3_s: Vec<[f64; 2]>,
    /// Their variance in each of their bands, m^2: \[band\]\[point\].
    band_m2: Vec<f32>,
    /// The bands of the waves of the transfer.
    held_bands: Range<usize>,
}

impl StatisticsSolver {
    /// Prepares the statistics of the sea that `transfer` draws with the waves of `plan`; `None` if it was made for
    /// another lattice of waves. This sums up all waves of the plan, which takes about 20 ms at n = 256.
    pub fn new(transfer: Arc<Transfer>, plan: &Plan) -> Option<Self> {
        let sea = OpenSea::new(transfer, plan)?;
        let points = sea.transfer.points.len();
        let of_waves = || sea.waves.iter().filter(|wave| wave.variance_m2 > 0.0).map(|wave| wave.band);
        let held_bands = of_waves().min().unwrap_or(0)..of_waves().max().map_or(0, |last| last + 1);
        Some(Self {
            next_wave: 0,
            held_m2: vec![0.0; points],
            flux_m3_s: vec![[0.0; 2]; points],
            band_m2: vec![0.0; points * held_bands.len()],
            held_bands,
            sea,
        })
    }

    /// Adds the next wave. Returns the fraction of the work that is done, 1 at the end.
    pub fn step(&mut self) -> f64 {
        if let Some(wave) = self.sea.waves.get(self.next_wave) {
            if wave.variance_m2 > 0.0 {
                self.add_wave(self.next_wave);
            }
            self.next_wave += 1;
        }
        if self.next_wave < self.sea.waves.len() { self.next_wave as f64 / self.sea.waves.len() as f64 } else { 1.0 }
    }

    /// Does all remaining steps. Returns the statistics.
    pub fn finish(mut self) -> TransferStatistics {
        while self.step() < 1.0 {}
        let transfer = self.sea.transfer.clone();
        let count = transfer.points.len();
        let mut maps = SeaMaps {
            hs_m: vec![0.0; count],
            direction_rad: vec![0.0; count],
            peak_period_s: vec![0.0; count],
            breaking_fraction: vec![0.0; count],
        };
        let (sea, peak_rad_s) = (&self.sea, self.peaks_rad_s());
        for (index, point) in transfer.points.iter().enumerate().filter(|(_, point)| point.depth_m > 0.0) {
            let rest_gain = f64::from(point.short_gain).powi(2);
            let held_m2 = self.held_m2[index];
            let m0 = held_m2 + rest_gain * sea.rest_m2;
            if m0 <= 0.0 {
                continue;
            }
            let [x, y] = [0, 1].map(|axis| self.flux_m3_s[index][axis] + rest_gain * sea.rest_flux_m3_s[axis]);
            maps.hs_m[index] = (4.0 * m0.sqrt()) as f32;
            maps.direction_rad[index] = y.atan2(x) as f32;
            maps.peak_period_s[index] = (TAU / peak_rad_s[index]) as f32;
            maps.breaking_fraction[index] = breaking_fraction(point, held_m2) as f32;
        }
        let bathymetry = Bathymetry {
            columns: transfer.columns,
            rows: transfer.rows,
            cell_m: transfer.cell_m,
            depth_m: transfer.points.iter().map(|point| point.depth_m).collect(),
        };
        TransferStatistics { bathymetry, maps, sea: self.sea }
    }

    /// Angular frequency of the strongest band at each point, rad/s.
    fn peaks_rad_s(&self) -> Vec<f64> {
        let (sea, points) = (&self.sea, &self.sea.transfer.points);
        // Among the bands without waves of the transfer, the strongest one is the same everywhere.
        let without = sea.bands.iter().enumerate().filter(|(b, _)| !self.held_bands.contains(b));
        let of_rest = without.map(|(_, band)| [band.rest_m2, band.omega_rad_s]).fold([0.0; 2], stronger);
        let gain = |point: &SeaAtPoint| f64::from(point.short_gain).powi(2);
        let mut peaks: Vec<[f64; 2]> = points.iter().map(|p| [gain(p) * of_rest[0], of_rest[1]]).collect();
        for (band, held) in sea.bands[self.held_bands.clone()].iter().zip(self.band_m2.chunks(points.len().max(1))) {
            for ((peak, point), held_m2) in peaks.iter_mut().zip(points).zip(held) {
                *peak = stronger(*peak, [f64::from(*held_m2) + gain(point) * band.rest_m2, band.omega_rad_s]);
            }
        }
        peaks.into_iter().map(|[_, omega]| omega).collect()
    }

    fn add_wave(&mut self, index: usize) {
        let (sea, transfer) = (&self.sea, &*self.sea.transfer);
        let (wave, columns, rows) = (&sea.waves[index], transfer.columns, transfer.rows);
        let count = columns * rows;
        let band = (wave.band - self.held_bands.start) * count;
        let cell_m = transfer.cell_m;
        let group = &transfer.groups[transfer.waves[index].group as usize];
        let envelope = &transfer.envelopes[index * count..(index + 1) * count];
        let unpacked = |j: usize| -> Vec<Complex> {
            envelope[j * columns..(j + 1) * columns].iter().map(|bits| unpack(*bits)).collect()
        };
        let phasors = |steps: usize, phase: &dyn Fn(usize) -> f64| -> Vec<Complex> {
            (0..steps).map(|i| Complex::polar(1.0, phase(i))).collect()
        };
        let phases = &group.column_phase_rad;
        let carrier_x = phasors(columns, &|i| phases[i]);
        let open_x = phasors(columns, &|i| wave.origin_phase_rad + wave.k_rad_m[0] * cell_m * i as f64);
        let kx: Vec<f64> = (0..columns).map(|i| slope(phases, i, cell_m)).collect();
        let [mut below, mut here] = [unpacked(0), unpacked(0)];
        for j in 0..rows {
            let above = unpacked((j + 1).min(rows - 1));
            let y_m = j as f64 * cell_m;
            let carrier_y = Complex::polar(1.0, group.ky_rad_m * y_m);
            let open_y = Complex::polar(1.0, wave.k_rad_m[1] * y_m);
            let per_y_m = 1.0 / (cell_m * if j == 0 || j + 1 == rows { 1.0 } else { 2.0 });
            for i in 0..columns {
                let point = &transfer.points[j * columns + i];
                if point.depth_m <= 0.0 {
                    continue;
                }
                let (low, high) = (i.saturating_sub(1), (i + 1).min(columns - 1));
                let drawn = |at: usize| [&below, &here, &above][at / columns + 1 - j][at % columns];
                let is_open = |at: usize| transfer.is_open(at);
                let mut value = mean_drawn(j * columns + i, [columns, rows], is_open, drawn);
                let along_x = (here[high] - here[low]) * (1.0 / (cell_m * (high - low) as f64));
                let along_y = (above[i] - below[i]) * per_y_m;
                let mut gradient =
                    [along_x + Complex::I * value * kx[i], along_y + Complex::I * value * group.ky_rad_m];
                if point.weight < 1.0 {
                    let weight = f64::from(point.weight);
                    let coast = carrier_x[i] * carrier_y * weight;
                    let open = open_x[i] * open_y * ((1.0 - weight) * f64::from(point.short_gain));
                    value = value * coast + open;
                    gradient = [0, 1].map(|axis| gradient[axis] * coast + Complex::I * open * wave.k_rad_m[axis]);
                }
                // The flux of the energy is C Cg / omega Im(T* grad T) for a unit of variance.
                let local = LocalWave::new(wave.omega_rad_s, f64::from(point.depth_m), sea.gravity_m_s2);
                let flux = wave.variance_m2 * local.c_cg / wave.omega_rad_s;
                let variance_m2 = wave.variance_m2 * value.norm_squared();
                let at = j * columns + i;
                self.held_m2[at] += variance_m2;
                self.band_m2[band + at] += variance_m2 as f32;
                for axis in 0..2 {
                    self.flux_m3_s[at][axis] += flux * (value.conj() * gradient[axis]).im;
                }
            }
            (below, here) = (here, above);
        }
    }
}

/// The one of two pairs of variance and frequency that has more variance.
fn stronger(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    if b[0] > a[0] { b } else { a }
}

/// Slope of `values`, which are `step` apart, at the index `i`: by the values on both sides.
fn slope(values: &[f64], i: usize, step: f64) -> f64 {
    let (low, high) = (i.saturating_sub(1), (i + 1).min(values.len() - 1));
    (values[high] - values[low]) / (step * (high - low) as f64)
}

/// Fraction of waves of the transfer that break: those higher than the breaking height. Their heights have Rayleigh's
/// distribution. The breaking height is the one for which this is the fraction of Battjes and Janssen 1978.
fn breaking_fraction(point: &SeaAtPoint, held_m2: f64) -> f64 {
    let breaking_m = f64::from(point.breaking_height_m);
    if held_m2 > 0.0 { (-breaking_m * breaking_m / (8.0 * held_m2)).exp() } else { 0.0 }
}

impl TransferStatistics {
    /// The transfer.
    pub fn transfer(&self) -> &Arc<Transfer> {
        &self.sea.transfer
    }

    /// Significant wave height of the open sea, m: of all waves that the cascades hold.
    pub fn open_hs_m(&self) -> f64 {
        4.0 * self.sea.bands.iter().map(|band| band.open_m2).sum::<f64>().sqrt()
    }

    /// Share of the open sea's variance in the waves of the transfer, 0 to 1.
    pub fn held_share(&self) -> f64 {
        let held: f64 = self.sea.waves.iter().map(|wave| wave.variance_m2).sum();
        held / (held + self.sea.rest_m2).max(f64::MIN_POSITIVE)
    }

    /// The spectrum at the point in column `i` and row `j`, in bands of ascending frequency, without those that are
    /// empty in the open sea.
    pub fn spectrum(&self, i: usize, j: usize) -> Vec<SpectrumBand> {
        let (sea, transfer) = (&self.sea, &*self.sea.transfer);
        let at = j * transfer.columns + i;
        let point = &transfer.points[at];
        let (weight, gain) = (f64::from(point.weight), f64::from(point.short_gain));
        let is_wet = point.depth_m > 0.0;
        let band = |band: &Band| SpectrumBand {
            omega_rad_s: band.omega_rad_s,
            open_m2: band.open_m2,
            here_m2: if is_wet { gain * gain * band.rest_m2 } else { 0.0 },
        };
        let mut bands: Vec<SpectrumBand> = sea.bands.iter().map(band).collect();
        let [x_m, y_m] = [i, j].map(|steps| steps as f64 * transfer.cell_m);
        let size = [transfer.columns, transfer.rows];
        for (index, wave) in sea.waves.iter().enumerate().filter(|_| is_wet) {
            let group = &transfer.groups[transfer.waves[index].group as usize];
            let carrier = Complex::polar(weight, group.column_phase_rad[i] + group.ky_rad_m * y_m);
            let open_phase = wave.origin_phase_rad + wave.k_rad_m[0] * x_m + wave.k_rad_m[1] * y_m;
            let drawn = |at: usize| unpack(transfer.envelopes[index * transfer.points.len() + at]);
            let value = mean_drawn(at, size, |at| transfer.is_open(at), drawn) * carrier
                + Complex::polar((1.0 - weight) * gain, open_phase);
            if let Some(band) = bands.get_mut(wave.band) {
                band.here_m2 += wave.variance_m2 * value.norm_squared();
            }
        }
        bands.retain(|band| band.open_m2 > 0.0);
        bands
    }
}

#[cfg(test)]
#[path = "statistics_tests.rs"]
mod tests;
