//! Unified spectrum of gravity and capillary waves (Elfouhaily, Chapron, Katsaros and Vandemark 1997).

use super::donelan::peak_enhancement_and_width;
use super::spectrum::{FrequencySpectrum, SpectrumInputs, peak_enhancement};

/// Wave number at which the phase speed of water waves is lowest, rad/m.
const MIN_PHASE_SPEED_WAVE_NUMBER: f64 = 370.0;
/// Lowest phase speed of water waves, m/s.
const MIN_PHASE_SPEED_M_S: f64 = 0.23;

/// Elfouhaily's omnidirectional spectrum S(k) = k^-3 (B_low + B_high), m^3, with the curvature spectra of long waves
/// (B_low) and of short waves (B_high), converted to S(omega).
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (g, u, dispersion) = (inputs.gravity_m_s2, inputs.wind_m_s, inputs.dispersion);
    let grown = 0.84 * ((inputs.dimensionless_fetch / 2.2e4).powf(0.4)).tanh().powf(-0.75);
    let omega_p = inputs.user_omega_p.unwrap_or(grown.clamp(0.84, 5.0) * g / u);
    let k_p = omega_p * omega_p / g;
    let inverse_age = (u * omega_p / g).clamp(0.84, 5.0);
    let (gamma, sigma) = peak_enhancement_and_width(inverse_age);
    let friction = friction_velocity(u) / MIN_PHASE_SPEED_M_S;
    let growth = 1.0 + if friction < 1.0 { friction.ln() } else { 3.0 * friction.ln() };
    let (alpha_p, alpha_m) = (6e-3 * inverse_age.sqrt(), (0.01 * growth).max(0.0));
    // Phase speed (m/s) with the surface tension that the paper assumes.
    let speed = move |k: f64| (g / k * (1.0 + (k / MIN_PHASE_SPEED_WAVE_NUMBER).powi(2))).sqrt();
    let density_k = move |k: f64| {
        let ratio = (k / k_p).sqrt();
        let pierson_moskowitz = (-1.25 / ratio.powi(4)).exp();
        let cutoff = (-inverse_age / 10f64.sqrt() * (ratio - 1.0)).exp();
        let long = pierson_moskowitz * peak_enhancement(ratio, gamma, sigma) * cutoff;
        // The Pierson-Moskowitz factor removes the capillary term from waves longer than the peak.
        let short = pierson_moskowitz * (-0.25 * (k / MIN_PHASE_SPEED_WAVE_NUMBER - 1.0).powi(2)).exp();
        let curvature = 0.5 * (alpha_p * speed(k_p) * long + alpha_m * MIN_PHASE_SPEED_M_S * short) / speed(k);
        curvature / k.powi(3)
    };
    let density = move |omega| dispersion.density_over_omega(density_k, omega);
    let mut spectrum = FrequencySpectrum::new(dispersion.omega(k_p), density);
    // Breakpoints around the secondary maximum of the capillary waves.
    spectrum.integration_breakpoints_rad_s.extend([100.0, 370.0, 1500.0].map(|k| dispersion.omega(k)));
    spectrum
}

/// Friction velocity (m/s) of a wind speed at 10 m height (m/s), with the drag coefficient of Wu 1982.
fn friction_velocity(wind_m_s: f64) -> f64 {
    wind_m_s * (1e-3 * (0.8 + 0.065 * wind_m_s)).sqrt()
}

/// Coefficient Delta (0 to 1) of Elfouhaily's directional spreading (1 + Delta cos 2 theta) / (2 pi), for waves with
/// the phase speed `c` (m/s) in a sea whose peak has the phase speed `c_p` (m/s), at the wind speed `wind_m_s` (m/s).
pub fn elfouhaily_delta(c: f64, c_p: f64, wind_m_s: f64) -> f64 {
    let ripples = 0.13 * friction_velocity(wind_m_s) / MIN_PHASE_SPEED_M_S;
    let (a_0, a_p) = (2f64.ln() / 4.0, 4.0);
    (a_0 + a_p * (c / c_p).powf(2.5) + ripples * (MIN_PHASE_SPEED_M_S / c).powf(2.5)).tanh()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{at, close, hs};
    use crate::state::params::{DispersionKind, Sea, SpectrumKind};
    use crate::waves::dispersion::Dispersion;
    use crate::waves::quadrature::integrate_adaptive;

    #[test]
    fn elfouhaily_is_a_sea_with_ripples() {
        // Full development, U = 10 m/s: the height of Pierson and Moskowitz within a fifth; slopes of Cox and Munk
        // within a quarter once the capillary waves are in.
        let s = at(SpectrumKind::Elfouhaily, 10.0, 2000.0, |sea| sea.dispersion = DispersionKind::Capillary);
        close(hs(&s), 2.245, 0.2);
        let waves = Dispersion::new(&Sea { dispersion: DispersionKind::Capillary, ..Sea::default() });
        let (low, high) = (s.frequency_range().0, waves.omega(6000.0));
        let knots: Vec<f64> = (0..=12).map(|i| low * (high / low).powf(f64::from(i) / 12.0)).collect();
        let mss = integrate_adaptive(|w| s.density(w) * waves.wave_number(w).powi(2), &knots, 1e-8);
        close(mss, 0.003 + 0.00512 * 10.0, 0.25);
    }
}
