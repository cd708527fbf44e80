//! Text helpers for reading and writing state strings and preset files.

/// Largest number of notices (messages to the user) about one state string or preset file; one more notice counts those
/// that were left out.
pub(super) const MAX_NOTICES: usize = 24;
/// Longest piece of the user's text that [`quoted_excerpt`] quotes in a message, characters.
const MAX_QUOTED_CHARS: usize = 40;

/// Formats a number as the shortest text that parses to the same f64; magnitudes below 1e-6 get an exponent.
pub(super) fn shortest_decimal(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-6 { format!("{value:e}") } else { value.to_string() }
}

/// Removes control characters and surrounding white space from a text and returns its first `longest` characters.
pub(super) fn printable_prefix(text: &str, longest: usize) -> String {
    let clean: String = text.chars().filter(|c| !c.is_control()).collect();
    let short: String = clean.trim().chars().take(longest).collect();
    short.trim_end().to_owned()
}

/// Returns the first [`MAX_QUOTED_CHARS`] printable characters of a text for a message, with an ellipsis if it was cut.
pub(super) fn quoted_excerpt(text: &str) -> String {
    let ellipsis = if text.chars().count() > MAX_QUOTED_CHARS { "…" } else { "" };
    printable_prefix(text, MAX_QUOTED_CHARS) + ellipsis
}

/// Cuts a list of more than [`MAX_NOTICES`] messages to the user to that many and appends one such as "and 3 more".
pub(super) fn truncate_notices(notices: &mut Vec<String>) {
    if notices.len() > MAX_NOTICES {
        let more = notices.len() - MAX_NOTICES;
        notices.truncate(MAX_NOTICES);
        notices.push(format!("and {more} more"));
    }
}
