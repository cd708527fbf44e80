//! Phillips' frequency spectrum (1958): the equilibrium range omega^-5 alone, cut off below the peak.

use super::generalised_ab::{PHILLIPS_ALPHA, pierson_moskowitz};
use super::spectrum::{FrequencySpectrum, SpectrumInputs};

/// Phillips' spectrum S(omega) = alpha g^2 omega^-5 for omega >= omega_p, 0 below. Alpha and the peak frequency omega_p
/// are taken from Pierson and Moskowitz 1964. The density is per rad/s, so it has no factor 2 pi.
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let a = PHILLIPS_ALPHA * inputs.gravity_m_s2 * inputs.gravity_m_s2;
    let omega_p = pierson_moskowitz(inputs).omega_p;
    let density = move |omega: f64| if omega < omega_p { 0.0 } else { a / omega.powi(5) };
    FrequencySpectrum {
        discontinuity_rad_s: Some(omega_p),
        omega_min: omega_p,
        ..FrequencySpectrum::new(omega_p, density)
    }
}
