//! Frequency spectra S(omega): one-sided variance density of elevation, m^2 s, integral over omega = m0.

use super::dispersion;
use super::params::{Sea, SpectrumKind};

/// Phillips' constant of a fully developed sea (Pierson and Moskowitz 1964).
const PM_ALPHA: f64 = 8.1e-3;
/// The exponent's factor of Pierson-Moskowitz, for the wind at 19.5 m.
const PM_BETA: f64 = 0.74;
/// U(19.5 m) / U(10 m) over a neutral sea.
const U19_OVER_U10: f64 = 1.026;

/// A frequency spectrum with its coefficients worked out.
#[derive(Clone, Debug, PartialEq)]
pub struct FrequencySpectrum {
    kind: SpectrumKind,
    gravity: f64,
    depth_m: f64,
    /// Phillips' constant.
    alpha: f64,
    /// Peak of the deep-water form, rad/s.
    pub omega_p: f64,
    gamma: f64,
    /// Variance factor from the height scale and the depth cap.
    scale: f64,
}

impl FrequencySpectrum {
    /// The spectrum of a sea state. A calm (no wind) gives S = 0.
    pub fn new(sea: &Sea) -> Self {
        let g = sea.gravity_m_s2;
        let u = sea.wind_m_s;
        let fetch_m = 1000.0 * sea.fetch_km;
        let calm = u < 0.05;
        let (alpha, omega_p) = match sea.spectrum {
            _ if calm => (0.0, 1.0),
            // B = beta (g / U19.5)^4 = 5/4 omega_p^4.
            SpectrumKind::PiersonMoskowitz => (PM_ALPHA, (0.8 * PM_BETA).powf(0.25) * g / (U19_OVER_U10 * u)),
            // Hasselmann et al. 1973: fetch in metres, cube root in omega_p.
            SpectrumKind::Jonswap | SpectrumKind::Tma => {
                (0.076 * (u * u / (fetch_m * g)).powf(0.22), 22.0 * (g * g / (u * fetch_m)).cbrt())
            }
        };
        let gamma = if sea.spectrum == SpectrumKind::PiersonMoskowitz { 1.0 } else { sea.gamma };
        Self { kind: sea.spectrum, gravity: g, depth_m: sea.depth_m, alpha, omega_p, gamma, scale: 1.0 }
    }

    /// The same shape with its variance multiplied by `factor`.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.scale *= factor;
        self
    }

    /// Whether there are any waves at all.
    pub fn is_calm(&self) -> bool {
        self.alpha == 0.0
    }

    /// S(omega), m^2 s; 0 for omega <= 0.
    pub fn density(&self, omega: f64) -> f64 {
        if omega <= 0.0 || self.is_calm() {
            return 0.0;
        }
        let r = self.omega_p / omega;
        let sigma = if omega <= self.omega_p { 0.07 } else { 0.09 };
        let bump = (-(omega / self.omega_p - 1.0).powi(2) / (2.0 * sigma * sigma)).exp();
        let deep = self.alpha * self.gravity * self.gravity / omega.powi(5)
            * (-1.25 * r.powi(4)).exp()
            * self.gamma.powf(bump);
        let depth = match self.kind {
            SpectrumKind::Tma => self.kitaigorodskii(omega),
            SpectrumKind::PiersonMoskowitz | SpectrumKind::Jonswap => 1.0,
        };
        self.scale * deep * depth
    }

    /// Depth factor of TMA, exact: tanh^2(kh) / (1 + 2kh / sinh 2kh) (Bouws et al. 1985).
    fn kitaigorodskii(&self, omega: f64) -> f64 {
        let kh = self.depth_m * dispersion::wave_number(omega, self.depth_m, self.gravity);
        let curve = if kh > 300.0 { 0.0 } else { 2.0 * kh / (2.0 * kh).sinh() };
        kh.tanh().powi(2) / (1.0 + curve)
    }

    /// Range of omega (rad/s) outside which S is negligible at the low end and follows its tail at the high end.
    pub fn support(&self) -> (f64, f64) {
        (0.3 * self.omega_p, 400.0 * self.omega_p)
    }

    /// Frequencies at which S has a kink or a narrow peak: quadrature is split there.
    pub fn breakpoints(&self) -> [f64; 5] {
        [0.8, 0.93, 1.0, 1.15, 1.5].map(|r| r * self.omega_p)
    }
}
