//! Running integrals of a spectrum over a logarithmic grid of frequencies, for the plan's own choices. The theory that is
//! printed comes from an independent quadrature (`statistics`).

use super::dispersion::Dispersion;

/// Integrals up to each point of the grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy {
    omega: Vec<f64>,
    k: Vec<f64>,
    m0: Vec<f64>,
    mss: Vec<f64>,
    strain: Vec<f64>,
    peak: f64,
}

impl Energy {
    const STEPS: usize = 1600;

    /// Integrates S(omega) from `low` to `high` rad/s.
    pub fn new(density: impl Fn(f64) -> f64, (low, high): (f64, f64), dispersion: &Dispersion) -> Self {
        let step = (high / low).ln() / Self::STEPS as f64;
        let mut out = Self { omega: vec![], k: vec![], m0: vec![], mss: vec![], strain: vec![], peak: low };
        let mut sums = [0.0; 3];
        let mut before = [0.0; 3];
        let mut highest = 0.0;
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

    /// Frequency at which S is largest, rad/s, to the grid's step of about 1 %.
    pub fn omega_p(&self) -> f64 {
        self.peak
    }

    /// Frequency below which the share `q` of m0 lies.
    pub fn quantile(&self, q: f64) -> f64 {
        let i = self.m0.partition_point(|&m| m < q * self.m0()).min(Self::STEPS);
        self.omega[i]
    }

    /// Variance of the waves between two wave numbers, m^2.
    pub fn m0_between(&self, low: f64, high: f64) -> f64 {
        self.between(&self.m0, low, high)
    }

    /// Mean square slope of the waves between two wave numbers.
    pub fn mss_between(&self, low: f64, high: f64) -> f64 {
        self.between(&self.mss, low, high)
    }

    /// Variance of dDx/dx + dDz/dz of the waves between two wave numbers, each weighted by `response` of its wave number.
    pub fn filtered_strain(&self, low: f64, high: f64, response: impl Fn(f64) -> f64) -> f64 {
        let piece = |i: usize| {
            let (a, b) = (self.k[i - 1].max(low), self.k[i].min(high));
            if a < b { self.between(&self.strain, a, b) * response(0.5 * (a + b)) } else { 0.0 }
        };
        (1..self.k.len()).map(piece).sum()
    }

    fn between(&self, sums: &[f64], low: f64, high: f64) -> f64 {
        (self.at(sums, high) - self.at(sums, low)).max(0.0)
    }

    /// A running integral at wave number `k`, linear between the grid's points.
    fn at(&self, sums: &[f64], k: f64) -> f64 {
        let i = self.k.partition_point(|&x| x < k);
        if i == 0 {
            return 0.0;
        }
        if i > Self::STEPS {
            return sums[Self::STEPS];
        }
        let f = (k - self.k[i - 1]) / (self.k[i] - self.k[i - 1]);
        sums[i - 1] + f * (sums[i] - sums[i - 1])
    }
}
