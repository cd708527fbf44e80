//! `seastate validate --all`: measures every spectrum with every directional spreading in thirteen sea states.

use super::cells::{angle_deviation, format_estimate, format_number, relative_deviation};
use super::choice_words;
use super::measurement::Measurement;
use crate::gpu::Gpu;
use crate::lab::estimate::EstimateWithError;
use crate::lab::page::Page;

/// The thirteen sea states: wind (m/s), fetch (km), depth (m), from calm to hurricane and from deep water to 3 m.
pub const STATES: [(f64, f64, f64); 13] = [
    (1.5, 2.0, 4000.0),
    (3.0, 10.0, 4000.0),
    (5.0, 20.0, 100.0),
    (7.0, 50.0, 30.0),
    (10.0, 100.0, 4000.0),
    (10.0, 100.0, 20.0),
    (10.0, 100.0, 5.0),
    (10.0, 300.0, 3.0),
    (15.0, 300.0, 4000.0),
    (20.0, 500.0, 50.0),
    (25.0, 50.0, 10.0),
    (32.0, 1000.0, 4000.0),
    (45.0, 800.0, 200.0),
];

/// Comparisons of measured statistics with those of the resolved waves, collected over all sea states.
#[derive(Default)]
struct Comparisons {
    /// Difference between each measured and resolved statistic, in standard errors.
    errors: Vec<f64>,
    /// A line of text for each difference beyond 4 standard errors.
    outliers: Vec<String>,
}

impl Comparisons {
    fn compare(&mut self, state: &str, estimate: Option<EstimateWithError>, expected: f64) {
        if let Some(EstimateWithError { value, standard_error: Some(error) }) = estimate {
            self.errors.push((value - expected) / error);
            if (value - expected).abs() > 4.0 * error {
                self.outliers.push(format!("`{state}`: {value:.5} ± {error:.5} against {expected:.5}"));
            }
        }
    }

    fn count_beyond(&self, limit: f64) -> usize {
        self.errors.iter().filter(|e| e.abs() > limit).count()
    }
}

/// Builds the page, with a table row for each combination whose state string contains `only`.
///
/// # Errors
/// If no state string contains `only`, or reading back from the GPU fails.
pub fn build(gpu: &Gpu, seeds: u32, only: &str) -> Result<Page, String> {
    let lab = Measurement { gpu: Some(gpu), seeds };
    let (mut rows, mut comparisons) = (Vec::new(), Comparisons::default());
    for spectrum in choice_words("spectrum") {
        for spread in choice_words("spread") {
            for (wind, fetch, depth) in STATES {
                let state =
                    format!("spectrum={spectrum}&spread={spread}&wind={wind}&fetch={fetch}&depth={depth}&n=128");
                if state.contains(only) {
                    rows.push(row(&lab, &state, &mut comparisons)?);
                }
            }
        }
    }
    if rows.is_empty() {
        return Err(format!("no state contains '{only}'"));
    }
    let mut page = Page::default();
    page.heading(1, "Validation: every spectrum with every spreading");
    let count = comparisons.errors.len();
    page.paragraph(&format!(
        "`seastate validate --all`: {} seas over {seeds} seeds each. Of {count} comparisons of measured with resolved \
         numbers, {} lie beyond 2 standard errors, {} beyond 3 and {} beyond 4; their root mean square is {:.2} \
         standard errors. With few seeds the standard errors are themselves uncertain, and these shares are larger \
         than a Gaussian's.",
        rows.len(),
        comparisons.count_beyond(2.0),
        comparisons.count_beyond(3.0),
        comparisons.count_beyond(4.0),
        (comparisons.errors.iter().map(|e| e * e).sum::<f64>() / count as f64).sqrt(),
    ));
    for line in &comparisons.outliers {
        page.paragraph(&format!("Beyond 4: {line}"));
    }
    page.table(
        "sea | Hs, theory | resolved | measured | deviation | Tm02, resolved | measured | deviation | mss, resolved | \
         measured | deviation | spread, resolved | measured | deviation | from 240°, measured | deviation",
        &rows,
    );
    Ok(page)
}

fn row(lab: &Measurement<'_>, state: &str, comparisons: &mut Comparisons) -> Result<Vec<String>, String> {
    let sea = lab.measure_sea(state)?;
    let r = &sea.resolved;
    let mut cells = vec![format!("`{state}`"), format_number(sea.theory.hs_m, 3)];
    for (estimate, expected, digits) in [
        (sea.measured_statistic(|m| m.hs_m), r.hs_m, 3),
        (sea.measured_statistic(|m| m.tm02_s), r.tm02_s, 3),
        (sea.measured_statistic(|m| m.mss), r.mss, 5),
        (sea.measured_statistic(|m| m.spread_deg), r.spread_deg, 2),
    ] {
        cells.extend([
            format_number(expected, digits),
            format_estimate(estimate, digits),
            relative_deviation(estimate, expected),
        ]);
        comparisons.compare(state, estimate, expected);
    }
    cells.extend(match r.mean_from_deg {
        Some(from_deg) => [format_estimate(sea.direction_deg(), 2), angle_deviation(sea.direction_deg(), from_deg)],
        None => ["none".to_owned(), "none".to_owned()],
    });
    Ok(cells)
}
