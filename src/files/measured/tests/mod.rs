//! Tests of measured spectra: files that are read or refused, links, and the physics.

mod directional;
mod files;
mod links;
mod models;
mod physics;
mod refusals;
mod samples;

use super::{MAX_TEXT_BYTES, MaximumEntropyDistribution, MeasuredSpectrum, SpectrumFile};

/// Knuth's linear congruential generator, for repeatable tests.
pub(super) struct Lcg(pub u64);

impl Lcg {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    /// Next random number in [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        self.next() as f64 / (1_u64 << 31) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }
}

fn read<T: AsRef<str>>(files: &[(&str, T)]) -> Result<(MeasuredSpectrum, Vec<String>), String> {
    read_titled(files).map(|file| (file.spectrum, file.notices))
}

fn read_titled<T: AsRef<str>>(files: &[(&str, T)]) -> Result<SpectrumFile, String> {
    let files: Vec<_> = files.iter().map(|(n, t)| ((*n).to_string(), t.as_ref().into())).collect();
    MeasuredSpectrum::read(&files)
}

fn title<T: AsRef<str>>(files: &[(&str, T)]) -> String {
    read_titled(files).unwrap_or_else(|e| panic!("{e}")).title
}

/// Reads a spectrum from files and asserts that there is no notice.
fn sea<T: AsRef<str>>(files: &[(&str, T)]) -> MeasuredSpectrum {
    let (sea, notices) = read(files).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(notices, [""; 0]);
    sea
}

/// Returns the error message about a file that must be refused.
fn message(name: &str, text: &str) -> String {
    read(&[(name, text)]).expect_err(text)
}

const SPEC: &str = "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) ... >\n";
const BANDS: &str = "#YY  MM DD hh mm  .0500  .1000  .2000\n";

/// Text of an NDBC realtime file: a header, and one record of the values `v` at 0.05, 0.1 and 0.2 Hz.
fn realtime(columns: &str, time: &str, v: [&str; 3]) -> String {
    format!("#YY  MM DD hh mm {columns} ... >\n{time} {} (0.050) {} (0.100) {} (0.200)\n", v[0], v[1], v[2])
}

fn realtime_set() -> Vec<(&'static str, String)> {
    let time = "2026 11 21 06 00";
    vec![
        ("44025.data_spec", realtime("Sep_Freq  < spec_1 (freq_1)", &format!("{time} 9.999"), ["0.5", "2", "0.3"])),
        ("44025.swdir", realtime("alpha1_1 (freq_1)", time, ["240.0", "250.0", "99.0"])),
        ("44025.swdir2", realtime("alpha2_1 (freq_1)", time, ["241.0", "251.0", "100.0"])),
        ("44025.swr1", realtime("r1_1 (freq_1)", time, ["0.80", "0.90", "0.70"])),
        ("44025.swr2", realtime("r2_1 (freq_1)", time, ["0.40", "0.60", "0.30"])),
    ]
}

/// Checks the properties that every spectrum has.
fn check(sea: &MeasuredSpectrum) {
    let state = sea.to_state();
    assert!(state.bytes().all(|b| b.is_ascii_alphanumeric() || b"*-._".contains(&b)), "{state}");
    assert!(state.len() < MAX_TEXT_BYTES);
    let again = MeasuredSpectrum::from_state(&state).unwrap_or_else(|e| panic!("{e}: {state}"));
    assert_eq!(&again, sea, "{state}");
    assert_eq!(again.to_state(), state);
    let knots = sea.density_kinks_rad_s();
    assert!(0.0 < sea.lowest_omega() && sea.lowest_omega() < sea.omega_p() && sea.omega_p() <= knots[knots.len() - 1]);
    assert!(sea.variance_m2() > 0.0 && sea.hs_m().is_finite());
    assert!(knots.windows(2).all(|w| w[0] < w[1]));
    for omega in knots.iter().flat_map(|w| [0.9 * w, *w, 1.1 * w]).chain([0.0, -1.0, 1e9]) {
        assert!(sea.density(omega) >= 0.0 && sea.density(omega).is_finite());
        if let Some(moments) = sea.directional_moments(omega) {
            let d = MaximumEntropyDistribution::new(moments).density(1.0);
            assert!(d > 0.0 && d.is_finite());
        }
    }
}
