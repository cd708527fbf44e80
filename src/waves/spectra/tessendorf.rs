//! Phillips' spectrum over wave numbers, as used in computer graphics (Tessendorf 2001).

use super::generalised_ab::PHILLIPS_ALPHA;
use super::spectrum::{FrequencySpectrum, SpectrumInputs};
use std::f64::consts::PI;

/// Tessendorf's spectrum A exp(-1/(k L)^2) / k^4 cos^2(theta) over wave vectors at the angle theta to the wind, with
/// L = U^2/g for the wind speed U. Its integral over directions is S(k) = pi A exp(-1/(k L)^2) / k^3; cos^2(theta) / pi
/// is the directional spreading. The default A = alpha / (2 pi), alpha = 0.0081, gives Phillips' equilibrium range.
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (set_a, dispersion) = (inputs.system.coefficient_a, inputs.dispersion);
    let a = if set_a > 0.0 { set_a } else { PHILLIPS_ALPHA / (2.0 * PI) };
    // Value of k L at the peak of S(omega) in deep water.
    let peak_kl = 0.8f64.sqrt();
    let length_m = match inputs.user_omega_p {
        Some(omega_p) => peak_kl / dispersion.wave_number(omega_p),
        None => inputs.wind_m_s * inputs.wind_m_s / inputs.gravity_m_s2,
    };
    let density_k = move |k: f64| PI * a * (-1.0 / (k * length_m).powi(2)).exp() / k.powi(3);
    let density = move |omega| dispersion.density_over_omega(density_k, omega);
    FrequencySpectrum {
        has_own_spreading: true,
        ..FrequencySpectrum::new(dispersion.omega(peak_kl / length_m), density)
    }
}
