//! Sections of NDBC files (measurement descriptions, ndbc.noaa.gov/faq/measdes.shtml), each a header line and the
//! records under it. In realtime sections a frequency in parentheses follows each value; in archive sections the header
//! lists the frequencies.

use crate::files::measured::spectrum::{MAX_BANDS, checked_frequency};
use crate::files::measured::text::{MAX_COLUMNS, TextFile, display_number, parse_number, quoted_excerpt, trimmed_line};
use std::str::SplitWhitespace;

/// Largest number of sections (header lines) in one NDBC file.
const MAX_SECTIONS: usize = 64;
/// Largest number of records (lines with the values of one time) in all NDBC files that are read together; a year of
/// five quantities every ten minutes has 262 800.
pub(super) const MAX_RECORDS: usize = 400_000;

/// Quantity that a section of an NDBC file holds: variance density or one of four directional parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum SectionKind {
    Density,
    Alpha1,
    Alpha2,
    R1,
    R2,
}

/// Section kinds, each with its name, the letter before the year in an archive file's name (`44025w2023.txt`), the
/// prefix of columns in a realtime header, and words for it in a comment, one of which is the extension of a realtime
/// file.
const SECTION_KINDS: [(SectionKind, &str, u8, &str, &[&str]); 5] = [
    (SectionKind::Density, "variance density", b'w', "spec", &["density", "spectral density", "data_spec", "swden"]),
    (SectionKind::Alpha1, "alpha1", b'd', "alpha1", &["alpha1", "swdir"]),
    (SectionKind::Alpha2, "alpha2", b'i', "alpha2", &["alpha2", "swdir2"]),
    (SectionKind::R1, "r1", b'j', "r1", &["r1", "swr1"]),
    (SectionKind::R2, "r2", b'k', "r2", &["r2", "swr2"]),
];

impl SectionKind {
    /// Name of the quantity for messages, such as "variance density" or "alpha1".
    pub(super) fn name(self) -> &'static str {
        SECTION_KINDS[self as usize].1
    }

    /// Section kind (quantity) that a comment such as `# alpha1` or `# kind: r1` names; None if it names none.
    fn from_comment(comment: &str) -> Option<Self> {
        let text = comment.trim_start_matches('#').trim().to_ascii_lowercase();
        let word = text.strip_prefix("kind").map_or(text.as_str(), |t| t.trim_start().trim_start_matches([':', '=']));
        SECTION_KINDS.iter().find(|kind| kind.4.contains(&word.trim())).map(|kind| kind.0)
    }

    /// Section kind (quantity) of a column such as `alpha1_1` in a realtime header; None for another column.
    fn from_column(column: &str) -> Option<Self> {
        let column = column.to_ascii_lowercase();
        let prefix = if column == "sep_freq" { "spec" } else { column.split_once('_')?.0 };
        SECTION_KINDS.iter().find(|kind| kind.3 == prefix).map(|kind| kind.0)
    }

    /// Section kind (quantity) of an archive file, from the letter in a name such as `44025w2023.txt`; else None.
    fn from_file_name(name: &str) -> Option<Self> {
        let stem = name.split('.').next().unwrap_or_default().as_bytes();
        let [.., station, letter, a, b, c, d] = stem else { return None };
        let has_digits = [station, a, b, c, d].iter().all(|c| c.is_ascii_digit());
        SECTION_KINDS.iter().find(|kind| has_digits && kind.2 == letter.to_ascii_lowercase()).map(|kind| kind.0)
    }
}

/// A section of an NDBC file: a header line and the records under it.
pub(super) struct Section<'a> {
    pub file: &'a TextFile<'a>,
    /// Line number of the header in its file, counted from 1.
    pub line: usize,
    /// Quantity of the section; None where neither header, comment nor file name tells it.
    pub kind: Option<SectionKind>,
    has_minutes: bool,
    /// Frequencies of the bands from the header of an archive section, Hz; None in a realtime section, where each
    /// record gives them.
    frequencies: Option<Vec<f64>>,
    /// Whether any value of the section is above 1.5. In a section of r1 or r2 this shows that they are in hundredths.
    has_large_value: bool,
    pub records: Vec<Record<'a>>,
}

/// A record of a section: one line with the values of one time.
pub(super) struct Record<'a> {
    /// Line number of the record in its file, counted from 1.
    pub line: usize,
    /// Time such as `2026-11-21 06:00 UTC`; sorting these texts sorts the times.
    pub time: String,
    /// Words of the record's line after the time, not yet parsed.
    values: SplitWhitespace<'a>,
}

/// Frequency of a band in Hz, and the value of the band in the unit of the section, or None where it is missing.
pub(super) type BandValue = (f64, Option<f64>);

/// Parses a header line, `YY MM DD hh [mm]` and column names. Returns whether it has minutes (mm), and the column
/// names. None for a line that is no header.
pub(super) fn column_names(line: &str) -> Option<(bool, SplitWhitespace<'_>)> {
    let is = |word: Option<&str>, label: &str| word.is_some_and(|word| word.eq_ignore_ascii_case(label));
    let mut words = line.trim_start_matches('#').split_whitespace();
    let year = words.next();
    if !(is(year, "YY") || is(year, "YYYY")) || !["MM", "DD", "hh"].iter().all(|label| is(words.next(), label)) {
        return None;
    }
    let mut after_minutes = words.clone();
    let has_minutes = is(after_minutes.next(), "mm");
    Some((has_minutes, if has_minutes { after_minutes } else { words }))
}

/// Reads the sections of an NDBC file and checks the syntax of their records. Reduces `records_left`, which all files
/// share, by one for each record; a record after it reaches 0 is an error.
pub(super) fn read_sections<'a>(file: &'a TextFile<'a>, records_left: &mut usize) -> Result<Vec<Section<'a>>, String> {
    let mut sections: Vec<Section<'a>> = Vec::new();
    let mut comment = None;
    let mut add_line = |line: usize, text: &'a str| {
        if text.split_whitespace().nth(MAX_COLUMNS).is_some() {
            return Err(format!("more than {MAX_COLUMNS} columns"));
        }
        if let Some((has_minutes, columns)) = column_names(text) {
            if sections.len() == MAX_SECTIONS {
                return Err(format!("more than {MAX_SECTIONS} header lines"));
            }
            let (kind, frequencies) = parse_header(columns, &file.name)?;
            let kind = kind.or(comment.take()).or_else(|| SectionKind::from_file_name(&file.name));
            let records = Vec::new();
            sections.push(Section { file, line, kind, has_minutes, frequencies, has_large_value: false, records });
        } else if text.starts_with('#') {
            comment = SectionKind::from_comment(text).or(comment);
        } else if !text.is_empty() {
            let before_header = || format!("{} stands before the first header line", quoted_excerpt(text));
            let section = sections.last_mut().ok_or_else(before_header)?;
            *records_left = records_left.checked_sub(1).ok_or_else(|| format!("more than {MAX_RECORDS} records"))?;
            let mut values = text.split_whitespace();
            let time = take_time(&mut values, section.has_minutes)?;
            let band_values = section.parse_values(values.clone())?;
            section.has_large_value |= band_values.iter().any(|band| band.1.is_some_and(|v| v > 1.5));
            section.records.push(Record { line, time, values });
        }
        Ok(())
    };
    for (line, text) in (1..).zip(file.text.lines()) {
        add_line(line, trimmed_line(text)).map_err(|what| file.line_error(line, what))?;
    }
    Ok(sections)
}

/// Takes year, month, day, hour and, if `has_minutes`, minute from the first words of a record, and formats them like
/// `2026-11-21 06:00 UTC`. A word that is missing or out of range is an error.
fn take_time(words: &mut SplitWhitespace<'_>, has_minutes: bool) -> Result<String, String> {
    let limits = [("year", 0, 9999), ("month", 1, 12), ("day", 1, 31), ("hour", 0, 23), ("minute", 0, 59)];
    let mut time = [0_u16; 5];
    for (slot, (name, low, high)) in time.iter_mut().zip(limits).take(if has_minutes { 5 } else { 4 }) {
        let text = words.next().ok_or_else(|| format!("the record ends before its {name}"))?;
        let value = text.parse().ok().filter(|v| (low..=high).contains(v));
        *slot = value.ok_or_else(|| format!("{} is not a valid {name}", quoted_excerpt(text)))?;
    }
    let [year, month, day, hour, minute] = time;
    // NDBC files write years with two digits until 1998.
    let year = match year {
        0..50 => year + 2000,
        50..100 => year + 1900,
        _ => year,
    };
    Ok(format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02} UTC"))
}

/// Parses `columns`, the words of a header line after the time labels. Returns the section kind of a realtime header or
/// the band frequencies (Hz) of an archive header; the other one is None.
fn parse_header(
    columns: SplitWhitespace<'_>,
    file_name: &str,
) -> Result<(Option<SectionKind>, Option<Vec<f64>>), String> {
    let first = columns.clone().next().ok_or("the header names neither frequencies nor values")?;
    if parse_number(first).is_none() {
        let kind = SectionKind::from_column(first);
        let kind =
            kind.ok_or_else(|| format!("the column {} does not belong in a spectral file", quoted_excerpt(first)))?;
        // Some .swr2 files have the column names of r1.
        let is_r2 = kind == SectionKind::R1 && file_name.to_ascii_lowercase().ends_with(".swr2");
        return Ok((Some(if is_r2 { SectionKind::R2 } else { kind }), None));
    }
    let mut frequencies = Vec::new();
    for column in columns {
        let f =
            parse_number(column).ok_or_else(|| format!("the frequency {} is not a number", quoted_excerpt(column)))?;
        frequencies.push(checked_frequency(f, frequencies.last().copied())?);
        if frequencies.len() > MAX_BANDS {
            return Err(format!("more than {MAX_BANDS} frequency bands"));
        }
    }
    Ok((None, Some(frequencies)))
}

impl Section<'_> {
    fn holds_angles(&self) -> bool {
        matches!(self.kind, Some(SectionKind::Alpha1 | SectionKind::Alpha2))
    }

    fn holds_moments(&self) -> bool {
        matches!(self.kind, Some(SectionKind::R1 | SectionKind::R2))
    }

    /// Whether this is an archive section of r1 or r2 whose large values show that it is in hundredths.
    pub(super) fn is_in_hundredths(&self) -> bool {
        self.frequencies.is_some() && self.has_large_value && self.holds_moments()
    }

    /// Whether the value `v` is a code for missing data in this section: 999 or 9999, and 99 except in sections of
    /// angles and realtime sections of variance density.
    fn is_missing(&self, v: f64) -> bool {
        let missing_99 = self.holds_moments() || !self.holds_angles() && self.frequencies.is_some();
        v == 999.0 || v == 9999.0 || v == 99.0 && missing_99
    }

    /// Parses the values of a record of this section: frequency in Hz and value, None if missing, of each band.
    pub(super) fn band_values(&self, record: &Record<'_>) -> Result<Vec<BandValue>, String> {
        self.parse_values(record.values.clone()).map_err(|what| self.file.line_error(record.line, what))
    }

    /// Values of a record of a directional section, band by band: angles in degrees, or magnitudes r1 or r2. If
    /// `hundredths`, the file stores magnitudes in hundredths, and they are multiplied by 0.01. Then an angle outside
    /// 0 to 360 degrees, or a magnitude outside 0 to 1.5 (1 and a margin for noise), is an error.
    pub(super) fn directional_values(&self, record: &Record<'_>, hundredths: bool) -> Result<Vec<BandValue>, String> {
        let mut band_values = self.band_values(record)?;
        let scale = if !self.holds_angles() && hundredths && self.frequencies.is_some() { 0.01 } else { 1.0 };
        let high = if self.holds_angles() { 360.0 } else { 1.5 };
        for v in band_values.iter_mut().filter_map(|band| band.1.as_mut()) {
            let given = *v;
            *v *= scale;
            if !(0.0..=high).contains(v) {
                let (name, most) = (self.kind.map_or("value", SectionKind::name), high / scale);
                let what = format!("{name} of {} is not within 0 to {}", display_number(given), display_number(most));
                return Err(self.file.line_error(record.line, what));
            }
        }
        Ok(band_values)
    }

    /// Parses `words`, a record after its time. Returns frequency (Hz) and value (None if missing) of each band.
    fn parse_values(&self, mut words: SplitWhitespace<'_>) -> Result<Vec<BandValue>, String> {
        let value = |text: &str| match parse_number(text) {
            Some(v) => Ok(Some(v).filter(|&v| !self.is_missing(v))),
            None if text == "MM" => Ok(None),
            None => Err(format!("the value {} is not a number", quoted_excerpt(text))),
        };
        if let Some(frequencies) = &self.frequencies {
            let (n, wanted, line) = (words.clone().count(), frequencies.len(), self.line);
            if n != wanted {
                return Err(format!("{n} values for the {wanted} frequencies of line {line}"));
            }
            return words.zip(frequencies).map(|(text, f)| Ok((*f, value(text)?))).collect();
        }
        // Realtime files of variance density have the separation frequency first, without parentheses after it.
        if words.clone().nth(1).is_none_or(|second| !second.starts_with('('))
            && let Some(separation) = words.next()
        {
            value(separation)?;
        }
        let mut band_values: Vec<BandValue> = Vec::new();
        while let Some(text) = words.next() {
            let v = value(text)?;
            let f = words.next().and_then(|f| f.strip_prefix('(')?.strip_suffix(')')).and_then(parse_number);
            let f = f.ok_or_else(|| format!("after {} a frequency in parentheses is missing", quoted_excerpt(text)))?;
            band_values.push((checked_frequency(f, band_values.last().map(|band| band.0))?, v));
            if band_values.len() > MAX_BANDS {
                return Err(format!("more than {MAX_BANDS} frequency bands"));
            }
        }
        if band_values.is_empty() { Err("the record has no values".into()) } else { Ok(band_values) }
    }
}
