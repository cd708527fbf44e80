//! Spectra with two peaks: a swell and a wind sea in one.

use super::Source;
use std::f64::consts::TAU;

/// One peak of a double-peaked spectrum.
pub trait Peak: Copy {
    /// Its frequency, rad/s.
    fn omega_p(&self) -> f64;
    /// S(omega), m^2 s.
    fn density(&self, omega: f64) -> f64;
}

/// The sum of two peaks.
#[derive(Clone, Debug, PartialEq)]
pub struct Double<P> {
    parts: [P; 2],
}

impl<P: Peak> Double<P> {
    pub fn density(&self, omega: f64) -> f64 {
        self.parts.iter().map(|p| p.density(omega)).sum()
    }

    pub fn peaks(&self) -> [f64; 2] {
        self.parts.map(|p| p.omega_p())
    }

    pub fn lowest_peak(&self) -> f64 {
        let [a, b] = self.peaks();
        a.min(b)
    }

    /// The frequency of the higher peak.
    pub fn omega_p(&self) -> f64 {
        let [a, b] = self.peaks();
        if self.density(a) >= self.density(b) { a } else { b }
    }
}

/// Ochi and Hubble 1976, the most probable member of their family for a significant height.
pub type OchiHubble = Double<GammaPeak>;

/// A peak of the family (w_p/w)^(4 lambda + 1) with lambda as its sharpness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GammaPeak {
    hs_m: f64,
    omega_p: f64,
    lambda: f64,
}

impl OchiHubble {
    pub fn new(source: &Source<'_>) -> Self {
        let (hs_m, _) = source.height_and_peak();
        // 0.84^2 + 0.54^2 is 0.997: the published shares, made to add up.
        let share = 1.0 / (0.84f64.powi(2) + 0.54f64.powi(2)).sqrt();
        let mut parts = [
            GammaPeak { hs_m: 0.84 * share * hs_m, omega_p: 0.70 * (-0.046 * hs_m).exp(), lambda: 3.0 },
            GammaPeak {
                hs_m: 0.54 * share * hs_m,
                omega_p: 1.15 * (-0.039 * hs_m).exp(),
                lambda: 1.54 * (-0.062 * hs_m).exp(),
            },
        ];
        if let Some(omega_p) = source.omega_p {
            let ratio = omega_p / Self { parts }.omega_p();
            parts = parts.map(|p| GammaPeak { omega_p: p.omega_p * ratio, ..p });
        }
        Self { parts }
    }
}

impl Peak for GammaPeak {
    fn omega_p(&self) -> f64 {
        self.omega_p
    }

    fn density(&self, omega: f64) -> f64 {
        let l = self.lambda;
        let c = (4.0 * l + 1.0) / 4.0;
        let x = (self.omega_p / omega).powi(4);
        // 1/4 (c wp^4)^l / Gamma(l) H^2 / w^(4 l + 1) exp(-c (wp/w)^4), in logarithms.
        let ln = l * (c * x).ln() - libm::lgamma(l) - c * x;
        0.25 * self.hs_m * self.hs_m / omega * ln.exp()
    }
}

/// Torsethaugen and Haver 2004, the simplified form: which of swell and wind sea leads follows from height and period.
pub type Torsethaugen = Double<EnhancedPeak>;

/// A peak f_n^-4 exp(-f_n^-4), enhanced by gamma.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnhancedPeak {
    m0: f64,
    omega_p: f64,
    gamma: f64,
}

impl Torsethaugen {
    pub fn new(source: &Source<'_>) -> Self {
        let (hs, omega_p) = source.height_and_peak();
        let g = source.gravity();
        let tp = TAU / omega_p;
        // Period of a fully developed sea at the reference fetch of 370 km.
        let full = 6.6 * hs.cbrt();
        let steepness = |h: f64, t: f64| (35.0 * (TAU / g * h / (t * t)).powf(0.857)).max(1.0);
        let (share, gamma, second) = if tp <= full {
            let x = 2.0 * (full - tp) / (full - 2.0 * hs.sqrt());
            let share = 0.7 + 0.3 * (-x * x).exp();
            (share, steepness(share * hs, tp), full + 2.0)
        } else {
            let room = (25.0 - full).max(0.1);
            let x = (tp - full) / (0.3 * room);
            let share = 0.6 + 0.4 * (-x * x).exp();
            let rest = (1.0 - share * share).sqrt() * hs;
            let longer = 1.0 + 6.0 * ((tp - full) / room).min(1.0);
            (share, steepness(hs, full) * longer, 6.6 * rest.cbrt().max(0.05))
        };
        let part = |h: f64, t: f64, gamma: f64| EnhancedPeak { m0: h * h / 16.0, omega_p: TAU / t, gamma };
        let rest = (1.0 - share * share).max(0.0).sqrt();
        Self { parts: [part(share * hs, tp, gamma), part(rest * hs, second, 1.0)] }
    }
}

impl Peak for EnhancedPeak {
    fn omega_p(&self) -> f64 {
        self.omega_p
    }

    fn density(&self, omega: f64) -> f64 {
        let r = omega / self.omega_p;
        let sigma = if r < 1.0 { 0.07 } else { 0.09 };
        let bump = (-(r - 1.0).powi(2) / (2.0 * sigma * sigma)).exp();
        let norm = 3.26 * (1.0 + 1.1 * self.gamma.ln().powf(1.19)) / self.gamma;
        self.m0 / self.omega_p * norm / r.powi(4) * (-1.0 / r.powi(4)).exp() * self.gamma.powf(bump)
    }
}
