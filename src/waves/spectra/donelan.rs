//! Frequency spectrum of a fetch-limited sea that falls as omega^-4 above the peak (Donelan, Hamilton and Hui 1985).

use super::spectrum::{FrequencySpectrum, SpectrumInputs, peak_enhancement};

/// Donelan's spectrum S(omega) = alpha g^2 omega^-4 omega_p^-1 exp(-(omega_p/omega)^4) times the peak enhancement. The
/// level alpha and the enhancement follow from the inverse wave age U/c_p (wind speed over phase speed at the peak) of
/// 0.83 (full development) to 5. Above 3.5 omega_p the mean square slope of the fit exceeds that of a real sea.
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (g, u) = (inputs.gravity_m_s2, inputs.wind_m_s);
    let grown = (11.6 * inputs.dimensionless_fetch.powf(-0.23)).clamp(0.83, 5.0);
    let omega_p = inputs.user_omega_p.unwrap_or(grown * g / u);
    let inverse_age = (u * omega_p / g).clamp(0.83, 5.0);
    let alpha = 0.006 * inverse_age.powf(0.55);
    let a = alpha * g * g / omega_p;
    let (gamma, sigma) = peak_enhancement_and_width(inverse_age);
    FrequencySpectrum::new(omega_p, move |omega| {
        let r = omega / omega_p;
        a / omega.powi(4) * (-1.0 / r.powi(4)).exp() * peak_enhancement(r, gamma, sigma)
    })
}

/// Returns peak enhancement gamma and peak width sigma (relative to the peak frequency) of Donelan's spectrum at the
/// inverse wave age U/c_p (wind speed over phase speed at the peak).
pub fn peak_enhancement_and_width(inverse_age: f64) -> (f64, f64) {
    (1.7 + 6.0 * inverse_age.max(1.0).log10(), 0.08 * (1.0 + 4.0 / inverse_age.powi(3)))
}
