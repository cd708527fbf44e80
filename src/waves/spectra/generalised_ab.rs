//! The generalised spectrum A omega^-5 exp(-B omega^-4), and Pierson-Moskowitz as its fully developed case.

use super::spectrum::{FrequencySpectrum, Inputs};

/// Phillips' constant alpha of a fully developed sea (Pierson and Moskowitz 1964).
pub const ALPHA: f64 = 8.1e-3;
/// Factor beta in the exponent of Pierson-Moskowitz, for the wind at 19.5 m.
const BETA: f64 = 0.74;
/// U(19.5 m) / U(10 m) over a neutrally stratified sea.
const U19_OVER_U10: f64 = 1.026;

/// A (m^2/s^4) and B (s^-4) that the user has set; Pierson-Moskowitz supplies the missing ones.
pub fn spectrum(inputs: &Inputs<'_>) -> FrequencySpectrum {
    let (a, b) = coefficients(inputs);
    let or = |set: f64, default: f64| if set > 0.0 { set } else { default };
    with_coefficients(or(inputs.system.coefficient_a, a), or(inputs.system.coefficient_b, b))
}

/// The fully developed sea of Pierson and Moskowitz 1964.
pub fn pierson_moskowitz(inputs: &Inputs<'_>) -> FrequencySpectrum {
    let (a, b) = coefficients(inputs);
    with_coefficients(a, b)
}

/// Pierson-Moskowitz: A = alpha g^2, m^2/s^4, and B = beta (g / U19.5)^4 = 0.6678 (g / U10)^4, s^-4.
fn coefficients(inputs: &Inputs<'_>) -> (f64, f64) {
    let g = inputs.gravity_m_s2;
    let b = match inputs.omega_p {
        Some(omega_p) => 1.25 * omega_p.powi(4),
        None => BETA * (g / (U19_OVER_U10 * inputs.wind_m_s)).powi(4),
    };
    (ALPHA * g * g, b)
}

/// The peak follows from B = 5/4 omega_p^4.
fn with_coefficients(a: f64, b: f64) -> FrequencySpectrum {
    FrequencySpectrum::new((0.8 * b).powf(0.25), move |omega| a / omega.powi(5) * (-b / omega.powi(4)).exp())
}
