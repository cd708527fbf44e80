//! Tests that compare all frequency spectra with published values, and helpers for the tests of single spectra.

use super::*;
use std::f64::consts::PI;

pub const G: f64 = 9.81;

/// Frequency spectrum of the local wave system with the given family, wind (m/s) and fetch (km). All other parameters
/// have their defaults, except those that `change` sets.
pub fn at(spectrum: SpectrumKind, wind_m_s: f64, fetch_km: f64, change: impl Fn(&mut Sea)) -> FrequencySpectrum {
    let mut sea = Sea::default();
    sea.systems[0] = WaveSystemParams { spectrum, wind_m_s, fetch_km, ..sea.systems[0].clone() };
    change(&mut sea);
    spectrum_of_system(&sea, &sea.systems[0])
}

pub fn hs(s: &FrequencySpectrum) -> f64 {
    4.0 * s.variance_m2().sqrt()
}

#[track_caller]
pub fn close(got: f64, want: f64, tolerance: f64) {
    assert!((got / want - 1.0).abs() < tolerance, "{got} instead of {want}");
}

/// Angular frequencies (rad/s) of both peaks of a double-peaked spectrum: the third of the six breakpoints of each
/// peak.
pub fn peaks(s: &FrequencySpectrum) -> [f64; 2] {
    [2, 8].map(|i| s.integration_breakpoints_rad_s[i])
}

/// Leaves the sea as it is; for the argument `change` of [`at`].
pub fn same(_: &mut Sea) {}

/// All spectrum families except the measured one, which needs a buoy's data.
fn kinds() -> impl Iterator<Item = SpectrumKind> {
    SpectrumKind::ALL.iter().copied().filter(|kind| *kind != SpectrumKind::Measured)
}

#[test]
fn published_heights_and_peaks() {
    let jonswap = at(SpectrumKind::Jonswap, 10.0, 100.0, same);
    close(hs(&jonswap), 2.139, 1e-3);
    close(jonswap.omega_p, 1.008, 1e-3);
    let pm = at(SpectrumKind::PiersonMoskowitz, 10.0, 100.0, same);
    close(hs(&pm), 2.245, 1e-3);
    // Hs g / U^2 = 4 sqrt(alpha / (4 beta)) 1.026^2 = 0.2203.
    close(hs(&pm) * G / 100.0, 4.0 * (8.1e-3f64 / (4.0 * 0.74)).sqrt() * 1.026f64.powi(2), 1e-6);
    // Phillips: alpha g^2 / (4 w_p^4), w_p as Pierson and Moskowitz' (5/4 w_p^4 = B).
    let phillips = at(SpectrumKind::Phillips, 10.0, 100.0, same);
    close(phillips.variance_m2(), 8.1e-3 * G * G / (4.0 * phillips.omega_p.powi(4)), 1e-6);
    close(phillips.omega_p, 0.855 * G / 10.0, 1e-2);
    // A w^-5 exp(-B w^-4) integrates to A / (4 B).
    let ab = at(SpectrumKind::GeneralisedAb, 10.0, 100.0, |sea| {
        sea.systems[0].coefficient_a = 2.0;
        sea.systems[0].coefficient_b = 0.7;
    });
    close(ab.variance_m2(), 2.0 / (4.0 * 0.7), 1e-6);
    // Tessendorf: pi A L^2 / 2 over the wave-number plane, L = U^2 / g, at any depth.
    for depth_m in [4000.0, 30.0] {
        let tessendorf = at(SpectrumKind::Tessendorf, 10.0, 100.0, |sea| sea.depth_m = depth_m);
        let length = 100.0 / G;
        close(tessendorf.variance_m2(), 0.5 * PI * (8.1e-3 / (2.0 * PI)) * length * length, 2e-3);
    }
}

#[test]
fn growth_laws_of_their_authors() {
    for (wind, fetch_km) in [(7.0, 10.0), (10.0, 50.0), (15.0, 300.0)] {
        let x = G * 1000.0 * fetch_km / (wind * wind);
        let scale = (G / (wind * wind)).powi(2);
        // Hasselmann et al. 1973: alpha and omega_p over x, and 0.305 alpha g^2 / omega_p^4 for gamma 3.3.
        let shape = 0.305 * 0.076 * x.powf(-0.22) / (22.0 * x.powf(-1.0 / 3.0)).powi(4);
        close(at(SpectrumKind::Jonswap, wind, fetch_km, same).variance_m2() * scale, shape, 0.01);
        // Donelan et al. 1985: 2.74e-3 (U/c_p)^-3.3.
        let donelan = at(SpectrumKind::Donelan, wind, fetch_km, same);
        let age = wind * donelan.omega_p / G;
        close(age, (11.6 * x.powf(-0.23)).max(0.83), 1e-6);
        close(donelan.variance_m2() * scale, 2.74e-3 * age.powf(-3.3), 0.1);
    }
}

#[test]
fn own_sizes_come_out() {
    for kind in kinds() {
        let s = at(kind, 0.0, 100.0, |sea| {
            sea.systems[0].hs_m = 3.0;
            sea.systems[0].tp_s = 9.0;
            sea.systems[0].fade_m = 0.5;
        });
        close(hs(&s), 3.0, 1e-4);
        let peak = (1..4000).map(|i| 0.001 * f64::from(i)).max_by(|a, b| s.density(*a).total_cmp(&s.density(*b)));
        // The peak enhancements of Donelan and Elfouhaily shift the maximum by a few per cent from omega_p.
        close(peak.unwrap(), TAU / 9.0, 0.06);
        assert!(at(kind, 0.0, 100.0, same).is_calm, "{kind:?} without wind");
    }
}

#[test]
fn never_negative_nor_infinite() {
    for kind in kinds() {
        for wind in [0.06, 1.0, 12.0, 60.0] {
            let s = at(kind, wind, 150.0, same);
            for i in 0..400 {
                let d = s.density(1e-3 * 1.035f64.powi(i));
                assert!(d.is_finite() && d >= 0.0, "{kind:?} {wind}");
            }
        }
    }
}
