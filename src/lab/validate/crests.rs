//! Part 7 of the validation page: crests and heights of single waves.

use super::cells::{format_estimate, format_number};
use super::measurement::{MeasurementSetup, parse_params};
use crate::lab::crests::{PROBABILITIES, records};
use crate::lab::estimate::EstimateWithError;
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData};
use crate::lab::page::MarkdownPage;
use crate::waves::Plan;
use crate::waves::crest_theory::{CrestTheory, Weibull};
use crate::waves::crests::{Exceedance, WaveRecordStatistics, in_units_of_hs, zero_up_crossing_waves};
use crate::waves::statistics::SpectrumStatistics;

const SEA_STATE_STRING: &str = "hs=4&tp=8&n=128";
/// Length of the record of each seed, h.
const HOURS: f64 = 3.0;
/// Points in a decade of probability in the figures.
const POINTS_PER_DECADE: i32 = 8;
const LOWEST_PROBABILITY: f64 = 1e-4;

/// Records of a sea: crests and heights of each seed and of all, in units of the significant wave height of each
/// record.
struct RecordedWaves {
    /// Crest and height of each wave, for each seed.
    by_seed: Vec<Vec<[f64; 2]>>,
    all: WaveRecordStatistics,
}

impl RecordedWaves {
    /// Records the sea of a state string over the seeds of `lab`; `None` without a GPU, as all measured numbers.
    fn new(lab: &MeasurementSetup<'_>, state: &str) -> Result<Option<Self>, String> {
        if lab.gpu.is_none() {
            return Ok(None);
        }
        let params = parse_params(state)?;
        let theory = SpectrumStatistics::new(&Plan::new(&params));
        let (records, step_s) = records(&params, &theory, lab.seed_count, HOURS);
        let records = in_units_of_hs(&records);
        let Some(all) = WaveRecordStatistics::new(&records, step_s) else { return Ok(None) };
        let by_seed = (records.iter())
            .map(|r| zero_up_crossing_waves(r, step_s).iter().map(|w| [w.crest_m, w.height_m()]).collect())
            .collect();
        Ok(Some(Self { by_seed, all }))
    }

    /// Crest (`which` 0) or height (1) that is exceeded with the probability `p`, over Hs, with its jackknife error.
    fn exceeded(&self, which: usize, p: f64) -> EstimateWithError {
        EstimateWithError::jackknife(self.by_seed.len(), |left_out| {
            let kept = self.by_seed.iter().enumerate().filter(|(i, _)| Some(*i) != left_out);
            let values = Exceedance::new(kept.flat_map(|(_, waves)| waves.iter().map(|w| w[which])));
            values.value_m(p).unwrap_or(f64::NAN)
        })
    }
}

/// Points of the figures: value over Hs and probability of exceedance, at equal steps of the probability's logarithm.
fn points(values: &Exceedance) -> SeriesData {
    let probabilities = (1..=4 * POINTS_PER_DECADE).map(|i| 10f64.powf(-f64::from(i) / f64::from(POINTS_PER_DECADE)));
    SeriesData::Points(probabilities.filter_map(|p| Some([values.value_m(p)?, p, 0.0])).collect())
}

/// Curve of a distribution over the value divided by `hs_m`, down to [`LOWEST_PROBABILITY`].
fn curve(law: Weibull, hs_m: f64) -> Vec<[f64; 2]> {
    let probability = |i: i32| LOWEST_PROBABILITY.powf(f64::from(i) / 100.0);
    (0..=100).map(probability).map(|p| [law.value_m(p) / hs_m, p]).collect()
}

/// Adds part 7 to the validation page: crests and heights of single waves.
///
/// # Errors
/// If the state string is wrong, or a figure cannot be drawn.
pub fn add_part(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) -> Result<(), String> {
    page.heading(2, "7. Crests and heights");
    page.paragraph(
        "Waves between up-crossings of the mean level at a fixed point, Hs 4 m, Tp 8 s, three hours for each seed, in \
         units of each record's Hs. \
         `point::WaveStaff` computes the heights on the CPU in double precision from the same waves as the GPU, without \
         short ones with an rms height of 2 % of Hs. Forristall's (2000) distributions are fits to second-order \
         simulations of long-crested (2D) and spread seas (3D); Boccotti's and Naess' heights take the bandwidth of the \
         spectrum into account. Both orders have chop 1.",
    );
    let plan = Plan::new(&parse_params(SEA_STATE_STRING)?);
    let theory = CrestTheory::new(&plan, &SpectrumStatistics::new(&plan));
    let recorded = [1, 2].map(|order| RecordedWaves::new(lab, &format!("{SEA_STATE_STRING}&order={order}")));
    let [first, second] = recorded;
    let recorded = [first?, second?];
    let axes = |label: &str, end: f64| {
        (Axis::linear(label, 0.0, end), Axis::log("probability of exceedance", LOWEST_PROBABILITY, 1.0))
    };
    let (x, y) = axes("crest over significant wave height", 1.4);
    let mut crests = Figure::new("Crests", x, y, LegendCorner::UpperRight);
    let (x, y) = axes("wave height over significant wave height", 2.4);
    let mut heights = Figure::new("Heights", x, y, LegendCorner::UpperRight);
    for (order, colour, waves) in [("order 1", 6, &recorded[0]), ("order 2", 5, &recorded[1])] {
        if let Some(waves) = waves {
            crests = crests.with_series(FigureSeries::new(order, colour, points(&waves.all.crests)));
            heights = heights.with_series(FigureSeries::new(order, colour, points(&waves.all.heights)));
        }
    }
    let line = |law: Weibull| SeriesData::Line(curve(law, theory.hs_m));
    let dashes = |law: Weibull| SeriesData::Dashes(curve(law, theory.hs_m));
    crests = crests
        .with_series(FigureSeries::new("Rayleigh", 0, dashes(theory.rayleigh_crests)))
        .with_series(FigureSeries::new("Forristall 2D", 2, dashes(theory.forristall_2d_crests)))
        .with_series(FigureSeries::new("Forristall 3D", 1, line(theory.forristall_3d_crests)));
    heights = heights
        .with_series(FigureSeries::new("Rayleigh", 0, dashes(theory.rayleigh_heights)))
        .with_series(FigureSeries::new("Naess", 2, dashes(theory.naess_heights)))
        .with_series(FigureSeries::new("Boccotti", 1, line(theory.boccotti_heights)));
    page.figures(
        &[("crests".to_owned(), crests), ("heights".to_owned(), heights)],
        "Probability that the crest or the height of a wave exceeds a value: records of all seeds (circles), theory \
         (lines).",
    )?;
    let mut rows = Vec::new();
    for (which, name, laws) in [
        (0, "crest", [theory.rayleigh_crests, theory.forristall_3d_crests]),
        (1, "height", [theory.rayleigh_heights, theory.boccotti_heights]),
    ] {
        for p in PROBABILITIES {
            let [rayleigh, finer] = laws.map(|law| format_number(law.value_m(p) / theory.hs_m, 3));
            let measured = [0, 1].map(|order| recorded[order].as_ref().map(|waves| waves.exceeded(which, p)));
            let [order_1, order_2] = measured.map(|estimate| format_estimate(estimate, 3));
            let waves = format!("{:.0}", 1.0 / p);
            rows.push(vec![name.to_owned(), waves, rayleigh, finer, order_1, order_2]);
        }
    }
    page.table("over Hs | one wave in | Rayleigh | Forristall 3D, Boccotti | order 1 | order 2", &rows);
    Ok(())
}
