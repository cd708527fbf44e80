//! Kitaigorodskii's depth factor, with which shallow water limits the energy of a spectrum for deep water.

use super::spectrum::{FrequencySpectrum, SpectrumInputs};
use crate::state::params::DepthFactor;
use crate::waves::dispersion::Dispersion;
use std::sync::Arc;

/// Returns a spectrum multiplied by the depth factor of the sea of `inputs`. The peak frequency stays as it was.
pub fn with_depth_factor(inputs: &SpectrumInputs<'_>, spectrum: FrequencySpectrum) -> FrequencySpectrum {
    let (factor, deep) = (depth_factor(inputs), Arc::clone(&spectrum.unscaled_density));
    let mut out =
        FrequencySpectrum { unscaled_density: Arc::new(move |omega| deep(omega) * factor(omega)), ..spectrum };
    if inputs.sea.depth_factor == DepthFactor::Branches {
        let unit = (inputs.sea.depth_m / inputs.gravity_m_s2).sqrt();
        out.integration_breakpoints_rad_s.extend([1.0, 2.0].map(|x| x / unit));
    }
    out
}

/// Returns the depth factor of Kitaigorodskii et al. 1975 as a function of the angular frequency (rad/s). The factor is
/// 1 in deep water and reduces the spectrum in shallow water.
pub fn depth_factor(inputs: &SpectrumInputs<'_>) -> impl Fn(f64) -> f64 + Copy + Send + Sync + use<> {
    let (form, g, depth_m) = (inputs.sea.depth_factor, inputs.gravity_m_s2, inputs.sea.depth_m);
    let dispersion = Dispersion::finite_depth(g, depth_m);
    move |omega| match form {
        DepthFactor::Exact => {
            let kh = depth_m * dispersion.wave_number(omega);
            let shallow = if kh > 300.0 { 0.0 } else { 2.0 * kh / (2.0 * kh).sinh() };
            kh.tanh().powi(2) / (1.0 + shallow)
        }
        DepthFactor::Branches => match omega * (depth_m / g).sqrt() {
            x if x <= 1.0 => 0.5 * x * x,
            x if x < 2.0 => 1.0 - 0.5 * (2.0 - x).powi(2),
            _ => 1.0,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{G, at, close, hs, same};
    use super::*;
    use crate::state::params::{DepthLimit, Sea, SpectrumKind};

    /// Angular frequencies of the comparisons, rad/s.
    fn omegas() -> impl Iterator<Item = f64> {
        (0..600).map(|i| 0.1 * 1.015f64.powi(i))
    }

    fn set(sea: &mut Sea, depth_m: f64, depth_limit: DepthLimit) {
        (sea.depth_m, sea.depth_limit) = (depth_m, depth_limit);
    }

    #[test]
    fn the_depth_factor() {
        let phi = |form: DepthFactor, omega_h: f64| {
            let shallow = |sea: &mut Sea| {
                set(sea, 20.0, DepthLimit::Ignored);
                sea.depth_factor = form;
            };
            let omega = omega_h / (20.0 / G).sqrt();
            at(SpectrumKind::Tma, 10.0, 100.0, shallow).density(omega)
                / at(SpectrumKind::Jonswap, 10.0, 100.0, shallow).density(omega)
        };
        for (omega_h, value) in [(0.9, 0.405), (1.5, 0.875), (2.0, 1.0), (3.0, 1.0), (10.0, 1.0)] {
            close(phi(DepthFactor::Branches, omega_h), value, 1e-9);
        }
        for i in 1..60 {
            let omega_h = 0.8 + 0.1 * f64::from(i);
            let (exact, fit) = (phi(DepthFactor::Exact, omega_h), phi(DepthFactor::Branches, omega_h));
            assert!((exact - fit).abs() < 0.024 && exact <= 1.0 + 1e-9, "{omega_h}: {exact} {fit}");
            assert!(phi(DepthFactor::Exact, omega_h + 0.1) >= exact - 1e-9, "monotone");
        }
    }

    #[test]
    fn jonswap_with_the_limit_is_tma() {
        // The peak frequency is 1.008 rad/s.
        for (depth_m, kp_h) in [(29.1, 3.0), (16.0, 1.5), (12.6, 1.27), (8.0, 1.0), (2.3, 0.5)] {
            for form in [DepthFactor::Exact, DepthFactor::Branches] {
                let shallow = |sea: &mut Sea| {
                    set(sea, depth_m, DepthLimit::Kitaigorodskii);
                    sea.depth_factor = form;
                };
                let limited = at(SpectrumKind::Jonswap, 10.0, 100.0, shallow);
                let tma = at(SpectrumKind::Tma, 10.0, 100.0, shallow);
                let got_kp_h = depth_m * Dispersion::finite_depth(G, depth_m).wave_number(limited.omega_p);
                close(got_kp_h, kp_h, 0.2);
                for omega in omegas() {
                    let (a, b) = (limited.density(omega), tma.density(omega));
                    assert!((a - b).abs() <= 1e-12 * b, "{depth_m} m, {omega} rad/s: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn deep_water_changes_no_bit() {
        for kind in SpectrumKind::ALL {
            let deep = |limit: DepthLimit| at(kind, 14.0, 300.0, |sea| set(sea, 4000.0, limit));
            let (limited, free) = (deep(DepthLimit::Kitaigorodskii), deep(DepthLimit::Ignored));
            for omega in omegas() {
                assert_eq!(limited.density(omega).to_bits(), free.density(omega).to_bits(), "{kind:?} {omega}");
            }
            assert_eq!(limited.variance_m2().to_bits(), free.variance_m2().to_bits(), "{kind:?}");
            // At a metre less the factor of these waves is 1 but for rounding.
            let less = at(kind, 14.0, 300.0, |sea| set(sea, 3999.0, DepthLimit::Kitaigorodskii));
            close(hs(&less), hs(&free), 1e-12);
        }
    }

    #[test]
    fn each_spectrum_is_limited_once() {
        for kind in SpectrumKind::ALL {
            let with = |limit: DepthLimit| at(kind, 10.0, 100.0, |sea| set(sea, 10.0, limit));
            let (limited, free) = (with(DepthLimit::Kitaigorodskii), with(DepthLimit::Ignored));
            let tma = at(SpectrumKind::Tma, 10.0, 100.0, |sea| set(sea, 10.0, DepthLimit::Ignored));
            let jonswap = at(SpectrumKind::Jonswap, 10.0, 100.0, |sea| set(sea, 10.0, DepthLimit::Ignored));
            for omega in omegas().filter(|&omega| omega > 0.9 && omega < 3.0 && free.density(omega) > 0.0) {
                let factor = if kind.is_for_deep_water() { tma.density(omega) / jonswap.density(omega) } else { 1.0 };
                close(limited.density(omega) / free.density(omega), factor, 1e-9);
            }
        }
        // Karaev's own rule replaces the factor at all frequencies.
        let karaev = |limit: DepthLimit| {
            at(SpectrumKind::Karaev, 10.0, 100.0, |sea| {
                set(sea, 10.0, limit);
                sea.karaev_tma = true;
            })
        };
        let (limited, free) = (karaev(DepthLimit::Kitaigorodskii), karaev(DepthLimit::Ignored));
        assert!(omegas().all(|omega| limited.density(omega) == free.density(omega)));
    }

    #[test]
    fn a_set_height_stays() {
        for kind in SpectrumKind::ALL {
            let s = at(kind, 10.0, 100.0, |sea| {
                set(sea, 8.0, DepthLimit::Kitaigorodskii);
                (sea.systems[0].hs_m, sea.systems[0].tp_s) = (1.2, 7.0);
            });
            close(hs(&s), 1.2, 1e-6);
        }
        // Without a set height shallow water lowers the sea.
        let at_10_m = |limit| hs(&at(SpectrumKind::Jonswap, 10.0, 100.0, |sea| set(sea, 10.0, limit)));
        assert!(at_10_m(DepthLimit::Kitaigorodskii) < 0.8 * at_10_m(DepthLimit::Ignored));
        close(at_10_m(DepthLimit::Ignored), hs(&at(SpectrumKind::Jonswap, 10.0, 100.0, same)), 1e-12);
    }
}
