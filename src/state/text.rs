//! Text helpers of the state string and of preset files.

/// Most notices of one reading; a last one counts the rest.
pub(super) const MAX_NOTICES: usize = 24;
/// Longest quotation in a notice, characters.
const MAX_QUOTED: usize = 40;

/// The shortest text that reads back to the same number, with an exponent for tiny numbers.
pub(super) fn shortest(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-6 { format!("{value:e}") } else { value.to_string() }
}

/// The first `longest` characters of a text, without control characters and surrounding blanks.
pub(super) fn printable(text: &str, longest: usize) -> String {
    let clean: String = text.chars().filter(|c| !c.is_control()).collect();
    let short: String = clean.trim().chars().take(longest).collect();
    short.trim_end().to_owned()
}

/// The beginning of a text, as notices quote it.
pub(super) fn quoted(text: &str) -> String {
    let ellipsis = if text.chars().count() > MAX_QUOTED { "…" } else { "" };
    printable(text, MAX_QUOTED) + ellipsis
}

/// Replaces the notices after the first [`MAX_NOTICES`] by their number.
pub(super) fn limit(notices: &mut Vec<String>) {
    if notices.len() > MAX_NOTICES {
        let more = notices.len() - MAX_NOTICES;
        notices.truncate(MAX_NOTICES);
        notices.push(format!("and {more} more"));
    }
}
