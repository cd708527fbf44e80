//! Ochi-Hubble spectrum (1976): two peaks with three parameters each. Of the published parameter sets, the most
//! probable one for the significant wave height is used.

use super::jonswap::height_and_peak;
use super::spectrum::{FrequencySpectrum, SpectrumInputs};

/// Ochi-Hubble spectrum: the sum of two peaks. A period set by the user scales both peak frequencies by one factor.
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (hs_m, _) = height_and_peak(inputs);
    // The published factors of the two heights, 0.84 and 0.54, have squares that add to 0.997 instead of 1.
    let share = 1.0 / (0.84f64.powi(2) + 0.54f64.powi(2)).sqrt();
    let peaks = |ratio: f64| {
        FrequencySpectrum::sum([
            peak_spectrum(0.84 * share * hs_m, 0.70 * (-0.046 * hs_m).exp() * ratio, 3.0),
            peak_spectrum(0.54 * share * hs_m, 1.15 * (-0.039 * hs_m).exp() * ratio, 1.54 * (-0.062 * hs_m).exp()),
        ])
    };
    let natural = peaks(1.0);
    match inputs.user_omega_p {
        Some(omega_p) => peaks(omega_p / natural.omega_p),
        None => natural,
    }
}

/// One peak of the Ochi-Hubble spectrum, with significant wave height Hs (m), peak frequency wp (rad/s) and sharpness
/// lambda: S(w) = 1/4 (c wp^4)^lambda / Gamma(lambda) Hs^2 / w^(4 lambda + 1) exp(-c (wp/w)^4), c = lambda + 1/4.
fn peak_spectrum(hs_m: f64, omega_p: f64, lambda: f64) -> FrequencySpectrum {
    let c = (4.0 * lambda + 1.0) / 4.0;
    FrequencySpectrum::new(omega_p, move |omega| {
        let x = (omega_p / omega).powi(4);
        let ln = lambda * (c * x).ln() - libm::lgamma(lambda) - c * x;
        0.25 * hs_m * hs_m / omega * ln.exp()
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::{at, close, hs, peaks, same};
    use crate::state::params::SpectrumKind;

    #[test]
    fn both_peaks_and_the_height() {
        for wind in [5.0, 10.0, 25.0] {
            let grown = hs(&at(SpectrumKind::Jonswap, wind, 200.0, same));
            close(hs(&at(SpectrumKind::OchiHubble, wind, 200.0, same)), grown, 1e-3);
        }
        // Hs = 4 m: Ochi and Hubble's peaks at 0.70 exp(-0.046 Hs) and 1.15 exp(-0.039 Hs).
        let s = at(SpectrumKind::OchiHubble, 10.0, 200.0, |sea| sea.systems[0].hs_m = 4.0);
        let [low, high] = peaks(&s);
        close(low, 0.5824, 1e-3);
        close(high, 0.9839, 1e-3);
        close(hs(&s), 4.0, 1e-6);
    }
}
