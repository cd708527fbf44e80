//! MarNeRo, a frequency spectrum for the Black Sea near the shore (Trusca 2007).

use super::jonswap::height_and_peak;
use super::spectrum::{FrequencySpectrum, SpectrumInputs};

/// Exponent of the ratio wm/w of mean frequency to frequency in the exponential of the MarNeRo spectrum.
const FREQUENCY_EXPONENT: f64 = 5.9285;
/// Factor of (wm/w)^5.9285 in the exponential of the MarNeRo spectrum, with the mean frequency wm.
const EXPONENTIAL_FACTOR: f64 = 0.3883;

/// MarNeRo spectrum S(w) = 2.302 (E/wm) (wm/w)^6.9285 exp(-0.3883 (wm/w)^5.9285) over the angular frequency w, with the
/// mean frequency wm and the elevation variance E. With the published factor, 2.202, the integral would not be E.
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (hs_m, omega_p) = height_and_peak(inputs);
    let m0 = hs_m * hs_m / 16.0;
    // Peak frequency over mean frequency, from the zero of the derivative of S.
    let peak_over_mean =
        (FREQUENCY_EXPONENT * EXPONENTIAL_FACTOR / (FREQUENCY_EXPONENT + 1.0)).powf(1.0 / FREQUENCY_EXPONENT);
    let mean_omega = omega_p / peak_over_mean;
    FrequencySpectrum::new(mean_omega * peak_over_mean, move |omega| {
        let x = mean_omega / omega;
        FREQUENCY_EXPONENT * EXPONENTIAL_FACTOR * m0 / mean_omega
            * x.powf(FREQUENCY_EXPONENT + 1.0)
            * (-EXPONENTIAL_FACTOR * x.powf(FREQUENCY_EXPONENT)).exp()
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::{at, close, hs};
    use crate::state::params::SpectrumKind;
    use std::f64::consts::TAU;

    #[test]
    fn marnero_holds_the_energy_that_it_is_given() {
        let s = at(SpectrumKind::Marnero, 10.0, 100.0, |sea| sea.systems[0].tp_s = 8.0);
        // Without `hs` nothing is rescaled: the height is the grown one, 2.139 m, if the constant is right.
        close(hs(&s), 2.139, 1e-3);
        close(s.omega_p, TAU / 8.0, 1e-9);
        let mean = TAU / 8.0 / (5.9285f64 * 0.3883 / 6.9285).powf(1.0 / 5.9285);
        let largest =
            (0..2000).map(|i| 0.5 + 0.0005 * f64::from(i)).max_by(|a, b| s.density(*a).total_cmp(&s.density(*b)));
        close(largest.unwrap(), s.omega_p, 1e-3);
        assert!(mean > s.omega_p);
    }
}
