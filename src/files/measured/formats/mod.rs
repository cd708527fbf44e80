//! File formats of measured spectra: each has a module here, and [`Format::detect`] is the one place that recognises
//! them.
//!
//! A new format needs a module with a function that recognises it and `read`, and a variant of [`Format`]. A binary
//! format must be recognised by its first bytes before the files are decoded as text.

mod ndbc;
mod table;

use super::spectrum::{MeasuredSpectrum, SpectrumFile};
use super::text::TextFile;

/// Largest number of files that are read together as one measured spectrum.
pub const MAX_FILES_PER_SPECTRUM: usize = 8;

/// Format of a file with a measured spectrum: NDBC text file of a buoy, or plain table.
#[derive(Clone, Copy, PartialEq)]
enum Format {
    Ndbc,
    Table,
}

impl Format {
    /// Recognises the format of a file by its content. Text without an NDBC header line counts as a table.
    fn detect(file: &TextFile<'_>) -> Self {
        if ndbc::is_ndbc_file(file) { Self::Ndbc } else { Self::Table }
    }
}

impl MeasuredSpectrum {
    /// Reads one spectrum from one or several files, given as (name, content). These formats are read:
    ///
    /// - NDBC realtime files: `.data_spec`, `.swdir`, `.swdir2`, `.swr1`, `.swr2`;
    /// - NDBC archive files such as `44025w2023.txt` (w density, d alpha1, i alpha2, j r1, k r2), with old headers too;
    /// - several of these in one file, each from its header line on. Where neither header nor file name says what a
    ///   section holds, a comment before the header must, such as `# alpha1` or `# kind: r1`;
    /// - a table of f, S (Hz, m^2/Hz) or f, S, direction, spread (degrees from, degrees), separated by comma, semicolon
    ///   or tab, with or without a first line of names. With semicolons and tabs a decimal comma is read too.
    ///
    /// The newest record with a complete variance density is used, with the directions of the same time.
    ///
    /// # Errors
    /// One sentence with file, line and reason for the first malformed entry of any record.
    pub fn read(files: &[(String, Vec<u8>)]) -> Result<SpectrumFile, String> {
        if files.len() > MAX_FILES_PER_SPECTRUM {
            return Err(format!(
                "{} files were given: give at most {MAX_FILES_PER_SPECTRUM} for one spectrum",
                files.len()
            ));
        }
        let files = files.iter().map(|(name, bytes)| TextFile::decode(name, bytes)).collect::<Result<Vec<_>, _>>()?;
        let first = files.first().ok_or("no file was given")?;
        let format = Format::detect(first);
        if let Some(other) = files.iter().find(|file| Format::detect(file) != format) {
            return Err(other.file_error(format!("its format differs from that of {}: read it alone", first.name)));
        }
        match format {
            Format::Ndbc => ndbc::read(&files),
            Format::Table => table::read(&files),
        }
    }
}
