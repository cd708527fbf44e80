//! The frequency spectrum of a wave system, and the inputs from which a spectrum family (JONSWAP and others) makes it.

use crate::files::measured::MeasuredSpectrum;
use crate::state::params::{Sea, WaveSystemParams};
use crate::waves::dispersion::Dispersion;
use crate::waves::quadrature::integrate_adaptive;
use std::fmt;
use std::sync::Arc;

/// Quantities from which a spectrum family (JONSWAP and others) makes the frequency spectrum of a wave system.
pub struct SpectrumInputs<'a> {
    pub sea: &'a Sea,
    pub system: &'a WaveSystemParams,
    /// Dispersion relation of the sea's waves.
    pub dispersion: Dispersion,
    /// Acceleration of gravity g, m/s^2.
    pub gravity_m_s2: f64,
    /// Wind speed U at 10 m height, m/s, never 0.
    pub wind_m_s: f64,
    /// Dimensionless fetch g F / U^2, where F is the fetch in m and U the wind speed.
    pub dimensionless_fetch: f64,
    /// Angular peak frequency that the user has set, rad/s; `None` to derive it from wind and fetch.
    pub user_omega_p: Option<f64>,
}

impl SpectrumInputs<'_> {
    /// Converts the dimensionless fetch `fetch` = g F / U^2 to the fetch F in km, at the wind speed of these inputs.
    pub fn fetch_km(&self, fetch: f64) -> f64 {
        fetch * self.wind_m_s * self.wind_m_s / self.gravity_m_s2 / 1000.0
    }
}

/// Frequency spectrum S(omega) of one wave system, as a function of the angular frequency omega (rad/s).
#[derive(Clone)]
pub struct FrequencySpectrum {
    /// One-sided variance density S(omega), m^2 s, for omega > 0, before multiplication by `factor` and `fade`.
    pub(super) unscaled_density: Arc<dyn Fn(f64) -> f64 + Send + Sync>,
    /// Angular frequency of the spectral peak, rad/s; of two peaks, the one with the larger density S(omega).
    pub omega_p: f64,
    /// Angular frequency (rad/s, above 0) below which the spectrum is negligible; integrals start there.
    pub(super) omega_min: f64,
    /// Angular frequencies (rad/s, in any order) where integrals are split: kinks, jumps and points around the peak.
    pub integration_breakpoints_rad_s: Vec<f64>,
    /// Angular frequency at which the spectrum jumps, rad/s; `None` if it is continuous.
    pub discontinuity_rad_s: Option<f64>,
    /// Whether the spectrum has its own directional spreading instead of the user's: cos^2 of the angle to the wind.
    pub has_own_spreading: bool,
    /// Buoy data, if this is a measured spectrum, otherwise `None`.
    pub measured: Option<Arc<MeasuredSpectrum>>,
    /// Whether the wave system has no waves at all, for example because it has no wind.
    pub is_calm: bool,
    /// Notice for the user about this spectrum, for example that the fetch is too long; `None` without one.
    pub notice: Option<String>,
    /// Dimensionless factor on the variance density `shape`, which sets the wave height: 1 for the family's own height.
    pub(super) variance_factor: f64,
    /// Length l (m) of the short-wave fade, the factor exp(-(k l)^2) on the density, and the dispersion relation that
    /// gives the wave number k; `None` without a fade.
    pub(super) short_wave_fade: Option<(f64, Dispersion)>,
}

impl FrequencySpectrum {
    /// Makes a smooth spectrum with one peak at `omega_p` (rad/s). `shape` is S(omega), m^2 s, for omega > 0.
    pub fn new(omega_p: f64, shape: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self {
            unscaled_density: Arc::new(shape),
            omega_p,
            omega_min: 0.3 * omega_p,
            integration_breakpoints_rad_s: [0.8, 0.93, 1.0, 1.15, 1.5, 3.0].map(|r| r * omega_p).to_vec(),
            discontinuity_rad_s: None,
            has_own_spreading: false,
            measured: None,
            is_calm: false,
            notice: None,
            variance_factor: 1.0,
            short_wave_fade: None,
        }
    }

    /// Makes the spectrum of a wave system without waves, S(omega) = 0.
    pub fn calm() -> Self {
        Self { is_calm: true, ..Self::new(1.0, |_| 0.0) }
    }

    /// Makes a double-peaked spectrum, whose density is the sum of the densities of two spectra with one peak each.
    /// Both must have the `factor` 1 and no fade.
    pub fn sum([a, b]: [Self; 2]) -> Self {
        let (omega_min, breakpoints) = (
            a.omega_min.min(b.omega_min),
            [&a.integration_breakpoints_rad_s[..], &b.integration_breakpoints_rad_s].concat(),
        );
        let peaks = [a.omega_p, b.omega_p];
        let shape = move |omega| (a.unscaled_density)(omega) + (b.unscaled_density)(omega);
        let omega_p = if shape(peaks[0]) >= shape(peaks[1]) { peaks[0] } else { peaks[1] };
        Self { omega_min, integration_breakpoints_rad_s: breakpoints, ..Self::new(omega_p, shape) }
    }

    /// Returns the spectrum with its variance density multiplied by `factor`, the square of the factor on wave heights.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.variance_factor *= factor;
        self
    }

    /// One-sided variance density S(omega), m^2 s, at the angular frequency `omega` (rad/s); 0 for omega <= 0.
    pub fn density(&self, omega: f64) -> f64 {
        if omega <= 0.0 {
            return 0.0;
        }
        let fade = self
            .short_wave_fade
            .map_or(1.0, |(length_m, waves)| (-(length_m * waves.wave_number(omega)).powi(2)).exp());
        self.variance_factor * (self.unscaled_density)(omega) * fade
    }

    /// Elevation variance m0, m^2: the integral of the spectrum over all frequencies.
    pub fn variance_m2(&self) -> f64 {
        let (low, high) = self.frequency_range();
        let mut knots = self.integration_breakpoints_rad_s.clone();
        knots.retain(|&w| w > low && w < high);
        knots.extend([low, high]);
        knots.sort_by(f64::total_cmp);
        integrate_adaptive(|w| self.density(w), &knots, 1e-9)
    }

    /// Lowest and highest angular frequency, rad/s, between which nearly all variance of the spectrum lies.
    pub fn frequency_range(&self) -> (f64, f64) {
        (self.omega_min, (400.0 * self.omega_p).max(4000.0))
    }
}

impl fmt::Debug for FrequencySpectrum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FrequencySpectrum").field("omega_p", &self.omega_p).finish_non_exhaustive()
    }
}

/// JONSWAP's peak enhancement gamma^exp(-(r - 1)^2 / (2 sigma^2)), a factor on the density, with the relative peak
/// width sigma and `r` = omega / omega_p.
pub fn peak_enhancement(r: f64, gamma: f64, sigma: f64) -> f64 {
    gamma.powf((-(r - 1.0).powi(2) / (2.0 * sigma * sigma)).exp())
}
