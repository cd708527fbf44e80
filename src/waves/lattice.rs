//! The waves of a cascade's lattice: wave number, frequency and variance of each lattice point.

use super::plan::{Cascade, Plan};
use super::system::WaveSystem;
use std::f64::consts::TAU;

/// Distance from the lattice origin, in cells, within which S is averaged over a cell.
const COARSE_CELLS: f64 = 40.0;
/// Four-point Gauss-Legendre rule over [-1/2, 1/2]: nodes and weights.
const CELL_RULE: [(f64, f64); 4] = [
    (-0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
    (-0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Wave quantities that depend on |k| alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Wave number, rad/m.
    pub k: f64,
    /// Number of whole cycles in one period of the plan.
    pub turns: u32,
    /// Angular frequency, rad/s: turns x 2 pi / period_s.
    pub omega: f64,
    /// Ratio of the horizontal to the vertical axis of the particle orbits, coth(k h).
    pub orbit: f64,
}

impl Plan {
    /// The wave of a cascade at squared lattice distance `i2` = ix^2 + iz^2, not 0.
    pub fn wave(&self, cascade: &Cascade, i2: u32) -> Wave {
        let k = cascade.dk() * f64::from(i2).sqrt();
        let turns = (self.dispersion.omega(k) * self.period_s / TAU).round().clamp(1.0, f64::from(u32::MAX)) as u32;
        let omega = f64::from(turns) * TAU / self.period_s;
        Wave { k, turns, omega, orbit: self.dispersion.orbit(k) }
    }

    /// Share of the variance at wave number `k` (rad/m) for each of the `count` cascades that contain it. Overlapping
    /// cascades are independent, so their variances add and amplitudes are weighted by 1 / sqrt(count).
    pub fn share(&self, k: f64) -> f64 {
        let count = self.cascades.iter().filter(|c| c.holds(k)).count();
        1.0 / count.max(1) as f64
    }

    /// S(k) dk^2 of a system without its directional spreading: the variance of a lattice cell per radian of direction,
    /// m^2.
    ///
    /// Near the origin S is averaged over the cell's extent in |k|. There a cell is a sizeable part of the peak's
    /// width: samples at the lattice points alone would miss or double the narrow peak of a JONSWAP sea, 2 % of m0.
    pub fn radial_variance(&self, system: &WaveSystem, cascade: &Cascade, wave: &Wave) -> f64 {
        let dk = cascade.dk();
        let density =
            |k: f64, omega: f64| system.spectrum.density(omega) * self.dispersion.group_velocity(k) / k * dk * dk;
        let variance = if wave.k > COARSE_CELLS * dk {
            density(wave.k, wave.omega)
        } else {
            let mean = |low: f64, high: f64| -> f64 {
                let at = |&(x, w): &(f64, f64)| {
                    let k = 0.5 * (low + high) + x * (high - low);
                    w * density(k, self.dispersion.omega(k))
                };
                (high - low) / dk * CELL_RULE.iter().map(at).sum::<f64>()
            };
            let (low, high) = (wave.k - 0.5 * dk, wave.k + 0.5 * dk);
            match system.spectrum.jump.map(|omega| self.dispersion.wave_number(omega)) {
                Some(k) if k > low && k < high => mean(low, k) + mean(k, high),
                _ => mean(low, high),
            }
        };
        variance * self.share(wave.k)
    }

    /// Time `t_s` as a fraction of the period, in units of 2^-32, wrapped. A wave's phase is this number times its
    /// `turns` in wrapping 32-bit arithmetic, in units of 2^-32 turns: exact after hours, and a loop closes bit for
    /// bit.
    pub fn phase_time(&self, t_s: f64) -> u32 {
        phase_time(self.period_s, t_s)
    }
}

/// [`Plan::phase_time`] for a period of `period_s`.
pub fn phase_time(period_s: f64, t_s: f64) -> u32 {
    let turn = (t_s / period_s).rem_euclid(1.0);
    (turn * 4_294_967_296.0).round() as u64 as u32
}
