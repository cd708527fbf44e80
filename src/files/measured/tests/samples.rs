//! The sample files in `assets/spectra`, compared with the same files made from known spectra.

use super::super::{DirectionalParameters, MeasuredSpectrum};
use super::{sea, title};
use std::f64::consts::TAU;
use std::fmt::Write as _;

const G: f64 = 9.81;

pub(super) const JONSWAP: &str = include_str!("../../../../assets/spectra/jonswap-10ms-100km.csv");
pub(super) const TWO_SYSTEMS: &str = include_str!("../../../../assets/spectra/two-systems.txt");
pub(super) const PIERSON_MOSKOWITZ: &str = include_str!("../../../../assets/spectra/pierson-moskowitz.data_spec");

/// Usual frequency bands of an NDBC buoy, 1e-4 Hz.
fn ndbc_bands() -> impl Iterator<Item = u32> {
    let steps = (325..=925).step_by(50).chain((1000..=3500).step_by(100)).chain((3650..=4850).step_by(200));
    std::iter::once(200).chain(steps)
}

/// Shape of the JONSWAP spectrum with its peak at `fp`; it tends to f^-5 far above the peak.
fn shape(f: f64, fp: f64, gamma: f64) -> f64 {
    let sigma = if f <= fp { 0.07 } else { 0.09 };
    let bump = (-(f / fp - 1.0).powi(2) / (2.0 * sigma * sigma)).exp();
    f.powi(-5) * (-1.25 * (fp / f).powi(4)).exp() * gamma.powf(bump)
}

/// JONSWAP spectrum with a given significant wave height.
fn of_height(f: f64, fp: f64, gamma: f64, hs: f64) -> f64 {
    let steps = 100_000;
    let df = 10.0 * fp / f64::from(steps);
    let m0: f64 = (1..=steps).map(|i| shape((f64::from(i) - 0.5) * df, fp, gamma) * df).sum();
    hs * hs / 16.0 / m0 * shape(f, fp, gamma)
}

/// Table of the JONSWAP spectrum for 10 m/s over 100 km (Hasselmann et al. 1973), with the directional spreading of
/// Mitsuyasu et al. (1975).
fn jonswap() -> String {
    let (u, fetch) = (10.0_f64, 1e5_f64);
    let alpha = 0.076 * (u * u / (fetch * G)).powf(0.22);
    let omega_p = 22.0 * (G * G / (u * fetch)).cbrt();
    let sp = 11.5 * (omega_p * u / G).powf(-2.5);
    let mut out = String::from(
        "# Synthetic, not measured: JONSWAP for a wind of 10 m/s over 100 km, gamma 3.3, from 240 degrees,\n\
         # spread as cos^2s after Mitsuyasu. Hs 2.139 m, Tp 6.23 s.\n\
         f_Hz,S_m2_Hz,direction_deg,spread_deg\n",
    );
    // Steps of 0.005 Hz around the peak, 0.015 Hz above.
    for f in (30..240).step_by(5).chain((240..=585).step_by(15)).map(|i| f64::from(i) / 1000.0) {
        let s = alpha * G * G / TAU.powi(4) * shape(f, omega_p / TAU, 3.3);
        let r = TAU * f / omega_p;
        let exponent = sp * r.powf(if r <= 1.0 { 5.0 } else { -2.5 });
        // Circular spread sqrt(2 (1 - r1)) with r1 = s / (s + 1).
        let spread = (2.0 / (exponent + 1.0)).sqrt().to_degrees();
        let _ = writeln!(out, "{f:.3},{s:.5},240,{spread:.1}");
    }
    out
}

/// A narrow swell and a broad wind sea: their variance density, and the directional parameters of their sum.
fn mix(f: f64) -> (f64, DirectionalParameters) {
    // Hs, Tp, from, s of cos^2s.
    let (mut sum, mut total) = ([0.0; 4], 0.0);
    for (hs, tp, from, s) in [(2.0, 13.0, 290_f64, 30.0), (1.2, 5.0, 200.0, 4.0)] {
        let density = of_height(f, 1.0 / tp, 3.3, hs);
        let (r1, r2) = (s / (s + 1.0), s * (s - 1.0) / ((s + 1.0) * (s + 2.0)));
        let a = from.to_radians();
        let parts = [r1 * a.cos(), r1 * a.sin(), r2 * (2.0 * a).cos(), r2 * (2.0 * a).sin()];
        sum = std::array::from_fn(|i| sum[i] + density * parts[i]);
        total += density;
    }
    let [a, b, c, d] = sum.map(|v| v / total);
    let degrees = |v: f64| v.to_degrees().rem_euclid(360.0);
    let (alpha1_deg, alpha2_deg) = (degrees(b.atan2(a)), degrees(0.5 * d.atan2(c)));
    (total, DirectionalParameters { alpha1_deg, alpha2_deg, r1: a.hypot(b), r2: c.hypot(d) })
}

/// Archive file with five sections of one record each: moments in hundredths, no direction where the density is 0.
fn two_systems() -> String {
    let bands: Vec<_> = ndbc_bands().map(|i| mix(f64::from(i) / 1e4)).collect();
    let mut out = String::from(
        "# Synthetic, not measured: a swell of Hs 2 m, Tp 13 s from 290 degrees (cos^2s, s = 30) and a wind sea of\n\
         # Hs 1.2 m, Tp 5 s from 200 degrees (s = 4), both JONSWAP with gamma 3.3. Together Hs 2.332 m, Tp 13 s.\n",
    );
    for kind in ["density", "alpha1", "alpha2", "r1", "r2"] {
        let _ = write!(out, "# kind: {kind}\n#YY  MM DD hh mm");
        for i in ndbc_bands() {
            let _ = write!(out, "  .{i:04}");
        }
        out.push_str("\n2026 11 21 06 00");
        for (s, d) in &bands {
            let value = match kind {
                "density" => format!("{s:.3}"),
                _ if *s < 5e-4 => "999.0".into(),
                "alpha1" => format!("{:.1}", d.alpha1_deg),
                "alpha2" => format!("{:.1}", d.alpha2_deg),
                "r1" => format!("{:.1}", 100.0 * d.r1),
                _ => format!("{:.1}", 100.0 * d.r2),
            };
            let _ = write!(out, " {value:>6}");
        }
        out.push('\n');
    }
    out
}

/// Realtime file of the Pierson-Moskowitz spectrum (1964, wind at 19.5 m) for 12 m/s at 10 m.
fn pierson_moskowitz() -> String {
    let fp = (0.8 * 0.74_f64).powf(0.25) * G / (1.026 * 12.0) / TAU;
    let mut out = String::from(
        "# Synthetic, not measured: Pierson-Moskowitz for a wind of 12 m/s, no directions. Hs 3.233 m, Tp 8.99 s.\n\
         #YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) spec_3 (freq_3) ... >\n\
         2026 11 21 06 00 9.999",
    );
    for i in ndbc_bands() {
        let f = f64::from((i + 5) / 10) / 1000.0;
        let s = 8.1e-3 * G * G / TAU.powi(4) * shape(f, fp, 1.0);
        let _ = write!(out, " {s:.3} ({f:.3})");
    }
    out.push('\n');
    out
}

#[test]
fn the_shipped_samples_are_what_they_say() {
    for (name, shipped, made) in [
        ("jonswap-10ms-100km.csv", JONSWAP, jonswap()),
        ("two-systems.txt", TWO_SYSTEMS, two_systems()),
        ("pierson-moskowitz.data_spec", PIERSON_MOSKOWITZ, pierson_moskowitz()),
    ] {
        if !shipped.lines().eq(made.lines()) {
            let path = std::env::temp_dir().join(name);
            let _ = std::fs::write(&path, made);
            panic!("{name} differs from what makes it; the new text is in {}", path.display());
        }
    }
}

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
    // The tail of the swell turns the direction of the wind sea a little.
    assert!((at(0.0775).alpha1_deg - 290.0).abs() < 0.5 && (at(0.0775).r1 - 30.0 / 31.0).abs() < 0.003);
    assert!((at(0.25).alpha1_deg - 200.0).abs() < 10.0 && (at(0.25).r1 - 0.8).abs() < 0.1);
    for (&(f, s), got) in sea.bands().iter().zip(directions).filter(|(band, _)| band.1 > 0.0) {
        let (density, d) = mix(f);
        assert!((s - density).abs() < 1e-3 * density.max(1.0), "{f} Hz: {s}");
        assert!((got.alpha1_deg - d.alpha1_deg).abs() < 0.1 && (got.alpha2_deg - d.alpha2_deg).abs() < 0.1, "{f} Hz");
        assert!((got.r1 - d.r1).abs() < 1e-3 && (got.r2 - d.r2).abs() < 1e-3, "{f} Hz: {got:?}");
    }
    assert_eq!(directions[0], directions[1], "nothing is known of the lowest band");
}

#[test]
fn the_sample_of_a_model_is_what_it_says() {
    let text = include_str!("../../../../assets/spectra/turning-wind.sp2");
    let all = super::models::list("turning-wind.sp2", text);
    for (record, (hs_m, from_deg)) in all.records.iter().zip([(1.0, 210.0), (1.8, 230.0), (2.5, 250.0)]) {
        let sea = &record.spectrum;
        let want = f64::hypot(hs_m, 1.5);
        assert!((sea.hs_m() / want - 1.0).abs() < 0.02, "{}: Hs {}, not {want}", record.label, sea.hs_m());
        // At high frequencies the direction is that of the wind sea, which the tail of the swell turns a little.
        let [x, z] = sea.tabulated_distribution(TAU * 0.35).expect("directions").first_moment();
        let found = (-x).atan2(z).to_degrees().rem_euclid(360.0);
        assert!((found - from_deg).abs() < 5.0, "{}: {found}", record.label);
    }
}
