//! Formats numbers for the cells of the validation page's tables.

use crate::lab::estimate::EstimateWithError;

/// Text of a table cell that would hold a measured number, if there is no GPU to measure on.
pub const PENDING_CELL: &str = "…";

/// Formats a number with `digits` digits after the decimal point.
pub fn format_number(value: f64, digits: usize) -> String {
    format!("{:.digits$}", value + 0.0)
}

/// Formats an estimate and its standard error, such as `2.31 ± 0.02`; [`PENDING_CELL`] without an estimate.
pub fn format_estimate(estimate: Option<EstimateWithError>, digits: usize) -> String {
    estimate.map_or(PENDING_CELL.to_owned(), |e| match e.standard_error {
        Some(error) => format!("{:.digits$} ± {error:.digits$}", e.value),
        None => format_number(e.value, digits),
    })
}

/// Formats the difference of an estimate from the expected value, in per cent of the latter and in standard errors,
/// such as `+0.50 % (+1.2 σ)`; [`PENDING_CELL`] without an estimate.
pub fn relative_deviation(estimate: Option<EstimateWithError>, expected: f64) -> String {
    format_deviation(estimate, |value| value - expected, |by| format!("{:+.2} %", 100.0 * by / expected))
}

/// Formats the difference of an estimate from the expected value, in the estimate's unit and in standard errors;
/// [`PENDING_CELL`] without an estimate.
pub fn absolute_deviation(estimate: Option<EstimateWithError>, expected: f64) -> String {
    format_deviation(estimate, |value| value - expected, |by| format!("{by:+.4}"))
}

/// Formats the difference of an estimated angle from the expected one, in degrees and in standard errors;
/// [`PENDING_CELL`] without an estimate.
pub fn angle_deviation(estimate: Option<EstimateWithError>, expected: f64) -> String {
    format_deviation(estimate, |value| (value - expected + 540.0).rem_euclid(360.0) - 180.0, |by| format!("{by:+.2}°"))
}

fn format_deviation(
    estimate: Option<EstimateWithError>,
    by: impl Fn(f64) -> f64,
    text: impl Fn(f64) -> String,
) -> String {
    estimate.map_or(PENDING_CELL.to_owned(), |e| {
        let by = by(e.value);
        let errors =
            e.standard_error.filter(|&se| se > 0.0).map_or(String::new(), |se| format!(" ({:+.1} σ)", by / se));
        text(by) + &errors
    })
}

/// Formats the difference of the program's number `ours` from a published number, in per cent of the latter.
pub fn relative_to_published(ours: f64, published: f64) -> String {
    format!("{:+.1} %", 100.0 * (ours / published - 1.0))
}
