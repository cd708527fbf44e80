//! Wave number, frequency and variance of each wave of a cascade. The wave vectors of a cascade form a square lattice.

use super::plan::{Cascade, Plan};
use super::system::WaveSystem;
use std::f64::consts::TAU;

/// Largest wave number, in units of the lattice spacing, up to which the spectrum is averaged over the lattice cell
/// around a wave vector; the variance of waves with larger wave numbers is sampled at the wave vector.
const MAX_CELL_AVERAGED_LATTICE_RADIUS: f64 = 40.0;
/// Nodes and weights of the four-point Gauss-Legendre rule over [-1/2, 1/2], for means over a lattice cell.
const CELL_QUADRATURE_NODES: [(f64, f64); 4] = [
    (-0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
    (-0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Properties of a cascade's wave that depend only on its wave number |k|, not on its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticeWave {
    /// Wave number, the magnitude of the wave vector, rad/m.
    pub k: f64,
    /// Number of whole cycles of the wave in one period of the sea (`Plan::period_s`).
    pub cycles_per_period: u32,
    /// Angular frequency, rad/s: `cycles_per_period` x 2 pi / period, so that the sea repeats after its period.
    pub omega: f64,
    /// Ratio of the horizontal to the vertical axis of the water particle orbits, coth(k h) at the water depth h.
    pub orbit_width_over_height: f64,
}

impl Plan {
    /// Returns what all waves of a cascade at lattice points (ix, iz) with ix^2 + iz^2 = `i2` (not 0) share: wave
    /// number, frequency and orbit shape. They differ in direction and amplitude.
    pub fn wave_at_squared_index(&self, cascade: &Cascade, i2: u32) -> LatticeWave {
        let k = cascade.dk() * f64::from(i2).sqrt();
        let cycles_per_period =
            (self.dispersion.omega(k) * self.repeat_period_s / TAU).round().clamp(1.0, f64::from(u32::MAX)) as u32;
        let omega = f64::from(cycles_per_period) * TAU / self.repeat_period_s;
        LatticeWave { k, cycles_per_period, omega, orbit_width_over_height: self.dispersion.orbit_width_over_height(k) }
    }

    /// Fraction of the variance at wave number `k` (rad/m) that each cascade with `k` in its band carries: 1 / count
    /// for `count` cascades. Overlapping cascades are independent, so amplitudes are weighted by 1 / sqrt(count).
    pub fn variance_share_per_cascade(&self, k: f64) -> f64 {
        let count = self.cascades.iter().filter(|c| c.contains_wave_number(k)).count();
        1.0 / count.max(1) as f64
    }

    /// Variance that a wave system gives to one wave of `cascade`, per radian of direction, m^2: S(k) dk^2 / k with the
    /// lattice spacing dk, divided among overlapping cascades, before multiplication by the directional spreading.
    ///
    /// Each wave vector stands for a square lattice cell with the side dk. At small wave numbers S is averaged over the
    /// cell's extent in |k|, because it is not small against the width of the spectral peak. Samples at the lattice
    /// points would miss the narrow peak of a JONSWAP sea or count it twice, an error of 2 % of the total variance m0.
    pub fn lattice_cell_variance_m2_per_rad(&self, system: &WaveSystem, cascade: &Cascade, wave: &LatticeWave) -> f64 {
        let dk = cascade.dk();
        let density =
            |k: f64, omega: f64| system.spectrum.density(omega) * self.dispersion.group_velocity(k) / k * dk * dk;
        let variance = if wave.k > MAX_CELL_AVERAGED_LATTICE_RADIUS * dk {
            density(wave.k, wave.omega)
        } else {
            let mean = |low: f64, high: f64| -> f64 {
                let at = |&(x, w): &(f64, f64)| {
                    let k = 0.5 * (low + high) + x * (high - low);
                    w * density(k, self.dispersion.omega(k))
                };
                (high - low) / dk * CELL_QUADRATURE_NODES.iter().map(at).sum::<f64>()
            };
            let (low, high) = (wave.k - 0.5 * dk, wave.k + 0.5 * dk);
            match system.spectrum.discontinuity_rad_s.map(|omega| self.dispersion.wave_number(omega)) {
                Some(k) if k > low && k < high => mean(low, k) + mean(k, high),
                _ => mean(low, high),
            }
        };
        variance * self.variance_share_per_cascade(wave.k)
    }

    /// Time `t_s` (s) within the period of the sea, as a 32-bit integer: one period is 2^32. The phase of a wave, in
    /// units of 2^-32 cycles, is this integer times `LatticeWave::cycles_per_period` in wrapping 32-bit arithmetic. So
    /// phases stay exact after hours, and the sea repeats bit for bit after its period.
    pub fn period_fraction_u32(&self, t_s: f64) -> u32 {
        period_fraction_u32(self.repeat_period_s, t_s)
    }
}

/// Time `t_s` (s) within the period `period_s` (s), as a 32-bit integer: one period is 2^32.
pub fn period_fraction_u32(period_s: f64, t_s: f64) -> u32 {
    let turn = (t_s / period_s).rem_euclid(1.0);
    (turn * 4_294_967_296.0).round() as u64 as u32
}
