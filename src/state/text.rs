//! Text helpers for reading and writing state strings and preset files.

/// Largest number of notices from reading one text; one more notice counts those that were left out.
pub(super) const MAX_NOTICES: usize = 24;
/// Longest piece of the user's text that a notice quotes, in characters.
const MAX_QUOTED_CHARS: usize = 40;

/// Formats a number as the shortest text that parses to the same f64; magnitudes below 1e-6 get an exponent.
pub(super) fn shortest_decimal(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-6 { format!("{value:e}") } else { value.to_string() }
}

/// Returns the first `longest` characters of a text without control characters and surrounding white space.
pub(super) fn printable_prefix(text: &str, longest: usize) -> String {
    let clean: String = text.chars().filter(|c| !c.is_control()).collect();
    let short: String = clean.trim().chars().take(longest).collect();
    short.trim_end().to_owned()
}

/// Returns the beginning of a text for quotation in a notice, with an ellipsis if it was cut.
pub(super) fn quoted_excerpt(text: &str) -> String {
    let ellipsis = if text.chars().count() > MAX_QUOTED_CHARS { "…" } else { "" };
    printable_prefix(text, MAX_QUOTED_CHARS) + ellipsis
}

/// Cuts a list of notices to the first [`MAX_NOTICES`] and appends the number of those removed.
pub(super) fn truncate_notices(notices: &mut Vec<String>) {
    if notices.len() > MAX_NOTICES {
        let more = notices.len() - MAX_NOTICES;
        notices.truncate(MAX_NOTICES);
        notices.push(format!("and {more} more"));
    }
}
