//! From files to a sea: limits, text, and which reader.

use super::{Measured, ndbc, printable, sections, table};
use std::fmt::Display;

/// Largest file that is read.
pub const MAX_FILE_BYTES: usize = 16 << 20;
/// Most files that make one sea.
pub const MAX_FILES: usize = 8;
/// Most columns of a line.
pub(super) const MAX_COLUMNS: usize = 4096;

/// One file as text, with its name fit to be shown.
pub(super) struct File<'a> {
    pub name: String,
    pub text: &'a str,
}

impl File<'_> {
    /// The sentence of an error in a line, counted from 1.
    pub fn fault(&self, line: usize, what: impl Display) -> String {
        format!("{}, line {line}: {what}", self.name)
    }

    /// The sentence of an error in the whole file.
    pub fn whole(&self, what: impl Display) -> String {
        format!("{}: {what}", self.name)
    }
}

impl Measured {
    /// One sea from one or several files (name, content), and notices of what could not be taken. Read are
    ///
    /// - the NDBC's realtime files `.data_spec`, `.swdir`, `.swdir2`, `.swr1`, `.swr2`;
    /// - its archive files such as `44025w2023.txt` (w density, d alpha1, i alpha2, j r1, k r2), old headers included;
    /// - several of these in one file, each from its header line on; where neither header nor name tells what a section
    ///   holds, a comment such as `# alpha1` or `# kind: r1` before the header does;
    /// - a table of f, S (Hz, m^2/Hz) or f, S, direction, spread (degrees from, degrees), separated by comma, semicolon
    ///   or tab, a line of names on top or not. After semicolons and tabs a decimal comma is read too.
    ///
    /// The newest record with a complete density is taken, with the directions of the same time.
    ///
    /// # Errors
    /// One sentence with file, line and reason for the first thing that is malformed, in whichever record.
    pub fn read(files: &[(String, Vec<u8>)]) -> Result<(Self, Vec<String>), String> {
        if files.is_empty() {
            return Err("no file was given".into());
        }
        if files.len() > MAX_FILES {
            return Err(format!("{} files were given: at most {MAX_FILES} make one sea", files.len()));
        }
        let files = files.iter().map(|(name, bytes)| decode(name, bytes)).collect::<Result<Vec<_>, _>>()?;
        let tables = files.iter().filter(|f| !sections::recognises(f)).collect::<Vec<_>>();
        match (tables.as_slice(), files.as_slice()) {
            ([], _) => ndbc::read(&files),
            ([only], [_]) => table::read(only),
            ([first, ..], _) => Err(first.whole("a table is a whole sea: it cannot be read together with other files")),
        }
    }
}

/// The content of a line: no byte order mark, no space around it.
pub(super) fn content(line: &str) -> &str {
    line.trim_start_matches('\u{feff}').trim()
}

/// A piece of a file as an error quotes it.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", printable(text, 24))
}

fn decode<'a>(name: &str, bytes: &'a [u8]) -> Result<File<'a>, String> {
    // A browser gives the bare name, a command line the path.
    let name = printable(name.rsplit(['/', '\\']).next().unwrap_or_default(), 60);
    let name = if name.is_empty() { "(no name)".into() } else { name };
    if bytes.len() > MAX_FILE_BYTES {
        return Err(format!("{name}: the file is larger than {} MiB", MAX_FILE_BYTES >> 20));
    }
    if bytes.starts_with(&[0x1f, 0x8b]) || bytes.starts_with(b"PK\x03\x04") {
        return Err(format!("{name}: the file is compressed: unpack it first"));
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(format!("{name}: the file is UTF-16 text: save it as UTF-8"));
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if text.lines().all(|l| content(l).is_empty()) => Err(format!("{name}: the file is empty")),
        Ok(text) => Ok(File { name, text }),
        Err(_) if bytes.contains(&0) => {
            Err(format!("{name}: the file is no text: a buoy's spectrum is NDBC's text or a table as CSV"))
        }
        Err(e) => {
            let line = 1 + bytes[..e.valid_up_to()].iter().filter(|&&b| b == b'\n').count();
            Err(format!("{name}, line {line}: the text is not valid UTF-8"))
        }
    }
}
