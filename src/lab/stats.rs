//! `seastate stats`: statistics of a sea by theory, of the waves on the FFT grids (resolved), and measured on the GPU.

use super::crests::{self, CrestStatistics};
use super::ensemble::{self, MeasuredStatistics};
use super::estimate::EstimateWithError;
use crate::gpu::Gpu;
use crate::shaders::Shaders;
use crate::sim::Simulation;
use crate::state::{Params, query};
use crate::waves::Plan;
use crate::waves::crest_theory::CrestTheory;
use crate::waves::crests::WaveRecordStatistics;
use crate::waves::second_order::expected_skewness;
use crate::waves::statistics::{LatticeStatistics, SpectrumStatistics};
use serde_json::{Value, json};
use std::fmt;

/// Statistics of one sea by theory, of the resolved waves (those on the FFT grids), and as measured on the GPU.
#[derive(Debug)]
pub struct SeaStatistics {
    params: Params,
    plan: Plan,
    /// Statistics by theory, from integrals of the spectrum.
    pub theory: SpectrumStatistics,
    /// Statistics of the resolved waves, from sums over the FFT grids of the cascades.
    pub resolved: LatticeStatistics,
    /// Statistics measured in the wave maps that were read back from the GPU.
    pub measured: MeasuredStatistics,
    /// Foam coverage measured on the GPU with the first seed, 0 to 1: mean over all cells of all foam levels.
    whitecap_fraction: f64,
    /// Skewness of the surface by second-order theory; `None` for a sea of first order.
    expected_skewness: Option<f64>,
    /// Crests, heights and groups of waves.
    pub crests: CrestStatistics,
}

/// Number of wave numbers in the double sum over all pairs of waves, from which the expected skewness follows.
const WAVE_NUMBERS_OF_DOUBLE_SUM: usize = 40;

/// Computes the statistics of the sea of `params`, and measures them over `seeds` seeds, beginning with its own seed.
/// `record_hours` is the length (h) of the records of each seed in which crests and heights are measured; without it
/// they are not.
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn run(gpu: &Gpu, params: &Params, seeds: u32, record_hours: Option<f64>) -> Result<SeaStatistics, String> {
    let plan = Plan::new(params);
    let theory = SpectrumStatistics::new(&plan);
    let resolved = LatticeStatistics::new(&plan, theory.variance_m2);
    let mut sim = Simulation::new(gpu, plan.clone(), &Shaders::default());
    let whitecap_fraction = ensemble::mean_foam(gpu, &mut sim, params.clock.t_s).await?;
    let measured = ensemble::measure(gpu, &mut sim, params, seeds, &mut |_, _| ()).await?;
    let expected_skewness = (plan.sea.wave_order == 2).then(|| expected_skewness(&plan, WAVE_NUMBERS_OF_DOUBLE_SUM));
    let in_records = record_hours.and_then(|hours| {
        let (records, step_s) = crests::records(params, &theory, seeds, hours);
        WaveRecordStatistics::new(&records, step_s)
    });
    let crests = CrestStatistics { theory: CrestTheory::new(&plan, &theory), measured: in_records };
    let params = params.clone();
    Ok(SeaStatistics { params, plan, theory, resolved, measured, whitecap_fraction, expected_skewness, crests })
}

impl SeaStatistics {
    /// Formats the statistics as JSON, with `notices` (messages about the state string) and the plan's own notices.
    /// Statistics measured over the seeds have a standard error.
    pub fn json(&self, notices: &[String]) -> String {
        let (t, r, m) = (&self.theory, &self.resolved, &self.measured);
        let notices: Vec<&String> =
            notices.iter().chain(&self.plan.notices).chain(&self.plan.resolution_note).collect();
        let cascades: Vec<Value> = (self.plan.cascades.iter())
            .map(|c| json!({"n": self.plan.n, "patch_m": c.patch_m, "k_low": c.k_low, "k_high": c.k_high}))
            .collect();
        let value = json!({
            "state": query::write(&self.params),
            "notices": notices,
            "theory": {
                "m0_m2": t.variance_m2, "hs_m": t.hs_m, "tp_s": t.tp_s, "tm01_s": t.tm01_s, "tm02_s": t.tm02_s,
                "lambda_p_m": t.lambda_p_m, "lambda_mean_m": t.lambda_mean_m, "steepness": t.steepness,
                "mss": t.mss, "k_max": t.k_max, "mean_from_deg": t.mean_from_deg, "spread_deg": t.spread_deg,
                "benjamin_feir": t.benjamin_feir, "skewness": self.expected_skewness,
                "whitecap_fraction": t.whitecap_fraction,
            },
            "resolved": {
                "m0_m2": r.variance_m2, "hs_m": r.hs_m, "tm01_s": r.tm01_s, "tm02_s": r.tm02_s, "mss": r.mss,
                "k_max": t.k_max, "m0_fraction": r.m0_fraction, "r1": r.first_directional_moment,
                "mean_from_deg": r.mean_from_deg, "spread_deg": r.spread_deg,
            },
            "measured": {
                "hs_m": m.hs_m.value, "hs_se_m": m.hs_m.standard_error,
                "mean_m": m.mean_elevation_m.value, "mean_se_m": m.mean_elevation_m.standard_error,
                "mss": m.mss.value, "mss_se": m.mss.standard_error,
                "tm01_s": m.tm01_s.value, "tm01_se_s": m.tm01_s.standard_error,
                "tm02_s": m.tm02_s.value, "tm02_se_s": m.tm02_s.standard_error,
                "from_deg": m.mean_from_deg.map(|e| e.value), "from_se_deg": m.mean_from_deg.map(|e| e.standard_error),
                "r1": m.r1.value, "r1_se": m.r1.standard_error,
                "spread_deg": m.spread_deg.value, "spread_se_deg": m.spread_deg.standard_error,
                "skewness": m.skewness.value, "skewness_se": m.skewness.standard_error,
                "kurtosis": m.kurtosis.value, "kurtosis_se": m.kurtosis.standard_error,
                "whitecap_fraction": self.whitecap_fraction,
                "parseval_error": m.parseval_error, "seeds": m.seed_count,
            },
            "crests": self.crests.json(),
            "cascades": cascades,
        });
        serde_json::to_string_pretty(&value).unwrap_or_default()
    }
}

impl fmt::Display for SeaStatistics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (t, r, m) = (&self.theory, &self.resolved, &self.measured);
        let value = |x: f64, digits: usize| format!("{x:.digits$}");
        let with_error = |e: &EstimateWithError, digits: usize| match e.standard_error {
            Some(error) => format!("{:.digits$} ± {error:.digits$}", e.value),
            None => value(e.value, digits),
        };
        let degrees = |d: Option<f64>| d.map_or("none".to_owned(), |d| value(d, 1));
        let from = m.mean_from_deg.map_or("none".to_owned(), |e| with_error(&e, 1));
        let none = String::new;
        let mss = format!("mss to {:.1} rad/m", t.k_max);
        let rows: &[(&str, String, String, String)] = &[
            ("", "theory".into(), "resolved".into(), "measured".into()),
            ("Hs, m", value(t.hs_m, 4), value(r.hs_m, 4), with_error(&m.hs_m, 4)),
            ("Tp, s", value(t.tp_s, 2), none(), none()),
            ("Tm01, s", value(t.tm01_s, 3), value(r.tm01_s, 3), with_error(&m.tm01_s, 3)),
            ("Tm02, s", value(t.tm02_s, 3), value(r.tm02_s, 3), with_error(&m.tm02_s, 3)),
            ("peak wavelength, m", value(t.lambda_p_m, 1), none(), none()),
            ("mean wavelength, m", value(t.lambda_mean_m, 1), none(), none()),
            ("steepness Hs / lambda_p", value(t.steepness, 4), none(), none()),
            (&mss, value(t.mss, 5), value(r.mss, 5), with_error(&m.mss, 5)),
            ("from, degrees", degrees(t.mean_from_deg), degrees(r.mean_from_deg), from),
            ("directional spread, deg", value(t.spread_deg, 1), value(r.spread_deg, 1), with_error(&m.spread_deg, 1)),
            ("Benjamin-Feir index", value(t.benjamin_feir, 3), none(), none()),
            ("resolved share of m0", none(), value(r.m0_fraction, 4), none()),
            ("mean elevation, m", none(), none(), with_error(&m.mean_elevation_m, 4)),
            ("skewness", self.expected_skewness.map_or_else(none, |s| value(s, 4)), none(), with_error(&m.skewness, 4)),
            ("kurtosis", none(), none(), with_error(&m.kurtosis, 4)),
            ("whitecap fraction", value(t.whitecap_fraction, 4), none(), value(self.whitecap_fraction, 4)),
            ("seeds", none(), none(), m.seed_count.to_string()),
        ];
        for (what, theory, resolved, measured) in rows {
            writeln!(f, "{what:<26} {theory:>12} {resolved:>12} {measured:>22}")?;
        }
        f.write_str(&self.crests.text())?;
        let n = self.plan.n;
        for c in &self.plan.cascades {
            let [patch_m, low, high] = [c.patch_m, c.k_low, c.k_high];
            writeln!(f, "cascade {n} x {n}, patch {patch_m:.1} m, {low:.4} to {high:.4} rad/m")?;
        }
        Ok(())
    }
}
