//! Tests that the sample files in `assets/spectra` have the heights, periods and directions that they state.

use super::super::MeasuredSpectrum;
use super::{sea, title};
use std::f64::consts::TAU;

pub(super) const JONSWAP: &str = include_str!("../../../../assets/spectra/jonswap-10ms-100km.csv");
pub(super) const TWO_SYSTEMS: &str = include_str!("../../../../assets/spectra/two-systems.txt");
pub(super) const PIERSON_MOSKOWITZ: &str = include_str!("../../../../assets/spectra/pierson-moskowitz.data_spec");

#[test]
fn heights_and_peaks_of_the_samples_are_the_known_ones() {
    let peak_period = |sea: &MeasuredSpectrum| TAU / sea.omega_p();
    for (name, text, hs, tp, directional) in [
        ("jonswap-10ms-100km.csv", JONSWAP, 2.139, 6.23, true),
        ("two-systems.txt", TWO_SYSTEMS, 2.332, 13.0, true),
        ("pierson-moskowitz.data_spec", PIERSON_MOSKOWITZ, 3.233, 8.99, false),
    ] {
        let sea = sea(&[(name, text)]);
        assert!((sea.hs_m() / hs - 1.0).abs() < 0.01, "{name}: Hs {}", sea.hs_m());
        let band = |tp: f64| sea.bands().partition_point(|b| b.0 < 1.0 / tp);
        assert!(band(peak_period(&sea)).abs_diff(band(tp)) <= 1, "{name}: Tp {}", peak_period(&sea));
        assert_eq!(sea.directions().is_some(), directional, "{name}");
        assert!(title(&[(name, text)]).starts_with(name));
    }
}

#[test]
fn the_directions_of_the_samples_are_the_known_ones() {
    for d in sea(&[("a.csv", JONSWAP)]).directions().expect("directions") {
        assert_eq!((d.alpha1_deg, d.r1 >= d.r2), (240.0, true));
    }
    let sea = sea(&[("a.txt", TWO_SYSTEMS)]);
    let directions = sea.directions().expect("directions");
    let at = |f: f64| directions[sea.bands().partition_point(|b| b.0 < f)];
    // The spectral tail of the swell turns the direction of the wind sea a little.
    assert!((at(0.0775).alpha1_deg - 290.0).abs() < 0.5 && (at(0.0775).r1 - 30.0 / 31.0).abs() < 0.003);
    // With s = 30, r2 = s (s - 1) / ((s + 1) (s + 2)).
    assert!((at(0.0775).alpha2_deg - 290.0).abs() < 0.5 && (at(0.0775).r2 - 870.0 / 992.0).abs() < 0.003);
    assert!((at(0.25).alpha1_deg - 200.0).abs() < 10.0 && (at(0.25).r1 - 0.8).abs() < 0.1);
    assert_eq!(directions[0], directions[1], "nothing is known of the lowest band");
}
