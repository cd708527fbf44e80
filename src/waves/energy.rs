//! Cumulative integrals of a spectrum over a logarithmic frequency grid. The plan of a sea uses them to choose patches
//! and bands. The statistics shown to the user come from a separate, adaptive quadrature (`statistics`).

use super::dispersion::Dispersion;

/// Running integrals of a frequency spectrum: variances of elevation, slope and horizontal strain of all waves below
/// each frequency of a logarithmic grid.
#[derive(Clone, Debug)]
pub struct SpectrumIntegrals {
    /// Angular frequencies up to which the integrals are stored, rad/s, ascending.
    omega: Vec<f64>,
    /// Wave numbers of waves with the angular frequencies in `omega`, rad/m.
    k: Vec<f64>,
    /// Integrals from the lowest frequency up to each grid frequency: elevation variance (m^2), mean square slope, and
    /// variance of the strain dDx/dx + dDz/dz of the horizontal displacement D.
    sums: Vec<[f64; 3]>,
    /// Angular frequency of the grid at which the spectrum S(omega) is largest, rad/s; the grid's steps are about 1 %.
    pub omega_p: f64,
}

impl SpectrumIntegrals {
    const LOG_OMEGA_STEPS: usize = 1600;

    /// Integrates the spectra of elevation (`density`, S(omega), m^2 s), slope and strain from `low` to `high` (rad/s).
    pub fn new(density: impl Fn(f64) -> f64, (low, high): (f64, f64), dispersion: &Dispersion) -> Self {
        let step = (high / low).ln() / Self::LOG_OMEGA_STEPS as f64;
        let mut out = Self { omega: vec![], k: vec![], sums: vec![], omega_p: low };
        let (mut sums, mut before, mut highest) = ([0.0; 3], [0.0; 3], 0.0);
        for i in 0..=Self::LOG_OMEGA_STEPS {
            let omega = low * (step * i as f64).exp();
            let k = dispersion.wave_number(omega);
            let s = density(omega);
            if s > highest {
                (highest, out.omega_p) = (s, omega);
            }
            let share = s * omega * step;
            let now = [share, share * k * k, share * (k * dispersion.orbit_width_over_height(k)).powi(2)];
            for ((sum, a), b) in sums.iter_mut().zip(before).zip(now) {
                *sum += 0.5 * (a + b);
            }
            before = now;
            out.omega.push(omega);
            out.k.push(k);
            out.sums.push(sums);
        }
        out
    }

    /// Total variance of the elevation m0, the integral of the whole spectrum, m^2.
    pub fn m0(&self) -> f64 {
        self.sums[Self::LOG_OMEGA_STEPS][0]
    }

    /// Angular frequency (rad/s) below which the fraction `q` (0 to 1) of the elevation variance m0 lies.
    pub fn omega_at_variance_fraction(&self, q: f64) -> f64 {
        let i = self.sums.partition_point(|s| s[0] < q * self.m0()).min(Self::LOG_OMEGA_STEPS);
        self.omega[i]
    }

    /// Elevation variance (m^2) of the waves with wave numbers from `low` to `high` (rad/m).
    pub fn m0_between_wave_numbers(&self, low: f64, high: f64) -> f64 {
        self.integral_between_wave_numbers(0, low, high)
    }

    /// Mean square slope of the waves with wave numbers from `low` to `high` (rad/m).
    pub fn mss_between_wave_numbers(&self, low: f64, high: f64) -> f64 {
        self.integral_between_wave_numbers(1, low, high)
    }

    /// Variance of the strain dDx/dx + dDz/dz (D: horizontal displacement) of the waves with wave numbers from `low` to
    /// `high` (rad/m). The variance at each wave number k (rad/m) is multiplied by the filter `response(k)`.
    pub fn filtered_strain_variance(&self, low: f64, high: f64, response: impl Fn(f64) -> f64) -> f64 {
        let piece = |i: usize| {
            let (a, b) = (self.k[i - 1].max(low), self.k[i].min(high));
            if a < b { self.integral_between_wave_numbers(2, a, b) * response(0.5 * (a + b)) } else { 0.0 }
        };
        (1..self.k.len()).map(piece).sum()
    }

    /// Divides the waves with wave numbers from `low` to `high` (rad/m) into `count` bins of about equal variance.
    /// Returns for each bin the mean wave number, weighted by variance (rad/m), and the variance (m^2).
    pub fn bins_of_equal_variance(&self, low: f64, high: f64, count: usize) -> Vec<(f64, f64)> {
        let total = self.m0_between_wave_numbers(low, high);
        let mut bins = vec![[0.0; 2]; count];
        let mut below = 0.0;
        for i in 1..self.k.len() {
            let (a, b) = (self.k[i - 1].max(low), self.k[i].min(high));
            if a < b && total > 0.0 {
                let variance = self.m0_between_wave_numbers(a, b);
                let bin = ((below + 0.5 * variance) / total * count as f64) as usize;
                let bin = &mut bins[bin.min(count - 1)];
                *bin = [bin[0] + variance * 0.5 * (a + b), bin[1] + variance];
                below += variance;
            }
        }
        bins.into_iter().filter(|[_, variance]| *variance > 0.0).map(|[sum, v]| (sum / v, v)).collect()
    }

    /// Increase of the integral `which` (0 elevation variance, m^2; 1 mean square slope; 2 strain variance) from wave
    /// number `low` to `high` (rad/m), interpolated linearly between the stored frequencies.
    fn integral_between_wave_numbers(&self, which: usize, low: f64, high: f64) -> f64 {
        let at = |k: f64| match self.k.partition_point(|&x| x < k) {
            0 => 0.0,
            i if i > Self::LOG_OMEGA_STEPS => self.sums[Self::LOG_OMEGA_STEPS][which],
            i => {
                let (a, b) = (self.sums[i - 1][which], self.sums[i][which]);
                a + (k - self.k[i - 1]) / (self.k[i] - self.k[i - 1]) * (b - a)
            }
        };
        (at(high) - at(low)).max(0.0)
    }
}
