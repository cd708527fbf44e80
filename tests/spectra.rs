//! Files with spectra over frequency and direction that other programs wrote: tests/wavespectra/make_samples.py makes
//! the samples in tests/spectra, and says what is in them.

use seastate::files::measured::{MeasuredSpectrum, SpectrumList};
use std::f64::consts::TAU;
use std::path::PathBuf;

/// All samples. The last one only numbers its frequencies and directions.
const SAMPLES: [&str; 8] = [
    "swan.sp2",
    "ww3-cdf1.nc",
    "ww3-cdf2.nc",
    "ww3-cdf5.nc",
    "ww3-netcdf4.nc",
    "wavespectra.nc",
    "era5-values.nc",
    "era5-numbered.nc",
];

fn sample(name: &str) -> Vec<u8> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/spectra").join(name);
    std::fs::read(path).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn list(name: &str, bytes: Vec<u8>) -> Result<SpectrumList, String> {
    MeasuredSpectrum::read_list(&[(name.to_owned(), bytes)])
}

/// Bearing that the waves of a frequency come from, degrees, and the first moment of their directions.
fn bearing_and_r1(sea: &MeasuredSpectrum, f_hz: f64) -> (f64, f64) {
    let [x, z] = sea.tabulated_distribution(TAU * f_hz).expect("directions").first_moment();
    ((-x).atan2(z).to_degrees().rem_euclid(360.0), x.hypot(z))
}

#[test]
fn every_sample_holds_the_same_sea_twice() {
    for name in SAMPLES {
        let all = list(name, sample(name)).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!((all.records.len(), all.default_index, all.notices.len()), (2, 1, 0), "{name}");
        let says = if name == "swan.sp2" {
            ["20240229.000000", "20240229.030000"]
        } else {
            ["2024-02-29 00:00", "2024-02-29 03:00"]
        };
        for (i, record) in all.records.iter().enumerate() {
            assert!(record.label.starts_with(says[i]), "{name}: {}", record.label);
            let sea = &record.spectrum;
            let numbered = name == "era5-numbered.nc";
            let peak_hz = if numbered { 0.034_53 * 1.1 * 1.1 } else { 0.1 };
            let want = [12.0, 48.0][i];
            // Logarithms in 16 bits are steps of 0.04 %, and SWAN's file has four digits.
            let density = sea.bands()[2].1;
            assert!((density / want - 1.0).abs() < 2e-3, "{name}: {density}");
            assert!((sea.bands()[2].0 - peak_hz).abs() < 1e-4, "{name}");
            let (bearing, r1) = bearing_and_r1(sea, peak_hz);
            let want = if numbered { 67.5 } else { 240.0 };
            assert!((bearing - want).abs() < 0.2, "{name}: {bearing}");
            // cos^2s with s = 24: r1 = s / (s + 1), less what straight lines between 15 degrees smear.
            assert!((r1 - 24.0 / 25.0 * 0.9943).abs() < 2e-3, "{name}: {r1}");
        }
        let heights = [0, 1].map(|i| all.records[i].spectrum.hs_m());
        assert!((heights[1] / heights[0] - 2.0).abs() < 1e-3, "{name}: {heights:?}");
    }
}

#[test]
fn a_spotters_spectra_are_read() {
    let text = r#"{"data": {"spotterId": "SPOT-1", "waves": [], "frequencyData": [
        {"frequency": [0.05, 0.1, 0.2], "df": [0.01, 0.01, 0.01], "varianceDensity": [0.5, 2, 0.25],
         "a1": [0.5, 0.8, 0.0], "b1": [0, 0, 0.6], "a2": [0.3, 0.5, -0.4], "b2": [0, 0, 0],
         "timestamp": "2024-01-01T00:00:00.000Z"},
        {"frequency": [0.05, 0.1, 0.2], "varianceDensity": [5, 20, 2.5], "direction": [270, 250, null],
         "directionalSpread": [20, 30, null], "timestamp": "2024-01-01T01:00:00.000Z"},
        {"frequency": [0.05, 0.1, 0.2], "varianceDensity": [0, 0, 0]}]}}"#;
    let all = list("a.json", text.into()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((all.records.len(), all.default_index), (2, 1));
    assert_eq!(all.notices, ["a.json: 1 spectra without data or waves are left out"]);
    assert_eq!(all.title(0), "a.json, 2024-01-01T00:00:00.000Z");
    let directions = all.records[0].spectrum.directions().expect("directions");
    // Travel to the east is from the west; travel to the north is from the south.
    let parameters: Vec<_> = directions.iter().map(|d| [d.alpha1_deg, d.alpha2_deg % 180.0, d.r1, d.r2]).collect();
    assert_eq!(parameters, [[270.0, 90.0, 0.5, 0.3], [270.0, 90.0, 0.8, 0.5], [180.0, 0.0, 0.6, 0.4]]);
    let directions = all.records[1].spectrum.directions().expect("directions");
    assert_eq!(directions.iter().map(|d| d.alpha1_deg).collect::<Vec<_>>(), [270.0, 250.0, 250.0]);
    for (wrong, says) in [
        ("{", "it is not right JSON"),
        ("{}", "no object in it has the arrays"),
        (r#"{"frequency": [0.1, 0.2], "varianceDensity": [1, 1]}"#, "2 frequency bands"),
        (
            r#"{"frequency": [0.1, 0.2, 0.3], "varianceDensity": [1, 1]}"#,
            "2 numbers in varianceDensity for 3 frequencies",
        ),
        (
            r#"{"frequency": [0.1, 0.2, 0.3], "varianceDensity": [1, 1, null]}"#,
            "a number is missing in varianceDensity",
        ),
        (
            r#"{"frequency": [0.1, 0.2, 0.3], "varianceDensity": [1, 1, "1"]}"#,
            "an entry of varianceDensity is not a number",
        ),
        (r#"{"frequency": [0.1, 0.2, 0.3], "varianceDensity": [1, 1, -1]}"#, "must be at least 0"),
    ] {
        let reason = list("a.json", wrong.into()).expect_err(wrong);
        assert!(reason.starts_with("a.json: ") && reason.contains(says) && reason.lines().count() == 1, "{reason}");
    }
    let deep = "[".repeat(100_000);
    assert!(list("a.json", deep.into()).expect_err("deep").contains("not right JSON"));
}

/// Files that end early or have a wrong byte are refused in one sentence, or read as other numbers.
#[test]
fn broken_netcdf_files_are_refused() {
    for name in SAMPLES.into_iter().filter(|name| name.ends_with(".nc")) {
        let whole = sample(name);
        let is_classic = whole.starts_with(b"CDF");
        for end in (0..whole.len()).step_by(if is_classic { 1 } else { 97 }) {
            if let Err(reason) = list("a.nc", whole[..end].to_vec()) {
                assert!(reason.starts_with("a.nc") && reason.len() > 20 && reason.lines().count() == 1, "{reason}");
            }
        }
        let ends = whole.len().min(if is_classic { 4000 } else { 40_000 });
        for i in (0..ends).step_by(if is_classic { 1 } else { 41 }) {
            for flip in [0x01, 0x80, 0xff] {
                let mut bytes = whole.clone();
                bytes[i] ^= flip;
                if let Err(reason) = list("a.nc", bytes) {
                    assert!(reason.starts_with("a.nc") && reason.lines().count() == 1, "{reason}");
                }
            }
        }
    }
}

/// A classic header that claims enormous sizes asks for no memory.
#[test]
fn a_file_that_claims_to_be_enormous_is_refused() {
    let whole = sample("ww3-cdf2.nc");
    let name = b"frequency\0\0\0";
    let at = whole.windows(name.len()).position(|w| w == name).expect("the dimension") + name.len();
    for size in [7_u32, 1000, 1 << 20, u32::MAX] {
        let mut bytes = whole.clone();
        bytes[at..at + 4].copy_from_slice(&size.to_be_bytes());
        let reason = list("a.nc", bytes).expect_err("refused");
        assert!(reason.starts_with("a.nc: "), "{reason}");
    }
    for records in [3_u32, 1 << 20, u32::MAX] {
        let mut bytes = whole.clone();
        bytes[4..8].copy_from_slice(&records.to_be_bytes());
        list("a.nc", bytes).expect_err("refused");
    }
}
