//! Running integrals of a spectrum over a logarithmic frequency grid, from which the plan makes its choices. Published
//! numbers come from an independent quadrature (`statistics`).

use super::dispersion::Dispersion;

/// Running integrals of a spectrum, one entry per grid frequency.
#[derive(Clone, Debug)]
pub struct Energy {
    /// Grid frequencies, rad/s, ascending.
    omega: Vec<f64>,
    /// Wave numbers of the grid frequencies, rad/m.
    k: Vec<f64>,
    /// Variance of the elevation up to each frequency, m^2.
    m0: Vec<f64>,
    /// Mean square slope up to each frequency.
    mss: Vec<f64>,
    /// Variance of the horizontal strain dDx/dx + dDz/dz up to each frequency.
    strain: Vec<f64>,
    /// Frequency of the largest density, rad/s.
    peak: f64,
}

impl Energy {
    const STEPS: usize = 1600;

    /// Integrates S(omega), m^2 s, from `low` to `high`, rad/s.
    pub fn new(density: impl Fn(f64) -> f64, (low, high): (f64, f64), dispersion: &Dispersion) -> Self {
        let step = (high / low).ln() / Self::STEPS as f64;
        let mut out = Self { omega: vec![], k: vec![], m0: vec![], mss: vec![], strain: vec![], peak: low };
        let (mut sums, mut before, mut highest) = ([0.0; 3], [0.0; 3], 0.0);
        for i in 0..=Self::STEPS {
            let omega = low * (step * i as f64).exp();
            let k = dispersion.wave_number(omega);
            let s = density(omega);
            if s > highest {
                (highest, out.peak) = (s, omega);
            }
            let share = s * omega * step;
            let now = [share, share * k * k, share * (k * dispersion.orbit(k)).powi(2)];
            for ((sum, a), b) in sums.iter_mut().zip(before).zip(now) {
                *sum += 0.5 * (a + b);
            }
            before = now;
            out.omega.push(omega);
            out.k.push(k);
            out.m0.push(sums[0]);
            out.mss.push(sums[1]);
            out.strain.push(sums[2]);
        }
        out
    }

    /// Variance of the elevation, m^2.
    pub fn m0(&self) -> f64 {
        self.m0[Self::STEPS]
    }

    /// Frequency of the largest S, rad/s, to the grid's step of about 1 %.
    pub fn omega_p(&self) -> f64 {
        self.peak
    }

    /// Frequency (rad/s) below which the share `q` of m0 lies.
    pub fn quantile(&self, q: f64) -> f64 {
        let i = self.m0.partition_point(|&m| m < q * self.m0()).min(Self::STEPS);
        self.omega[i]
    }

    /// Variance of the elevation between two wave numbers (rad/m), m^2.
    pub fn m0_between(&self, low: f64, high: f64) -> f64 {
        self.between(&self.m0, low, high)
    }

    /// Mean square slope between two wave numbers (rad/m).
    pub fn mss_between(&self, low: f64, high: f64) -> f64 {
        self.between(&self.mss, low, high)
    }

    /// Variance of dDx/dx + dDz/dz between two wave numbers (rad/m), weighted by `response` of the wave number.
    pub fn filtered_strain(&self, low: f64, high: f64, response: impl Fn(f64) -> f64) -> f64 {
        let piece = |i: usize| {
            let (a, b) = (self.k[i - 1].max(low), self.k[i].min(high));
            if a < b { self.between(&self.strain, a, b) * response(0.5 * (a + b)) } else { 0.0 }
        };
        (1..self.k.len()).map(piece).sum()
    }

    fn between(&self, integral: &[f64], low: f64, high: f64) -> f64 {
        (self.at(integral, high) - self.at(integral, low)).max(0.0)
    }

    /// A running integral at wave number `k`, linear between grid points.
    fn at(&self, integral: &[f64], k: f64) -> f64 {
        let i = self.k.partition_point(|&x| x < k);
        if i == 0 {
            return 0.0;
        }
        if i > Self::STEPS {
            return integral[Self::STEPS];
        }
        let f = (k - self.k[i - 1]) / (self.k[i] - self.k[i - 1]);
        integral[i - 1] + f * (integral[i] - integral[i - 1])
    }
}
