//! A frequency spectrum, and the inputs that its family makes it from.

use crate::files::measured::MeasuredSpectrum;
use crate::state::params::{Sea, System};
use crate::waves::dispersion::Dispersion;
use crate::waves::quadrature::adaptive;
use std::fmt;
use std::sync::Arc;

/// Inputs of a spectrum family.
pub struct Inputs<'a> {
    pub sea: &'a Sea,
    pub system: &'a System,
    /// Dispersion relation of `sea`.
    pub dispersion: Dispersion,
    /// Acceleration of gravity g, m/s^2.
    pub gravity_m_s2: f64,
    /// Wind speed U at 10 m, m/s, never 0.
    pub wind_m_s: f64,
    /// Dimensionless fetch g F / U^2.
    pub fetch: f64,
    /// Peak frequency that the user has set, rad/s.
    pub omega_p: Option<f64>,
}

impl Inputs<'_> {
    /// The fetch F, in km, that belongs to a dimensionless one.
    pub fn fetch_km(&self, fetch: f64) -> f64 {
        fetch * self.wind_m_s * self.wind_m_s / self.gravity_m_s2 / 1000.0
    }
}

/// The frequency spectrum of one wave system. All frequencies are angular, in rad/s.
#[derive(Clone)]
pub struct FrequencySpectrum {
    /// One-sided variance density, m^2 s, for omega > 0, before `factor` and `fade`.
    pub(super) shape: Arc<dyn Fn(f64) -> f64 + Send + Sync>,
    /// Peak angular frequency, rad/s; of two peaks, the one with the larger variance density.
    pub omega_p: f64,
    /// Frequency below which S is negligible, positive.
    pub(super) lowest: f64,
    /// Frequencies, in any order, at which S has a kink, a jump or a narrow peak: quadrature is split there.
    pub breakpoints: Vec<f64>,
    /// Frequency at which S jumps.
    pub jump: Option<f64>,
    /// Whether the definition of the spectrum includes a directional factor, cos^2.
    pub has_own_direction: bool,
    /// Data of a measured spectrum.
    pub measured: Option<Arc<MeasuredSpectrum>>,
    /// Whether there are no waves at all.
    pub is_calm: bool,
    /// Notice for the user.
    pub notice: Option<String>,
    /// Factor on the variance.
    pub(super) factor: f64,
    /// Length l (m) of the short-wave fade exp(-(k l)^2), and the relation that gives k.
    pub(super) fade: Option<(f64, Dispersion)>,
}

impl FrequencySpectrum {
    /// A smooth spectrum with one peak. `shape` is S(omega), m^2 s, for omega > 0.
    pub fn new(omega_p: f64, shape: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self {
            shape: Arc::new(shape),
            omega_p,
            lowest: 0.3 * omega_p,
            breakpoints: [0.8, 0.93, 1.0, 1.15, 1.5, 3.0].map(|r| r * omega_p).to_vec(),
            jump: None,
            has_own_direction: false,
            measured: None,
            is_calm: false,
            notice: None,
            factor: 1.0,
            fade: None,
        }
    }

    /// A spectrum without waves.
    pub fn calm() -> Self {
        Self { is_calm: true, ..Self::new(1.0, |_| 0.0) }
    }

    /// The sum of two spectra with one peak each.
    pub fn sum([a, b]: [Self; 2]) -> Self {
        let (lowest, breakpoints) = (a.lowest.min(b.lowest), [&a.breakpoints[..], &b.breakpoints].concat());
        let peaks = [a.omega_p, b.omega_p];
        let shape = move |omega| (a.shape)(omega) + (b.shape)(omega);
        let omega_p = if shape(peaks[0]) >= shape(peaks[1]) { peaks[0] } else { peaks[1] };
        Self { lowest, breakpoints, ..Self::new(omega_p, shape) }
    }

    /// Multiplies the variance by `factor`.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.factor *= factor;
        self
    }

    /// One-sided variance density S(omega), m^2 s; 0 for omega <= 0.
    pub fn density(&self, omega: f64) -> f64 {
        if omega <= 0.0 {
            return 0.0;
        }
        let fade = self.fade.map_or(1.0, |(length_m, waves)| (-(length_m * waves.wave_number(omega)).powi(2)).exp());
        self.factor * (self.shape)(omega) * fade
    }

    /// Variance of the elevation m0, the integral of S, m^2.
    pub fn m0_m2(&self) -> f64 {
        let (low, high) = self.support();
        let mut knots = self.breakpoints.clone();
        knots.retain(|&w| w > low && w < high);
        knots.extend([low, high]);
        knots.sort_by(f64::total_cmp);
        adaptive(|w| self.density(w), &knots, 1e-9)
    }

    /// Integration range of omega: S is negligible below it, m0 above it.
    pub fn support(&self) -> (f64, f64) {
        (self.lowest, (400.0 * self.omega_p).max(4000.0))
    }
}

impl fmt::Debug for FrequencySpectrum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FrequencySpectrum").field("omega_p", &self.omega_p).finish_non_exhaustive()
    }
}

/// Peak enhancement gamma^exp(-(r - 1)^2 / (2 sigma^2)) at r = omega / omega_p (Hasselmann et al. 1973).
pub fn peak_enhancement(r: f64, gamma: f64, sigma: f64) -> f64 {
    gamma.powf((-(r - 1.0).powi(2) / (2.0 * sigma * sigma)).exp())
}
