//! Tests of variance densities, wave heights, peak frequencies and directions of measured spectra.

use super::super::{DirectionalParameters, MaximumEntropyDistribution, MeasuredSpectrum};
use super::samples::JONSWAP;
use super::{read, sea};
use std::f64::consts::TAU;

#[test]
fn a_broad_lobe_has_its_principal_direction_across() {
    let d = DirectionalParameters::from_spread(30.0, (2.0 * (1.0 - 1.0 / 3.0_f64)).sqrt().to_degrees());
    // With r1 = 1/3, s = 1/2 and r2 = 0.5 x (-0.5) / (1.5 x 2.5) = -1/15.
    assert!((d.r1 - 1.0 / 3.0).abs() < 1e-12 && (d.r2 - 1.0 / 15.0).abs() < 1e-12 && d.alpha2_deg == 120.0, "{d:?}");
    assert_eq!(DirectionalParameters::from_spread(30.0, 100.0).r1, 0.0);
}

/// Integral of `f` from the first to the last of `knots`, by the midpoint rule in each interval between them.
fn integral(f: impl Fn(f64) -> f64, knots: &[f64]) -> f64 {
    let steps = 400;
    let piece = |w: &[f64]| {
        let dx = (w[1] - w[0]) / f64::from(steps);
        (0..steps).map(|i| f(w[0] + (f64::from(i) + 0.5) * dx) * dx).sum::<f64>()
    };
    knots.windows(2).map(piece).sum()
}

#[test]
fn the_density_integrates_to_the_variances() {
    for text in [JONSWAP, "0.1,1\n0.15,3\n0.3,2\n", "0.1,0.5\n0.4,3\n0.5,0.2\n"] {
        let sea = read(&[("b.csv", text)]).expect("a sea").0;
        let mut knots = sea.density_kinks_rad_s();
        let low = sea.lowest_omega();
        assert!((knots[0] - low).abs() < 1e-9 || knots[0] > low);
        knots.insert(0, 0.0);
        assert!((integral(|w| sea.density(w), &knots) / sea.variance_m2() - 1.0).abs() < 1e-9, "{text}");
        let last = knots[knots.len() - 1];
        // Spectral tail up to 100 times the last frequency f; its variance is S f / 4.
        let tail: Vec<f64> = (0..=20).map(|i| last * 100f64.powf(f64::from(i) / 20.0)).collect();
        let variance = 0.25 * sea.density(last) * last;
        assert!((integral(|w| sea.density(w), &tail) / variance - 1.0).abs() < 1e-5, "{text}");
    }
}

#[test]
fn densities_between_below_and_above_the_bands() {
    let sea = sea(&[("b", "0.1,1\n0.15,3\n0.3,2\n")]);
    let at = |f: f64| TAU * sea.density(TAU * f);
    for (f, s) in [(0.1, 1.0), (0.125, 2.0), (0.15, 3.0), (0.225, 2.5), (0.3, 2.0), (0.6, 2.0 / 32.0), (0.075, 0.5)] {
        assert!((at(f) - s).abs() < 1e-12, "{f}: {}", at(f));
    }
    assert_eq!((at(0.05 - 1e-9), at(0.0), at(-1.0)), (0.0, 0.0, 0.0));
    assert_eq!(sea.variance_m2(), 0.5 * 0.05 + 2.0 * 0.05 + 2.5 * 0.15);
    assert_eq!(sea.hs_m(), 4.0 * sea.variance_m2().sqrt());
}

#[test]
fn the_peak_is_a_parabolas() {
    // Densities on a parabola with its vertex at 0.2 Hz, at uneven steps.
    let s = |f: f64| 5.0 - 100.0 * (f - 0.2) * (f - 0.2);
    let text: String = [0.12, 0.18, 0.23, 0.31].iter().map(|&f| format!("{f},{}\n", s(f))).collect();
    assert!((sea(&[("b", &text)]).omega_p() / TAU - 0.2).abs() < 1e-9);
    for (text, f) in [("0.1,3\n0.2,2\n0.3,1\n", 0.1), ("0.1,1\n0.2,2\n0.3,3\n", 0.3), ("0.1,1\n0.2,1\n0.3,1\n", 0.1)] {
        assert_eq!(sea(&[("b", text)]).omega_p(), TAU * f);
    }
}

#[test]
fn moments_point_where_the_waves_go() {
    let of = |from: f64, f: f64| {
        let d = DirectionalParameters { alpha1_deg: from, alpha2_deg: from, r1: 0.5, r2: 0.25 };
        let sea = MeasuredSpectrum::new(&[(0.1, 1.0), (0.2, 1.0), (0.3, 1.0)], Some(&[d, d, d])).expect("a sea");
        sea.directional_moments(TAU * f).expect("directions")
    };
    // Waves from the west travel along +x, waves from the north along +z, at any frequency.
    for (from, want) in [
        (270.0, [0.5, 0.0, 0.25, 0.0]),
        (0.0, [0.0, 0.5, -0.25, 0.0]),
        (90.0, [-0.5, 0.0, 0.25, 0.0]),
        (225.0, [0.5_f64.sqrt() / 2.0, -(0.5_f64.sqrt()) / 2.0, 0.0, -0.25]),
    ] {
        for f in [0.01, 0.1, 0.17, 0.3, 5.0] {
            assert!(of(from, f).iter().zip(want).all(|(g, w)| (g - w).abs() < 1e-12), "{from}: {:?}", of(from, f));
        }
    }
    // The moments are linear between bands, so the mean of 350 and 10 degrees is 0, not 180.
    let side = |from: f64| DirectionalParameters { alpha1_deg: from, alpha2_deg: from, r1: 1.0, r2: 1.0 };
    let bands = [(0.1, 1.0), (0.2, 1.0), (0.3, 1.0)];
    let sea = MeasuredSpectrum::new(&bands, Some(&[side(350.0), side(10.0), side(10.0)])).expect("a sea");
    let [x, z, ..] = sea.directional_moments(TAU * 0.15).expect("directions");
    assert!(x.abs() < 1e-12 && (z - 10f64.to_radians().cos()).abs() < 1e-12);
}

#[test]
fn the_distribution_has_the_buoys_moments() {
    let d = DirectionalParameters { alpha1_deg: 240.0, alpha2_deg: 250.0, r1: 0.8, r2: 0.5 };
    let sea = MeasuredSpectrum::new(&[(0.1, 1.0), (0.2, 1.0), (0.3, 1.0)], Some(&[d, d, d])).expect("a sea");
    let mem = MaximumEntropyDistribution::new(sea.directional_moments(1.0).expect("directions"));
    // Means over the direction A waves come from: r1 = <cos(A - alpha1)>, r2 = <cos 2 (A - alpha2)>; sines have mean 0.
    let n = 4096;
    let mut sums = [0.0; 4];
    for i in 0..n {
        let from = TAU * f64::from(i) / f64::from(n);
        let weight = mem.density(from.cos().atan2(-from.sin())) * TAU / f64::from(n);
        let (a, b) = (from - d.alpha1_deg.to_radians(), 2.0 * (from - d.alpha2_deg.to_radians()));
        for (sum, part) in sums.iter_mut().zip([a.cos(), a.sin(), b.cos(), b.sin()]) {
            *sum += weight * part;
        }
    }
    for (got, want) in sums.iter().zip([0.8, 0.0, 0.5, 0.0]) {
        assert!((got - want).abs() < 1e-9, "{sums:?}");
    }
}
