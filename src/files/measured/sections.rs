//! The sections of NDBC files (measurement descriptions, ndbc.noaa.gov/faq/measdes.shtml), each a header line and the
//! records under it: realtime records carry a frequency in parentheses after each value, archive records stand under
//! a header of frequencies.

use super::read::{File, MAX_COLUMNS, content, quoted};
use super::{MAX_BANDS, frequency, number, shown};
use std::fmt;

/// Most header lines of one file.
const MAX_SECTIONS: usize = 64;
/// Most records of all files: a year of five sections every ten minutes is 262 800.
pub(super) const MAX_RECORDS: usize = 400_000;

/// What a section holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Density,
    Alpha1,
    Alpha2,
    R1,
    R2,
}

impl Kind {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Density => "spectral density",
            Self::Alpha1 => "alpha1",
            Self::Alpha2 => "alpha2",
            Self::R1 => "r1",
            Self::R2 => "r2",
        }
    }

    /// Of a word in a comment: `alpha1`, `kind: r1`, also the extension of the realtime file.
    fn from_comment(comment: &str) -> Option<Self> {
        let text = comment.trim_start_matches('#').trim().to_ascii_lowercase();
        let word = text.strip_prefix("kind").map_or(text.as_str(), |t| t.trim_start().trim_start_matches([':', '=']));
        Some(match word.trim() {
            "density" | "spectral density" | "data_spec" | "swden" => Self::Density,
            "alpha1" | "swdir" => Self::Alpha1,
            "alpha2" | "swdir2" => Self::Alpha2,
            "r1" | "swr1" => Self::R1,
            "r2" | "swr2" => Self::R2,
            _ => return None,
        })
    }

    /// Of a column's name in a realtime header.
    fn from_column(column: &str) -> Option<Self> {
        let column = column.to_ascii_lowercase();
        if column == "sep_freq" {
            return Some(Self::Density);
        }
        Some(match column.split_once('_')?.0 {
            "spec" => Self::Density,
            "alpha1" => Self::Alpha1,
            "alpha2" => Self::Alpha2,
            "r1" => Self::R1,
            "r2" => Self::R2,
            _ => return None,
        })
    }

    /// Of the letter before the year in an archive file's name: `44025w2023.txt`.
    fn from_name(name: &str) -> Option<Self> {
        let stem = name.split('.').next().unwrap_or_default().as_bytes();
        let [.., station, letter, a, b, c, d] = stem else { return None };
        if ![station, a, b, c, d].iter().all(|c| c.is_ascii_digit()) {
            return None;
        }
        Some(match letter.to_ascii_lowercase() {
            b'w' => Self::Density,
            b'd' => Self::Alpha1,
            b'i' => Self::Alpha2,
            b'j' => Self::R1,
            b'k' => Self::R2,
            _ => return None,
        })
    }
}

/// Year, month, day, hour, minute (UTC).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Time([u16; 5]);

impl fmt::Display for Time {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [year, month, day, hour, minute] = self.0;
        write!(out, "{year:04}-{month:02}-{day:02} {hour:02}:{minute:02} UTC")
    }
}

/// A header line and the records under it.
pub(super) struct Section<'a> {
    pub file: &'a File<'a>,
    pub line: usize,
    /// None until all sections are known.
    pub kind: Option<Kind>,
    minutes: bool,
    /// Of archive sections.
    pub frequencies: Option<Vec<f64>>,
    /// Whether a moment above 1.5 was seen.
    pub large: bool,
    pub records: Vec<Record<'a>>,
}

pub(super) struct Record<'a> {
    pub line: usize,
    pub time: Time,
    /// What follows the time.
    pub text: &'a str,
}

/// A value in its band; none is missing.
pub(super) type Band = (f64, Option<f64>);

/// Whether a file is of this kind: whether it has a header line.
pub(super) fn recognises(file: &File<'_>) -> bool {
    file.text.lines().any(|l| labels(content(l)).is_some())
}

/// The column names after `YY MM DD hh [mm]`, and whether there are minutes, if the line is a header.
fn labels(line: &str) -> Option<(bool, &str)> {
    let mut rest = line.trim_start_matches('#');
    let year = word(&mut rest)?;
    if !year.eq_ignore_ascii_case("YY") && !year.eq_ignore_ascii_case("YYYY") {
        return None;
    }
    for label in ["MM", "DD", "hh"] {
        word(&mut rest).filter(|w| w.eq_ignore_ascii_case(label))?;
    }
    let mut after = rest;
    let minutes = word(&mut after).is_some_and(|w| w.eq_ignore_ascii_case("mm"));
    Some((minutes, if minutes { after } else { rest }))
}

/// Takes the first word off a text.
fn word<'a>(text: &mut &'a str) -> Option<&'a str> {
    let start = text.trim_start();
    let end = start.find(char::is_whitespace).unwrap_or(start.len());
    let (first, rest) = start.split_at(end);
    *text = rest;
    (!first.is_empty()).then_some(first)
}

/// The sections of a file with their records, all syntax checked, and how many records there are.
pub(super) fn sections_of<'a>(file: &'a File<'a>, mut room: usize) -> Result<(Vec<Section<'a>>, usize), String> {
    let before = room;
    let mut sections: Vec<Section<'a>> = Vec::new();
    let mut comment = None;
    for (i, raw) in file.text.lines().enumerate() {
        let (line, text) = (i + 1, content(raw));
        let fail = |what: String| file.fault(line, what);
        if text.split_whitespace().nth(MAX_COLUMNS).is_some() {
            return Err(fail(format!("more than {MAX_COLUMNS} columns")));
        }
        if let Some((minutes, columns)) = labels(text) {
            if sections.len() == MAX_SECTIONS {
                return Err(fail(format!("more than {MAX_SECTIONS} header lines")));
            }
            let (kind, frequencies) = header(columns, &file.name).map_err(fail)?;
            let kind = kind.or(comment.take()).or_else(|| Kind::from_name(&file.name));
            sections.push(Section { file, line, kind, minutes, frequencies, large: false, records: Vec::new() });
        } else if text.starts_with('#') {
            comment = Kind::from_comment(text).or(comment);
        } else if !text.is_empty() {
            let Some(section) = sections.last_mut() else {
                return Err(fail(format!("{} stands before the first header line", quoted(text))));
            };
            room = room.checked_sub(1).ok_or_else(|| fail(format!("more than {MAX_RECORDS} records")))?;
            let mut rest = text;
            let time = time(&mut rest, section.minutes).map_err(fail)?;
            let record = Record { line, time, text: rest };
            for (_, value) in section.bands(&record)? {
                section.large |= value.is_some_and(|v| v > 1.5 && !section.is_missing(v));
            }
            section.records.push(record);
        }
    }
    Ok((sections, before - room))
}

/// What a header's columns say: the kind (realtime) or the frequencies (archive).
fn header(columns: &str, name: &str) -> Result<(Option<Kind>, Option<Vec<f64>>), String> {
    let Some(first) = columns.split_whitespace().next() else {
        return Err("the header names neither frequencies nor values".into());
    };
    if number(first).is_some() {
        let mut frequencies = Vec::new();
        for column in columns.split_whitespace() {
            let f = number(column).ok_or_else(|| format!("the frequency {} is not a number", quoted(column)))?;
            frequencies.push(frequency(f, frequencies.last().copied())?);
            if frequencies.len() > MAX_BANDS {
                return Err(format!("more than {MAX_BANDS} bands of frequency"));
            }
        }
        return Ok((None, Some(frequencies)));
    }
    match Kind::from_column(first) {
        // Some quote the header of .swr2 files with the names of r1.
        Some(Kind::R1) if name.to_ascii_lowercase().ends_with(".swr2") => Ok((Some(Kind::R2), None)),
        Some(kind) => Ok((Some(kind), None)),
        None => Err(format!("the column {} does not belong in a spectral file", quoted(first))),
    }
}

/// Takes the time off a record.
fn time(rest: &mut &str, minutes: bool) -> Result<Time, String> {
    let limits = [("year", 0, 9999), ("month", 1, 12), ("day", 1, 31), ("hour", 0, 23), ("minute", 0, 59)];
    let mut time = [0; 5];
    for (slot, (name, low, high)) in time.iter_mut().zip(limits).take(if minutes { 5 } else { 4 }) {
        let Some(text) = word(rest) else { return Err(format!("the record ends before its {name}")) };
        let value = text.parse::<u16>().ok().filter(|v| (low..=high).contains(v));
        *slot = value.ok_or_else(|| format!("{} is not a valid {name}", quoted(text)))?;
    }
    // Two digits until 1998.
    time[0] += if time[0] < 50 {
        2000
    } else if time[0] < 100 {
        1900
    } else {
        0
    };
    Ok(Time(time))
}

impl Section<'_> {
    /// Nines stand for what is missing; a direction of 99 degrees is one.
    fn is_missing(&self, v: f64) -> bool {
        let nines = match self.kind {
            Some(Kind::Alpha1 | Kind::Alpha2) => false,
            Some(Kind::R1 | Kind::R2) => v == 99.0,
            Some(Kind::Density) | None => v == 99.0 && self.frequencies.is_some(),
        };
        nines || v == 999.0 || v == 9999.0
    }

    /// The values of a record.
    pub(super) fn bands(&self, record: &Record<'_>) -> Result<Vec<Band>, String> {
        let fail = |what: String| self.file.fault(record.line, what);
        let value = |text: &str| match number(text) {
            Some(v) => Ok(Some(v).filter(|&v| !self.is_missing(v))),
            None if text == "MM" => Ok(None),
            None => Err(fail(format!("the value {} is not a number", quoted(text)))),
        };
        let mut words = record.text.split_whitespace().peekable();
        let mut bands = Vec::new();
        if let Some(frequencies) = &self.frequencies {
            let n = words.clone().count();
            if n != frequencies.len() {
                let line = self.line;
                return Err(fail(format!("{n} values for the {} frequencies of line {line}", frequencies.len())));
            }
            for (text, f) in words.zip(frequencies) {
                bands.push((*f, value(text)?));
            }
            return Ok(bands);
        }
        // The separation frequency, which only files of density have, has no frequency after it.
        let mut ahead = words.clone();
        if let (Some(first), second) = (ahead.next(), ahead.next())
            && second.is_none_or(|s| !s.starts_with('('))
        {
            value(first)?;
            words.next();
        }
        while let Some(text) = words.next() {
            let v = value(text)?;
            let Some(f) = words.next().and_then(|f| f.strip_prefix('(')?.strip_suffix(')')).and_then(number) else {
                return Err(fail(format!("after {} a frequency in parentheses is missing", quoted(text))));
            };
            let before = bands.last().map(|b: &Band| b.0);
            bands.push((frequency(f, before).map_err(fail)?, v));
            if bands.len() > MAX_BANDS {
                return Err(fail(format!("more than {MAX_BANDS} bands of frequency")));
            }
        }
        if bands.is_empty() { Err(fail("the record has no values".into())) } else { Ok(bands) }
    }
}

impl Section<'_> {
    /// The values of a directional record in degrees or from 0 to 1, their range checked.
    pub(super) fn moments(&self, record: &Record<'_>, hundredths: bool) -> Result<Vec<Band>, String> {
        let mut bands = self.bands(record)?;
        let angle = matches!(self.kind, Some(Kind::Alpha1 | Kind::Alpha2));
        let scale = if !angle && hundredths && self.frequencies.is_some() { 0.01 } else { 1.0 };
        for v in bands.iter_mut().filter_map(|b| b.1.as_mut()) {
            let (given, high) = (*v, if angle { 360.0 } else { 1.5 });
            *v *= scale;
            if !(0.0..=high).contains(v) {
                let name = self.kind.map_or("value", Kind::name);
                return Err(self.file.fault(record.line, format!("{name} of {} is not possible", shown(given))));
            }
        }
        Ok(bands)
    }
}
