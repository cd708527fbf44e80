//! Reads a table of frequency f, variance density S and, where they are known, wave direction and directional spread.

use crate::files::measured::direction::{DirectionalParameters, fill_missing_directions};
use crate::files::measured::list::{SpectrumList, SpectrumRecord};
use crate::files::measured::spectrum::{MAX_BANDS, MeasuredSpectrum, checked_density, checked_frequency};
use crate::files::measured::text::{MAX_COLUMNS, TextFile, display_number, parse_number, quoted_excerpt, trimmed_line};

/// Texts that stand for a missing direction or spread in a table, in upper or lower case.
const MISSING_WORDS: [&str; 5] = ["", "-", "MM", "NaN", "NA"];
/// Numbers that stand for a missing direction or spread in a table.
const MISSING_NUMBERS: [f64; 4] = [999.0, 9999.0, -999.0, -9999.0];

/// The rows of a spectrum table that were read so far, with its separator and number of columns.
#[derive(Default)]
struct Rows {
    /// Character between the columns; None until the first line with columns is read.
    separator: Option<char>,
    /// Number of columns; None until the first line of numbers is read.
    columns: Option<usize>,
    /// Frequency in Hz and variance density in m^2/Hz of each row.
    bands: Vec<(f64, f64)>,
    /// Directional parameters of each row, None where it is missing; empty if the table has two columns.
    directions: Vec<Option<DirectionalParameters>>,
}

/// Reads a spectrum from a file that holds a table.
pub(super) fn read(file: &TextFile<'_>) -> Result<SpectrumList, String> {
    let mut rows = Rows::default();
    for (i, line) in file.text.lines().enumerate() {
        rows.add_line(line).map_err(|what| file.line_error(i + 1, what))?;
    }
    let mut notices = Vec::new();
    let Rows { bands, directions, .. } = rows;
    let directions =
        if directions.is_empty() { None } else { fill_missing_directions(&bands, &directions, &mut notices) };
    let spectrum = MeasuredSpectrum::new(&bands, directions.as_deref()).map_err(|what| file.file_error(what))?;
    SpectrumList::new(&file.name, vec![SpectrumRecord { label: String::new(), spectrum, notices }], 0)
}

impl Rows {
    fn add_line(&mut self, line: &str) -> Result<(), String> {
        // Tabs at the end of a line are not trimmed, because they mark empty fields.
        let line = line.trim_start_matches('\u{feff}').trim_matches([' ', '\r']);
        if trimmed_line(line).is_empty() || line.starts_with('#') {
            return Ok(());
        }
        let found = || ['\t', ';', ','].into_iter().find(|&c| line.contains(c));
        let separator = self.separator.or_else(found);
        let separator = separator.ok_or("no columns were found: separate them by comma, semicolon or tab")?;
        let is_first = self.separator.replace(separator).is_none();
        let fields: Vec<&str> =
            line.split(separator).take(MAX_COLUMNS + 1).map(|f| f.trim().trim_matches('"').trim()).collect();
        let n = fields.len();
        if n > MAX_COLUMNS {
            return Err(format!("more than {MAX_COLUMNS} columns"));
        }
        let value =
            |field: &str| if separator == ',' { parse_number(field) } else { parse_number(&field.replace(',', ".")) };
        if is_first && fields.iter().all(|f| value(f).is_none()) {
            return Ok(());
        }
        match self.columns {
            Some(before) if before != n => return Err(format!("{n} columns, but the lines before have {before}")),
            None if n != 2 && n != 4 => {
                return Err(format!("{n} columns, but 2 (f, S) or 4 (f, S, direction, spread) are needed"));
            }
            _ => self.columns = Some(n),
        }
        let known = |name: &str, field: &str| {
            value(field).ok_or_else(|| format!("the {name} {} is not a number", quoted_excerpt(field)))
        };
        let f = checked_frequency(known("frequency", fields[0])?, self.bands.last().map(|b| b.0))?;
        let s = checked_density(known("variance density", fields[1])?)?;
        if self.bands.len() == MAX_BANDS {
            return Err(format!("more than {MAX_BANDS} frequency bands"));
        }
        self.bands.push((f, s));
        let optional = |name: &str, field: &str, [low, high]: [f64; 2]| {
            if MISSING_WORDS.iter().any(|word| field.eq_ignore_ascii_case(word)) {
                return Ok(None);
            }
            match known(name, field)? {
                v if MISSING_NUMBERS.contains(&v) => Ok(None),
                v if (low..=high).contains(&v) => Ok(Some(v)),
                v => Err(format!("the {name} {} is not within {low} to {high} degrees", display_number(v))),
            }
        };
        if let [_, _, from, spread] = fields[..] {
            let from = optional("direction", from, [-360.0, 360.0])?;
            let spread = optional("spread", spread, [0.0, 180.0])?;
            self.directions
                .push(from.zip(spread).map(|(from, spread)| DirectionalParameters::from_spread(from, spread)));
        }
        Ok(())
    }
}
