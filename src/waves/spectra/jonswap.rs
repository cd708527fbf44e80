//! JONSWAP, the spectrum of a fetch-limited sea, and TMA, the same spectrum times a depth factor for shallow water.

use super::depth_limit::with_depth_factor;
use super::spectrum::{FrequencySpectrum, SpectrumInputs, peak_enhancement};
use crate::waves::dispersion::Dispersion;
use crate::waves::quadrature::integrate_adaptive;

/// Dimensionless fetch g F / U^2 (gravity g, fetch F, wind speed U) at which JONSWAP waves are as high as those of a
/// fully developed sea.
const FULL_DEVELOPMENT_DIMENSIONLESS_FETCH: f64 = 1.1e4;
/// Dimensionless fetch g F / U^2 (gravity g, fetch F, wind speed U) above which the user gets a notice: JONSWAP waves
/// are then a quarter higher than those of a fully developed sea.
const NOTICE_DIMENSIONLESS_FETCH: f64 = 1.6e4;

/// JONSWAP spectrum alpha g^2 omega^-5 exp(-5/4 (omega_p/omega)^4) times peak enhancement (Hasselmann et al. 1973).
#[derive(Clone, Copy)]
pub struct Jonswap {
    /// Factor alpha g^2 of the spectrum, with Phillips' constant alpha, m^2/s^4.
    pub alpha_g2: f64,
    /// Angular frequency of the spectral peak, rad/s.
    pub omega_p: f64,
    /// Peak enhancement factor gamma; 3.3 in the mean JONSWAP spectrum.
    pub gamma: f64,
}

/// Makes the JONSWAP spectrum, with a notice if the fetch is too long for it.
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let jonswap = Jonswap::new(inputs);
    let notice = full_development_notice(inputs);
    FrequencySpectrum { notice, ..FrequencySpectrum::new(jonswap.omega_p, move |omega| jonswap.density(omega)) }
}

/// Makes the TMA spectrum for shallow water: JONSWAP times the depth factor, with Bouws' alpha and gamma if selected.
pub fn tma(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (g, sea) = (inputs.gravity_m_s2, inputs.sea);
    let mut tma = Jonswap::new(inputs);
    if sea.tma_bouws_parameters {
        let k_p = Dispersion::finite_depth(g, sea.depth_m).wave_number(tma.omega_p);
        let kappa = inputs.wind_m_s * inputs.wind_m_s * k_p / g;
        tma.alpha_g2 = 0.0078 * kappa.powf(0.49) * g * g;
        tma.gamma = 2.47 * kappa.powf(0.39);
    }
    let deep = FrequencySpectrum::new(tma.omega_p, move |omega| tma.density(omega));
    FrequencySpectrum { notice: full_development_notice(inputs), ..with_depth_factor(inputs, deep) }
}

/// Notice that the fetch is beyond full development, where a real sea stops growing and JONSWAP does not; `None` for a
/// shorter fetch or if the user has set wave height or period.
fn full_development_notice(inputs: &SpectrumInputs<'_>) -> Option<String> {
    let is_set = inputs.system.hs_m > 0.0 || inputs.user_omega_p.is_some();
    (inputs.dimensionless_fetch > NOTICE_DIMENSIONLESS_FETCH && !is_set).then(|| {
        let fetch_km = inputs.fetch_km(FULL_DEVELOPMENT_DIMENSIONLESS_FETCH);
        format!("the sea is fully developed after {fetch_km:.0} km (spectrum=pm); jonswap and tma keep growing")
    })
}

/// Significant wave height (m) and angular peak frequency (rad/s): the user's or, if not set, those of JONSWAP.
pub fn height_and_peak(inputs: &SpectrumInputs<'_>) -> (f64, f64) {
    let grown = Jonswap::for_wind_and_fetch(inputs);
    let grown_height = || {
        let knots = [0.3, 1.0, 1.5, 5.0, 400.0].map(|r| r * grown.omega_p);
        4.0 * integrate_adaptive(|w| grown.density(w), &knots, 1e-9).sqrt()
    };
    let hs_m = if inputs.system.hs_m > 0.0 { inputs.system.hs_m } else { grown_height() };
    (hs_m, inputs.user_omega_p.unwrap_or(grown.omega_p))
}

impl Jonswap {
    /// Mean JONSWAP spectrum for a wind U and a fetch F, without the user's settings: gamma = 3.3, alpha = 0.076
    /// x^-0.22 and omega_p = 22 (g/U) x^(-1/3) with the dimensionless fetch x = g F / U^2.
    fn for_wind_and_fetch(inputs: &SpectrumInputs<'_>) -> Self {
        let (g, x) = (inputs.gravity_m_s2, inputs.dimensionless_fetch);
        let alpha = 0.076 * x.powf(-0.22);
        Self { alpha_g2: alpha * g * g, omega_p: 22.0 * g / inputs.wind_m_s / x.cbrt(), gamma: 3.3 }
    }

    /// JONSWAP spectrum for the wind and fetch, with the user's peak enhancement gamma and, if set, peak frequency.
    pub fn new(inputs: &SpectrumInputs<'_>) -> Self {
        let grown = Self::for_wind_and_fetch(inputs);
        Self { omega_p: inputs.user_omega_p.unwrap_or(grown.omega_p), gamma: inputs.system.gamma, ..grown }
    }

    /// Variance density S(omega), m^2 s, at the angular frequency `omega` (rad/s).
    pub fn density(&self, omega: f64) -> f64 {
        let r = omega / self.omega_p;
        let sigma = if r <= 1.0 { 0.07 } else { 0.09 };
        self.alpha_g2 / omega.powi(5) * (-1.25 / r.powi(4)).exp() * peak_enhancement(r, self.gamma, sigma)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{G, at, close, same};
    use crate::state::params::SpectrumKind;

    #[test]
    fn jonswap_meets_its_own_energy_law_at_short_fetch() {
        // 1.6e-7 x (Hasselmann et al. 1973); at longer fetch the fits of alpha and omega_p deviate from it.
        let x = 100.0;
        let energy = at(SpectrumKind::Jonswap, 10.0, x * 100.0 / G / 1000.0, same).variance_m2() * (G / 100.0).powi(2);
        close(energy, 1.6e-7 * x, 0.1);
    }

    #[test]
    fn bouws_constants() {
        // U = 10 m/s over 100 km in deep water has alpha 0.0080 and gamma 2.52.
        let s = at(SpectrumKind::Tma, 10.0, 100.0, |sea| sea.tma_bouws_parameters = true);
        let gamma = s.density(s.omega_p) / (0.0080 * G * G / s.omega_p.powi(5) * (-1.25f64).exp());
        close(gamma, 2.52, 5e-3);
    }
}
