//! Sections of NDBC files (measurement descriptions, ndbc.noaa.gov/faq/measdes.shtml), each a header line and the records
//! under it. In realtime sections a frequency in parentheses follows each value; in archive sections the header lists the
//! frequencies.

use crate::files::measured::spectrum::{MAX_BANDS, checked_frequency};
use crate::files::measured::text::{MAX_COLUMNS, TextFile, content, number, quoted, shown};
use std::fmt;

/// Most header lines of one file.
const MAX_SECTIONS: usize = 64;
/// Most records of all files: a year of five sections every ten minutes is 262 800.
pub(super) const MAX_RECORDS: usize = 400_000;

/// Quantity that a section holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SectionKind {
    Density,
    Alpha1,
    Alpha2,
    R1,
    R2,
}

/// Marks of each kind: the prefix of its columns in a realtime header, the letter before the year in the name of an archive
/// file (`44025w2023.txt`), and words in a comment, among them the extension of the realtime file.
const MARKS: [(SectionKind, &str, u8, &[&str]); 5] = [
    (SectionKind::Density, "spec", b'w', &["density", "spectral density", "data_spec", "swden"]),
    (SectionKind::Alpha1, "alpha1", b'd', &["alpha1", "swdir"]),
    (SectionKind::Alpha2, "alpha2", b'i', &["alpha2", "swdir2"]),
    (SectionKind::R1, "r1", b'j', &["r1", "swr1"]),
    (SectionKind::R2, "r2", b'k', &["r2", "swr2"]),
];

impl SectionKind {
    /// Name in messages.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Density => "variance density",
            Self::Alpha1 => "alpha1",
            Self::Alpha2 => "alpha2",
            Self::R1 => "r1",
            Self::R2 => "r2",
        }
    }

    /// The kind that a comment such as `# alpha1` or `# kind: r1` names.
    fn from_comment(comment: &str) -> Option<Self> {
        let text = comment.trim_start_matches('#').trim().to_ascii_lowercase();
        let word = text.strip_prefix("kind").map_or(text.as_str(), |t| t.trim_start().trim_start_matches([':', '=']));
        MARKS.iter().find(|(.., words)| words.contains(&word.trim())).map(|mark| mark.0)
    }

    /// The kind of a column in a realtime header.
    fn from_column(column: &str) -> Option<Self> {
        let column = column.to_ascii_lowercase();
        if column == "sep_freq" {
            return Some(Self::Density);
        }
        let prefix = column.split_once('_')?.0;
        MARKS.iter().find(|mark| mark.1 == prefix).map(|mark| mark.0)
    }

    /// The kind of an archive file, by its name.
    fn from_file_name(name: &str) -> Option<Self> {
        let stem = name.split('.').next().unwrap_or_default().as_bytes();
        let [.., station, letter, a, b, c, d] = stem else { return None };
        if ![station, a, b, c, d].iter().all(|c| c.is_ascii_digit()) {
            return None;
        }
        MARKS.iter().find(|mark| mark.2 == letter.to_ascii_lowercase()).map(|mark| mark.0)
    }

    fn is_angle(self) -> bool {
        matches!(self, Self::Alpha1 | Self::Alpha2)
    }

    fn is_moment(self) -> bool {
        matches!(self, Self::R1 | Self::R2)
    }
}

/// Time of a record: year, month, day, hour, minute (UTC).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct RecordTime([u16; 5]);

impl RecordTime {
    /// Takes the time off the front of a record.
    fn take(rest: &mut &str, has_minutes: bool) -> Result<Self, String> {
        let limits = [("year", 0, 9999), ("month", 1, 12), ("day", 1, 31), ("hour", 0, 23), ("minute", 0, 59)];
        let mut time = [0; 5];
        for (slot, (name, low, high)) in time.iter_mut().zip(limits).take(if has_minutes { 5 } else { 4 }) {
            let text = take_word(rest).ok_or_else(|| format!("the record ends before its {name}"))?;
            let value = text.parse::<u16>().ok().filter(|v| (low..=high).contains(v));
            *slot = value.ok_or_else(|| format!("{} is not a valid {name}", quoted(text)))?;
        }
        // Years have two digits until 1998.
        time[0] += match time[0] {
            0..50 => 2000,
            50..100 => 1900,
            _ => 0,
        };
        Ok(Self(time))
    }
}

impl fmt::Display for RecordTime {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [year, month, day, hour, minute] = self.0;
        write!(out, "{year:04}-{month:02}-{day:02} {hour:02}:{minute:02} UTC")
    }
}

/// A header line and the records under it.
pub(super) struct Section<'a> {
    pub file: &'a TextFile<'a>,
    /// Line of the header, counted from 1.
    pub line: usize,
    /// None where neither header, comment nor file name says it.
    pub kind: Option<SectionKind>,
    has_minutes: bool,
    /// Frequencies of an archive section, Hz; None in a realtime section.
    frequencies: Option<Vec<f64>>,
    /// Whether a value above 1.5 occurs.
    has_large_value: bool,
    pub records: Vec<Record<'a>>,
}

/// A line of values.
pub(super) struct Record<'a> {
    /// Line in the file, counted from 1.
    pub line: usize,
    pub time: RecordTime,
    /// The line after the time.
    values: &'a str,
}

/// Frequency of a band in Hz and the value there, None where it is missing.
pub(super) type BandValue = (f64, Option<f64>);

/// Whether a header line has minutes, and its column names after `YY MM DD hh [mm]`. None for any other line.
pub(super) fn column_names(line: &str) -> Option<(bool, &str)> {
    let mut rest = line.trim_start_matches('#');
    let year = take_word(&mut rest)?;
    if !year.eq_ignore_ascii_case("YY") && !year.eq_ignore_ascii_case("YYYY") {
        return None;
    }
    for label in ["MM", "DD", "hh"] {
        take_word(&mut rest).filter(|word| word.eq_ignore_ascii_case(label))?;
    }
    let mut after = rest;
    let has_minutes = take_word(&mut after).is_some_and(|word| word.eq_ignore_ascii_case("mm"));
    Some((has_minutes, if has_minutes { after } else { rest }))
}

/// Takes the first word off a text.
fn take_word<'a>(text: &mut &'a str) -> Option<&'a str> {
    let start = text.trim_start();
    let (first, rest) = start.split_at(start.find(char::is_whitespace).unwrap_or(start.len()));
    *text = rest;
    (!first.is_empty()).then_some(first)
}

/// Reads the sections of a file and checks the syntax of all records, of which at most `records_left` are read.
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
            let (kind, frequencies) = header(columns, &file.name)?;
            let kind = kind.or(comment.take()).or_else(|| SectionKind::from_file_name(&file.name));
            let records = Vec::new();
            sections.push(Section { file, line, kind, has_minutes, frequencies, has_large_value: false, records });
        } else if text.starts_with('#') {
            comment = SectionKind::from_comment(text).or(comment);
        } else if !text.is_empty() {
            let before_header = || format!("{} stands before the first header line", quoted(text));
            let section = sections.last_mut().ok_or_else(before_header)?;
            *records_left = records_left.checked_sub(1).ok_or_else(|| format!("more than {MAX_RECORDS} records"))?;
            let mut values = text;
            let time = RecordTime::take(&mut values, section.has_minutes)?;
            section.has_large_value |= section.values(values)?.iter().any(|band| band.1.is_some_and(|v| v > 1.5));
            section.records.push(Record { line, time, values });
        }
        Ok(())
    };
    for (line, text) in (1..).zip(file.text.lines()) {
        add_line(line, content(text)).map_err(|what| file.message_at(line, what))?;
    }
    Ok(sections)
}

/// The kind that the columns of a realtime header name, or the frequencies in an archive header.
fn header(columns: &str, file_name: &str) -> Result<(Option<SectionKind>, Option<Vec<f64>>), String> {
    let first = columns.split_whitespace().next().ok_or("the header names neither frequencies nor values")?;
    if number(first).is_some() {
        let mut frequencies = Vec::new();
        for column in columns.split_whitespace() {
            let f = number(column).ok_or_else(|| format!("the frequency {} is not a number", quoted(column)))?;
            frequencies.push(checked_frequency(f, frequencies.last().copied())?);
            if frequencies.len() > MAX_BANDS {
                return Err(format!("more than {MAX_BANDS} frequency bands"));
            }
        }
        return Ok((None, Some(frequencies)));
    }
    match SectionKind::from_column(first) {
        // Some .swr2 files have the column names of r1.
        Some(SectionKind::R1) if file_name.to_ascii_lowercase().ends_with(".swr2") => Ok((Some(SectionKind::R2), None)),
        Some(kind) => Ok((Some(kind), None)),
        None => Err(format!("the column {} does not belong in a spectral file", quoted(first))),
    }
}

impl Section<'_> {
    /// Whether this is an archive section whose r1 or r2 must be in hundredths.
    pub(super) fn is_in_hundredths(&self) -> bool {
        self.frequencies.is_some() && self.has_large_value && self.kind.is_some_and(SectionKind::is_moment)
    }

    /// Whether a value stands for a missing one. A direction of 99 degrees does not.
    fn is_missing(&self, v: f64) -> bool {
        let nines = match self.kind {
            Some(kind) if kind.is_angle() => false,
            Some(kind) if kind.is_moment() => v == 99.0,
            _ => v == 99.0 && self.frequencies.is_some(),
        };
        nines || v == 999.0 || v == 9999.0
    }

    /// The values of a record.
    pub(super) fn bands(&self, record: &Record<'_>) -> Result<Vec<BandValue>, String> {
        self.values(record.values).map_err(|what| self.file.message_at(record.line, what))
    }

    /// The values of a directional record, angles in degrees and moments from 0 to 1.5, with their range checked.
    pub(super) fn directional(&self, record: &Record<'_>, hundredths: bool) -> Result<Vec<BandValue>, String> {
        let mut bands = self.bands(record)?;
        let is_angle = self.kind.is_some_and(SectionKind::is_angle);
        let scale = if !is_angle && hundredths && self.frequencies.is_some() { 0.01 } else { 1.0 };
        let high = if is_angle { 360.0 } else { 1.5 };
        for v in bands.iter_mut().filter_map(|band| band.1.as_mut()) {
            let given = *v;
            *v *= scale;
            if !(0.0..=high).contains(v) {
                let (name, most) = (self.kind.map_or("value", SectionKind::name), high / scale);
                let what = format!("{name} of {} is not within 0 to {}", shown(given), shown(most));
                return Err(self.file.message_at(record.line, what));
            }
        }
        Ok(bands)
    }

    /// The values in the text of a record after its time.
    fn values(&self, text: &str) -> Result<Vec<BandValue>, String> {
        let value = |text: &str| match number(text) {
            Some(v) => Ok(Some(v).filter(|&v| !self.is_missing(v))),
            None if text == "MM" => Ok(None),
            None => Err(format!("the value {} is not a number", quoted(text))),
        };
        let mut words = text.split_whitespace();
        if let Some(frequencies) = &self.frequencies {
            let (n, wanted, line) = (words.clone().count(), frequencies.len(), self.line);
            if n != wanted {
                return Err(format!("{n} values for the {wanted} frequencies of line {line}"));
            }
            return words.zip(frequencies).map(|(text, f)| Ok((*f, value(text)?))).collect();
        }
        // Files of variance density have the separation frequency first, without parentheses after it.
        if words.clone().nth(1).is_none_or(|second| !second.starts_with('('))
            && let Some(separation) = words.next()
        {
            value(separation)?;
        }
        let mut bands: Vec<BandValue> = Vec::new();
        while let Some(text) = words.next() {
            let v = value(text)?;
            let f = words.next().and_then(|f| f.strip_prefix('(')?.strip_suffix(')')).and_then(number);
            let f = f.ok_or_else(|| format!("after {} a frequency in parentheses is missing", quoted(text)))?;
            bands.push((checked_frequency(f, bands.last().map(|band| band.0))?, v));
            if bands.len() > MAX_BANDS {
                return Err(format!("more than {MAX_BANDS} frequency bands"));
            }
        }
        if bands.is_empty() { Err("the record has no values".into()) } else { Ok(bands) }
    }
}
