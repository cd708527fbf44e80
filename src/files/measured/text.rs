//! Decodes text files within size limits, parses numbers, and formats text for messages.

use std::fmt::Display;

/// Largest file of a measured spectrum that is read, bytes.
pub const MAX_FILE_BYTES: usize = 16 << 20;
/// Largest number of columns in a line of a spectrum file; a line with more is an error.
pub(in crate::files) const MAX_COLUMNS: usize = 4096;

/// A decoded text file, and its name without folders, cut to 60 printable characters for messages.
pub(in crate::files) struct TextFile<'a> {
    pub name: String,
    pub text: &'a str,
}

impl<'a> TextFile<'a> {
    /// Decodes a file of UTF-8 text. Other bytes, only white space, and more than [`MAX_FILE_BYTES`] are errors.
    pub fn decode(name: &str, bytes: &'a [u8]) -> Result<Self, String> {
        let name = short_name(name);
        let reason = if bytes.len() > MAX_FILE_BYTES {
            too_large()
        } else if bytes.starts_with(&[0x1f, 0x8b]) || bytes.starts_with(b"PK\x03\x04") {
            "the file is compressed: unpack it first".into()
        } else if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            "the file is UTF-16 text: save it as UTF-8".into()
        } else {
            match std::str::from_utf8(bytes) {
                Ok(text) if text.lines().any(|line| !trimmed_line(line).is_empty()) => {
                    return Ok(Self { name, text });
                }
                Ok(_) => "the file is empty: choose another one".into(),
                Err(_) if bytes.contains(&0) => "the file is no text: choose an NDBC text file or a CSV table".into(),
                Err(e) => {
                    let line = 1 + bytes[..e.valid_up_to()].iter().filter(|&&b| b == b'\n').count();
                    format!("line {line} is not valid UTF-8: save the file as UTF-8")
                }
            }
        };
        Err(format!("{name}: {reason}"))
    }

    /// Makes an error message about the line number `line` (from 1) of this file; `what` says what is wrong there.
    pub fn line_error(&self, line: usize, what: impl Display) -> String {
        format!("{}, line {line}: {what}", self.name)
    }

    /// Makes an error message about this file as a whole; `what` says what is wrong with it.
    pub fn file_error(&self, what: impl Display) -> String {
        format!("{}: {what}", self.name)
    }
}

/// Why a file above the limit is refused.
pub(in crate::files) fn too_large() -> String {
    format!("the file is larger than {} MiB: keep fewer records in it", MAX_FILE_BYTES >> 20)
}

/// Name of a file without folders, cut to 60 printable characters for messages. A browser gives the bare name, a command
/// line the path.
pub(in crate::files) fn short_name(name: &str) -> String {
    let name = printable_prefix(name.rsplit(['/', '\\']).next().unwrap_or_default(), 60);
    if name.is_empty() { "(no name)".into() } else { name }
}

/// Returns a line without byte order mark and surrounding white space.
pub(in crate::files) fn trimmed_line(line: &str) -> &str {
    line.trim_start_matches('\u{feff}').trim()
}

/// Parses a finite decimal number; None for other text, such as "inf" or "nan".
pub(in crate::files) fn parse_number(text: &str) -> Option<f64> {
    let plain = |b: u8| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+' | b'e' | b'E');
    text.bytes().all(plain).then(|| text.parse().ok()).flatten().filter(|v: &f64| v.is_finite())
}

/// Formats a number for a message, with an exponent if its magnitude is below 1e-6 or at least 1e9.
pub(in crate::files) fn display_number(v: f64) -> String {
    if v == 0.0 || (1e-6..1e9).contains(&v.abs()) { v.to_string() } else { format!("{v:e}") }
}

/// Formats a word or line of a file for an error message: in quotation marks, cut to 24 characters.
pub(in crate::files) fn quoted_excerpt(text: &str) -> String {
    format!("\"{}\"", printable_prefix(text, 24))
}

/// Returns the printable characters of a text; of more than `limit`, the first `limit` - 1 and an ellipsis.
pub(in crate::files) fn printable_prefix(text: &str, limit: usize) -> String {
    // Unicode format characters, such as bidirectional marks, change or hide the text around them.
    let hidden = |c: char| {
        let format =
            matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}');
        format || c.is_control()
    };
    let mut rest = text.trim().chars().filter(|&c| !hidden(c));
    let mut out: String = rest.by_ref().take(limit).collect();
    if rest.next().is_some() {
        out.pop();
        out.push('…');
    }
    out
}
