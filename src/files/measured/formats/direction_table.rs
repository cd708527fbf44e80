//! Reads a table of densities over frequency and direction. Its first line has a word and the directions (bearings that
//! waves come from, degrees); each further line has a frequency (Hz) and the densities (m^2/Hz/degree).

use super::grid::{Grid, Records};
use super::lines::Lines;
use crate::files::measured::directional::{MAX_FILE_DIRECTIONS, MIN_DIRECTIONS};
use crate::files::measured::list::SpectrumList;
use crate::files::measured::spectrum::MAX_BANDS;
use crate::files::measured::text::{TextFile, parse_number, quoted_excerpt};

const COMMENT: Option<char> = Some('#');

/// Splits a line at commas, semicolons or tabs, of which only one kind separates the columns of a file.
fn columns(line: &str) -> Vec<&str> {
    let separator = ['\t', ';', ','].into_iter().find(|&c| line.contains(c)).unwrap_or(',');
    line.split(separator).take(MAX_FILE_DIRECTIONS + 2).map(|field| field.trim().trim_matches('"').trim()).collect()
}

/// Directions in the first line of a table; `None` if it is no line with a word and numbers.
fn directions(line: &str) -> Option<Vec<f64>> {
    let fields = columns(line);
    let (first, rest) = fields.split_first()?;
    if parse_number(first).is_some() || rest.len() < MIN_DIRECTIONS {
        return None;
    }
    rest.iter().map(|field| parse_number(field)).collect()
}

/// Whether the first line that is no comment has a word and directions.
pub(super) fn is_direction_table(file: &TextFile<'_>) -> bool {
    Lines::new(file, COMMENT).next_line().is_some_and(|line| directions(line).is_some())
}

/// Reads the one spectrum of a table.
pub(super) fn read(file: &TextFile<'_>) -> Result<SpectrumList, String> {
    let mut lines = Lines::new(file, COMMENT);
    let from_deg = lines.next_line().and_then(directions).unwrap_or_default();
    let (mut frequencies_hz, mut densities) = (Vec::new(), Vec::new());
    while let Some(line) = lines.next_line() {
        let fields = columns(line);
        if fields.len() != from_deg.len() + 1 {
            return Err(lines.error(format!(
                "{} columns, but the first line has {}",
                fields.len(),
                from_deg.len() + 1
            )));
        }
        if frequencies_hz.len() == MAX_BANDS {
            return Err(lines.error(format!("more than {MAX_BANDS} frequencies")));
        }
        let value = |field: &str| {
            parse_number(field).ok_or_else(|| lines.error(format!("{} is not a number", quoted_excerpt(field))))
        };
        frequencies_hz.push(value(fields[0])?);
        for field in &fields[1..] {
            densities.push(value(field)?.to_degrees());
        }
    }
    let whole = |what: String| file.file_error(what);
    let grid = Grid::new(frequencies_hz, &from_deg).map_err(whole)?;
    let mut records = Records::default();
    records.add("", grid.spectrum(&densities).map_err(whole)?);
    SpectrumList::new(&file.name, records.records, records.skipped)
}
