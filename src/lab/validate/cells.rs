//! Numbers as they stand in the cells of the validation page's tables.

use crate::lab::estimate::Estimate;

/// Stands in place of a measured number where there is no GPU.
pub const PENDING: &str = "…";

/// A number with this many digits after the point.
pub fn number(value: f64, digits: usize) -> String {
    format!("{:.digits$}", value + 0.0)
}

/// An estimate and its standard error.
pub fn measured(estimate: Option<Estimate>, digits: usize) -> String {
    estimate.map_or(PENDING.to_owned(), |e| match e.error {
        Some(error) => format!("{:.digits$} ± {error:.digits$}", e.value),
        None => number(e.value, digits),
    })
}

/// Difference of an estimate from the expected value, in per cent and in standard errors.
pub fn deviation(estimate: Option<Estimate>, expected: f64) -> String {
    difference(estimate, |value| value - expected, |by| format!("{:+.2} %", 100.0 * by / expected))
}

/// Difference of an estimate from the expected value, in its unit and in standard errors.
pub fn offset(estimate: Option<Estimate>, expected: f64) -> String {
    difference(estimate, |value| value - expected, |by| format!("{by:+.4}"))
}

/// Difference of an estimated angle from the expected one, in degrees and in standard errors.
pub fn turned(estimate: Option<Estimate>, expected: f64) -> String {
    difference(estimate, |value| (value - expected + 540.0).rem_euclid(360.0) - 180.0, |by| format!("{by:+.2}°"))
}

fn difference(estimate: Option<Estimate>, by: impl Fn(f64) -> f64, text: impl Fn(f64) -> String) -> String {
    estimate.map_or(PENDING.to_owned(), |e| {
        let by = by(e.value);
        let errors = e.error.filter(|&se| se > 0.0).map_or(String::new(), |se| format!(" ({:+.1} σ)", by / se));
        text(by) + &errors
    })
}

/// Difference of the program's number from a published one, in per cent.
pub fn against(ours: f64, published: f64) -> String {
    format!("{:+.1} %", 100.0 * (ours / published - 1.0))
}
