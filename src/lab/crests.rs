//! Crests, heights and groups of waves in long records of the sea at one point, computed on the CPU.

use super::write_file;
use crate::point::WaveStaff;
use crate::state::Params;
use crate::waves::crest_theory::{CrestTheory, EXCEEDANCE_COLUMNS, exceedance_table};
use crate::waves::crests::WaveRecordStatistics;
use crate::waves::statistics::SpectrumStatistics;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// Probabilities of exceedance for which `seastate stats` prints crests and heights.
pub const PROBABILITIES: [f64; 2] = [1e-2, 1e-3];

/// Records of `hours` h at the origin, one for each of `seeds` seeds from that of `params` on: heights in m and the time
/// between two samples, s.
pub fn records(params: &Params, theory: &SpectrumStatistics, seeds: u32, hours: f64) -> (Vec<Vec<f64>>, f64) {
    let staff = WaveStaff::new(theory, hours);
    ((0..seeds).map(|seed| staff.record(params, seed)).collect(), staff.step_s)
}

/// Crests and heights of a sea: what theory expects and, if records were computed, what they show.
#[derive(Debug)]
pub struct CrestStatistics {
    /// Expected distributions and groups.
    pub theory: CrestTheory,
    /// Statistics of the records of all seeds.
    pub measured: Option<WaveRecordStatistics>,
}

impl CrestStatistics {
    /// Writes the table of exceedance as CSV to a file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write_csv(&self, path: &Path, state: &str) -> Result<(), String> {
        write_file(path, self.csv(state))
    }

    /// Table of exceedance as CSV, with the state string in a comment line. Without a record it has no rows.
    fn csv(&self, state: &str) -> String {
        let mut text = format!("# Seastate {state}\n{EXCEEDANCE_COLUMNS}\n");
        for [p, values @ ..] in self.measured.iter().flat_map(|record| exceedance_table(record, &self.theory)) {
            let cells: Vec<String> = values.iter().map(|x| format!("{x:.4}")).collect();
            let _ = writeln!(text, "{p:.7},{}", cells.join(","));
        }
        text
    }

    /// The statistics as JSON.
    pub fn json(&self) -> Value {
        let (t, measured) = (&self.theory, self.measured.as_ref());
        let expected: Vec<Value> = PROBABILITIES
            .iter()
            .map(|&p| {
                let [rayleigh, long_crested, spread, rayleigh_height, boccotti, naess] = t.laws().map(|l| l.value_m(p));
                json!({
                    "probability": p, "rayleigh_crest_m": rayleigh, "forristall_2d_crest_m": long_crested,
                    "forristall_3d_crest_m": spread, "rayleigh_height_m": rayleigh_height,
                    "boccotti_height_m": boccotti, "naess_height_m": naess,
                    "measured_crest_m": measured.and_then(|m| m.crests.value_m(p)),
                    "measured_trough_m": measured.and_then(|m| m.troughs.value_m(p)),
                    "measured_height_m": measured.and_then(|m| m.heights.value_m(p)),
                })
            })
            .collect();
        let record = measured.map(|m| {
            json!({
                "waves": m.crests.count(), "hs_m": m.hs_m, "mean_period_s": m.mean_period_s,
                "skewness": m.moments.skewness.value, "skewness_se": m.moments.skewness.standard_error,
                "kurtosis": m.moments.kurtosis.value, "kurtosis_se": m.moments.kurtosis.standard_error,
                "run_length": m.groups.mean_run_length, "repeat_length": m.groups.mean_repeat_length,
                "runs": m.groups.run_count,
            })
        });
        json!({
            "steepness": t.steepness, "ursell": t.ursell, "narrowness": t.narrowness, "exceeded": expected,
            "groups": {
                "envelope_correlation": t.groups.envelope_correlation, "run_length": t.groups.mean_run_length,
                "repeat_length": t.groups.mean_repeat_length,
            },
            "record": record,
        })
    }

    /// The statistics as lines of text.
    pub fn text(&self) -> String {
        let (t, measured) = (&self.theory, self.measured.as_ref());
        let mut text = String::new();
        let with_record = |x: Option<f64>| x.map_or_else(String::new, |x| format!(", record {x:.2} m"));
        for p in PROBABILITIES {
            let [rayleigh, long_crested, spread, rayleigh_height, boccotti, naess] = t.laws().map(|l| l.value_m(p));
            let waves = (1.0 / p).round();
            let _ = writeln!(
                text,
                "crest of one wave in {waves}: Rayleigh {rayleigh:.2} m, Forristall {spread:.2} m (long-crested \
                 {long_crested:.2} m){}",
                with_record(measured.and_then(|m| m.crests.value_m(p)))
            );
            let _ = writeln!(
                text,
                "height of one wave in {waves}: Rayleigh {rayleigh_height:.2} m, Boccotti {boccotti:.2} m, Naess \
                 {naess:.2} m{}",
                with_record(measured.and_then(|m| m.heights.value_m(p)))
            );
        }
        let of_record = measured.map_or_else(String::new, |m| {
            format!(", record {:.2} and {:.1}", m.groups.mean_run_length, m.groups.mean_repeat_length)
        });
        let _ = writeln!(
            text,
            "waves above Hs: Kimura {:.2} in a group, a group every {:.1} waves{of_record}",
            t.groups.mean_run_length, t.groups.mean_repeat_length
        );
        if let Some(m) = measured {
            let _ = writeln!(
                text,
                "record of {} waves: Hs {:.3} m, skewness {:.3} ± {:.3}, kurtosis {:.3} ± {:.3}",
                m.crests.count(),
                m.hs_m,
                m.moments.skewness.value,
                m.moments.skewness.standard_error,
                m.moments.kurtosis.value,
                m.moments.kurtosis.standard_error
            );
        }
        text
    }
}
