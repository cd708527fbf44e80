//! Spectrum of Karaev and Balandina 2000 and Karaev et al. 2008: JONSWAP with a tail of power laws to capillary waves.

use super::depth_limit::depth_factor;
use super::jonswap::Jonswap;
use super::spectrum::{FrequencySpectrum, SpectrumInputs};

/// Smallest and largest dimensionless fetch g F / U^2 (gravity g, fetch F, wind speed U) for which Karaev's fit of the
/// peak frequency holds.
const DIMENSIONLESS_FETCH_RANGE: (f64, f64) = (1430.0, 20170.0);
/// Angular frequencies, rad/s, at which the power laws of Karaev's spectrum for gravity-capillary waves (first) and for
/// capillary waves (second) begin.
const RIPPLE_BAND_STARTS_RAD_S: (f64, f64) = (64.0, 298.0);

/// Karaev's spectrum: up to 1.2 times the peak frequency JONSWAP, if the user asks for it times the depth factor of
/// TMA; then the power laws omega^-4, omega^-5, omega^-2.7 and omega^-5. The five branches join continuously.
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (g, u) = (inputs.gravity_m_s2, inputs.wind_m_s);
    let x = inputs.dimensionless_fetch.clamp(DIMENSIONLESS_FETCH_RANGE.0, DIMENSIONLESS_FETCH_RANGE.1);
    let notice = (x != inputs.dimensionless_fetch).then(|| {
        let fetch_km = inputs.fetch_km(x);
        format!(
            "karaev covers g F / U^2 from {} to {}: a fetch of {fetch_km:.0} km is used",
            DIMENSIONLESS_FETCH_RANGE.0, DIMENSIONLESS_FETCH_RANGE.1
        )
    });
    let peak = 0.61826 + 3.529e-7 * x - 0.001_975_08 * x.sqrt() + 62.554 / x.sqrt() - 290.2 / x;
    let omega_p = inputs.user_omega_p.unwrap_or(peak * g / u);
    let jonswap = Jonswap { alpha_g2: 0.076 * x.powf(-0.22) * g * g, omega_p, ..Jonswap::new(inputs) };
    let factor = inputs.sea.karaev_tma.then(|| depth_factor(inputs));
    let around_peak = move |omega| jonswap.density(omega) * factor.map_or(1.0, |f| f(omega));
    let second = (0.3713 + 0.29024 * u + 0.2902 / u).max(1.2) * omega_p;
    let third = second.max(RIPPLE_BAND_STARTS_RAD_S.0);
    // Lower ends (rad/s), negative exponents and densities at the lower end of the four power laws.
    let from = [1.2 * omega_p, second, third, third.max(RIPPLE_BAND_STARTS_RAD_S.1)];
    let power = [4.0, 5.0, 2.7, 5.0];
    let mut start = [around_peak(from[0]); 4];
    for i in 1..4 {
        start[i] = start[i - 1] * (from[i - 1] / from[i]).powf(power[i - 1]);
    }
    let density = move |omega| match from.iter().rposition(|&low| omega > low) {
        None => around_peak(omega),
        Some(i) => start[i] * (from[i] / omega).powf(power[i]),
    };
    let mut spectrum = FrequencySpectrum::new(omega_p, density);
    spectrum.integration_breakpoints_rad_s.extend(from);
    FrequencySpectrum { notice, ..spectrum }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{G, at, close, same};
    use crate::state::params::SpectrumKind;

    #[test]
    fn karaev_is_continuous_and_clamped() {
        for (wind, tma) in [(0.5, false), (5.0, false), (10.0, true), (30.0, false)] {
            let s = at(SpectrumKind::Karaev, wind, 50.0, |sea| {
                sea.karaev_tma = tma;
                sea.depth_m = 20.0;
            });
            // The joints of the branches follow the six breakpoints around the peak.
            let joints = s.integration_breakpoints_rad_s[6..].to_vec();
            for joint in &joints {
                close(s.density(joint * (1.0 - 1e-9)), s.density(joint * (1.0 + 1e-9)), 1e-6);
            }
            // The last two branches: w^-2.7 between gravity-capillary and capillary waves, then w^-5.
            let slope = |w: f64| (s.density(1.01 * w) / s.density(w)).ln() / 1.01f64.ln();
            close(slope(2.0 * joints[3]), -5.0, 1e-6);
            close(slope(0.9 * joints[3]), -2.7, 1e-6);
        }
        // Dimensionless peak frequencies of the fit.
        for (x, peak) in [(1430.0, 1.995), (5000.0, 1.307), (20170.0, 0.771)] {
            let s = at(SpectrumKind::Karaev, 10.0, x * 100.0 / G / 1000.0, same);
            close(s.omega_p * 10.0 / G, peak, 1e-3);
        }
        assert!(at(SpectrumKind::Karaev, 10.0, 2000.0, same).notice.is_some());
    }
}
