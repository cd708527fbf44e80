//! Double-peaked spectrum of wind sea and swell in the North Sea (Torsethaugen and Haver 2004, simplified form).

use super::jonswap::height_and_peak;
use super::spectrum::{FrequencySpectrum, SpectrumInputs, peak_enhancement};
use std::f64::consts::TAU;

/// Torsethaugen's spectrum: the sum of a primary and a secondary peak. Significant wave height and peak period decide
/// whether the primary peak is the wind sea or the swell.
pub fn spectrum(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    let (hs, omega_p) = height_and_peak(inputs);
    let g = inputs.gravity_m_s2;
    let tp = TAU / omega_p;
    // Peak period (s) of a fully developed sea at the reference fetch of 370 km.
    let full = 6.6 * hs.cbrt();
    let gamma_of = |h: f64, t: f64| (35.0 * (TAU / g * h / (t * t)).powf(0.857)).max(1.0);
    let (share, gamma, second) = if tp <= full {
        let x = 2.0 * (full - tp) / (full - 2.0 * hs.sqrt());
        let share = 0.7 + 0.3 * (-x * x).exp();
        (share, gamma_of(share * hs, tp), full + 2.0)
    } else {
        let room = (25.0 - full).max(0.1);
        let x = (tp - full) / (0.3 * room);
        let share = 0.6 + 0.4 * (-x * x).exp();
        let rest = (1.0 - share * share).sqrt() * hs;
        let longer = 1.0 + 6.0 * ((tp - full) / room).min(1.0);
        (share, gamma_of(hs, full) * longer, 6.6 * rest.cbrt().max(0.05))
    };
    let rest = (1.0 - share * share).max(0.0).sqrt();
    FrequencySpectrum::sum([peak_spectrum(share * hs, tp, gamma), peak_spectrum(rest * hs, second, 1.0)])
}

/// One peak of Torsethaugen's spectrum, with the significant wave height `hs_m` (m) and the peak period `tp_s` (s):
/// proportional to f_n^-4 exp(-f_n^-4) times JONSWAP's peak enhancement, with f_n = omega / omega_p.
fn peak_spectrum(hs_m: f64, tp_s: f64, gamma: f64) -> FrequencySpectrum {
    let (m0, omega_p) = (hs_m * hs_m / 16.0, TAU / tp_s);
    let norm = 3.26 * (1.0 + 1.1 * gamma.ln().powf(1.19)) / gamma;
    FrequencySpectrum::new(omega_p, move |omega| {
        let r = omega / omega_p;
        let sigma = if r < 1.0 { 0.07 } else { 0.09 };
        m0 / omega_p * norm / r.powi(4) * (-1.0 / r.powi(4)).exp() * peak_enhancement(r, gamma, sigma)
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::{at, close, hs, peaks, same};
    use super::*;
    use crate::state::params::SpectrumKind;

    #[test]
    fn wind_sea_or_swell_leads() {
        for wind in [5.0, 10.0, 25.0] {
            let grown = hs(&at(SpectrumKind::Jonswap, wind, 200.0, same));
            // The published norms of the peaks are good to 1 %.
            close(hs(&at(SpectrumKind::Torsethaugen, wind, 200.0, same)), grown, 0.015);
        }
        // Hs = 6 m: wind-dominated below T_f = 6.6 Hs^(1/3) = 12.0 s, swell-dominated above.
        for (tp_s, other) in [(8.0, 14.0), (16.0, 0.0)] {
            let s = at(SpectrumKind::Torsethaugen, 10.0, 200.0, |sea| {
                sea.systems[0].hs_m = 6.0;
                sea.systems[0].tp_s = tp_s;
            });
            let [primary, secondary] = peaks(&s);
            close(TAU / primary, tp_s, 1e-9);
            if other > 0.0 {
                close(TAU / secondary, other, 5e-3);
            } else {
                assert!(TAU / secondary < 12.0, "the wind sea is shorter than the swell");
            }
        }
    }
}
