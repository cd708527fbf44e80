//! Generalised spectrum A omega^-5 exp(-B omega^-4), and Pierson-Moskowitz, its special case for a fully developed sea.

use super::spectrum::{FrequencySpectrum, SpectrumInputs};

/// Phillips' constant alpha of a fully developed sea (Pierson and Moskowitz 1964).
pub const PHILLIPS_ALPHA: f64 = 8.1e-3;
/// Factor beta in the exponential exp(-beta (g / (U omega))^4) of Pierson-Moskowitz, U the wind speed at 19.5 m height.
const PIERSON_MOSKOWITZ_BETA: f64 = 0.74;
/// Ratio of the wind speeds at 19.5 m and at 10 m height over the sea, in neutrally stratified air.
const U19_OVER_U10: f64 = 1.026;

/// Spectrum A omega^-5 exp(-B omega^-4) with the user's A (m^2/s^4) and B (s^-4), by default Pierson-Moskowitz' values.
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (a, b) = pierson_moskowitz_coefficients(inputs);
    let or = |set: f64, default: f64| if set > 0.0 { set } else { default };
    spectrum_from_coefficients(or(inputs.system.coefficient_a, a), or(inputs.system.coefficient_b, b))
}

/// Pierson and Moskowitz' spectrum of a fully developed sea (1964). Its peak frequency is the user's, if set, else that
/// of the wind.
pub fn pierson_moskowitz(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (a, b) = pierson_moskowitz_coefficients(inputs);
    spectrum_from_coefficients(a, b)
}

/// Coefficients A = alpha g^2 (m^2/s^4) and B = beta (g / U19.5)^4 = 0.6678 (g / U10)^4 (s^-4) of Pierson-Moskowitz. If
/// the user has set the peak frequency, B follows from it.
fn pierson_moskowitz_coefficients(inputs: &SpectrumInputs<'_>) -> (f64, f64) {
    let g = inputs.gravity_m_s2;
    let b = match inputs.user_omega_p {
        Some(omega_p) => 1.25 * omega_p.powi(4),
        None => PIERSON_MOSKOWITZ_BETA * (g / (U19_OVER_U10 * inputs.wind_m_s)).powi(4),
    };
    (PHILLIPS_ALPHA * g * g, b)
}

/// Spectrum S(omega) = a omega^-5 exp(-b omega^-4). Its peak is at omega_p = (4/5 b)^(1/4).
fn spectrum_from_coefficients(a: f64, b: f64) -> FrequencySpectrum {
    FrequencySpectrum::new((0.8 * b).powf(0.25), move |omega| a / omega.powi(5) * (-b / omega.powi(4)).exp())
}
