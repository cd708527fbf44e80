//! Numbers as text in a state string.

/// The shortest text that reads back to the same number; with an exponent where zeros would fill a line.
pub(super) fn shortest(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-6 { format!("{value:e}") } else { value.to_string() }
}
