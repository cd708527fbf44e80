//! File formats of measured spectra: each has a module here, and [`Format::detect`] is the one place that recognises
//! them.
//!
//! A new format needs a module with a function that recognises it and `read`, and a variant of [`Format`]. A binary
//! format must be recognised by its first bytes before the files are decoded as text.

mod direction_table;
mod grid;
mod lines;
mod ndbc;
#[cfg(feature = "files")]
mod netcdf;
#[cfg(feature = "files")]
mod spotter;
mod swan;
mod table;
mod ww3_text;

use super::list::SpectrumList;
use super::spectrum::{MeasuredSpectrum, SpectrumFile};
use super::text::TextFile;
#[cfg(feature = "files")]
use super::text::{MAX_FILE_BYTES, short_name, too_large};

/// Largest number of files that are read together as one measured spectrum.
pub const MAX_FILES_PER_SPECTRUM: usize = 8;

/// Format of a text file with measured spectra.
#[derive(Clone, Copy, PartialEq)]
enum Format {
    /// NDBC text file of a buoy; several files can make one spectrum.
    Ndbc,
    /// Spectral file of the wave model SWAN.
    Swan,
    /// Point spectra of the wave model WAVEWATCH III as text.
    Ww3Text,
    /// Table with a column for each direction.
    DirectionTable,
    /// Table of frequency and density, with or without direction and spread.
    Table,
}

impl Format {
    /// Recognises the format of a file by its content. Text without the header line of another format counts as a table.
    fn detect(file: &TextFile<'_>) -> Self {
        if swan::is_swan_file(file) {
            Self::Swan
        } else if ww3_text::is_ww3_file(file) {
            Self::Ww3Text
        } else if ndbc::is_ndbc_file(file) {
            Self::Ndbc
        } else if direction_table::is_direction_table(file) {
            Self::DirectionTable
        } else {
            Self::Table
        }
    }
}

impl MeasuredSpectrum {
    /// Reads one spectrum from one or several files: the default one of [`Self::read_list`].
    ///
    /// # Errors
    /// As [`Self::read_list`].
    pub fn read(files: &[(String, Vec<u8>)]) -> Result<SpectrumFile, String> {
        Self::read_list(files)?.choose(None)
    }

    /// Reads all spectra from one or several files, given as (name, content). These formats are read:
    ///
    /// - NDBC realtime files: `.data_spec`, `.swdir`, `.swdir2`, `.swr1`, `.swr2`;
    /// - NDBC archive files such as `44025w2023.txt` (w density, d alpha1, i alpha2, j r1, k r2), with old headers too;
    /// - several of these in one file, each from its header line on. Where neither header nor file name says what a
    ///   section holds, a comment before the header must, such as `# alpha1` or `# kind: r1`;
    /// - a table of f, S (Hz, m^2/Hz) or f, S, direction, spread (degrees from, degrees), separated by comma, semicolon
    ///   or tab, with or without a first line of names. With semicolons and tabs a decimal comma is read too;
    /// - a table with a column for each direction: a first line with a word and the directions (degrees from), then
    ///   lines of f and densities (m^2/Hz/degree);
    /// - spectral files of SWAN, with and without directions, and point spectra of WAVEWATCH III as text;
    /// - with the feature `files`: spectra over frequency and direction in NetCDF files, and JSON of Spotter buoys.
    ///
    /// An NDBC file has many records. Each whose variance densities are complete becomes a spectrum, with the directions
    /// of the same time, and the newest is the default.
    ///
    /// # Errors
    /// One sentence with file, line and reason for the first malformed entry of any record. Older records of a buoy
    /// whose values contradict each other are left out, with a notice.
    pub fn read_list(files: &[(String, Vec<u8>)]) -> Result<SpectrumList, String> {
        if files.len() > MAX_FILES_PER_SPECTRUM {
            return Err(format!(
                "{} files were given: give at most {MAX_FILES_PER_SPECTRUM} for one spectrum",
                files.len()
            ));
        }
        #[cfg(feature = "files")]
        if let Some(list) = read_other_than_text(files)? {
            return Ok(list);
        }
        let files = files.iter().map(|(name, bytes)| TextFile::decode(name, bytes)).collect::<Result<Vec<_>, _>>()?;
        let first = files.first().ok_or("no file was given")?;
        let format = Format::detect(first);
        if let Some(other) = files.iter().find(|file| Format::detect(file) != format) {
            return Err(other.file_error(format!("its format differs from that of {}: read it alone", first.name)));
        }
        if format != Format::Ndbc && files.len() > 1 {
            return Err(first.file_error("it holds complete spectra: read it without other files"));
        }
        match format {
            Format::Ndbc => ndbc::read(&files),
            Format::Swan => swan::read(first),
            Format::Ww3Text => ww3_text::read(first),
            Format::DirectionTable => direction_table::read(first),
            Format::Table => table::read(first),
        }
    }
}

/// Reads files that are not lines of text; `None` if the files are.
#[cfg(feature = "files")]
fn read_other_than_text(files: &[(String, Vec<u8>)]) -> Result<Option<SpectrumList>, String> {
    let is_netcdf = |bytes: &[u8]| crate::files::netcdf::is_netcdf(bytes);
    let Some((name, bytes)) = files.iter().find(|(_, bytes)| is_netcdf(bytes) || spotter::is_json(bytes)) else {
        return Ok(None);
    };
    let name = short_name(name);
    if files.len() > 1 {
        return Err(format!("{name}: it holds complete spectra: read it without other files"));
    }
    if bytes.len() > MAX_FILE_BYTES {
        return Err(format!("{name}: {}", too_large()));
    }
    if is_netcdf(bytes) { netcdf::read(&name, bytes) } else { spotter::read(&name, bytes) }.map(Some)
}
