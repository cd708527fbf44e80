//! Reads NDBC files (US National Data Buoy Center): a spectrum from each complete variance density and the directions of
//! the same time.

mod sections;

use crate::files::measured::direction::{DirectionalParameters, fill_missing_directions, nearest_entry};
use crate::files::measured::list::{self, DefaultSpectrum, SpectrumList, SpectrumRecord};
use crate::files::measured::spectrum::MeasuredSpectrum;
use crate::files::measured::text::{TextFile, printable_prefix, trimmed_line};
use sections::{BandValue, MAX_RECORDS, Record, Section, SectionKind, column_names, read_sections};
use std::cmp::Reverse;
use std::collections::{HashMap, HashSet};

/// Largest difference between two frequencies that count as the same band, Hz: realtime files write .0325 as 0.033.
const SAME_BAND_TOLERANCE_HZ: f64 = 6e-4;

const DIRECTIONAL_KINDS: [SectionKind; 4] =
    [SectionKind::Alpha1, SectionKind::Alpha2, SectionKind::R1, SectionKind::R2];

/// A record and the section that it belongs to.
type Place<'s, 'a> = (&'s Section<'a>, &'s Record<'a>);

/// Whether a file has a header line of the NDBC (US National Data Buoy Center).
pub(super) fn is_ndbc_file(file: &TextFile<'_>) -> bool {
    file.text.lines().any(|line| column_names(trimmed_line(line)).is_some())
}

/// Reads the spectra of all times from all NDBC files together, in the order of time. The default is the newest one with
/// a complete variance density; an older one that cannot be read is left out.
pub(super) fn read(files: &[TextFile<'_>]) -> Result<SpectrumList, String> {
    let (mut sections, mut notices, mut records_left) = (Vec::new(), Vec::new(), MAX_RECORDS);
    for file in files {
        sections.extend(read_sections(file, &mut records_left)?);
    }
    assign_unknown_kind(&mut sections, &mut notices)?;
    let buoy = Buoy::new(&sections);

    let mut densities = densities_newest_first(&sections);
    let Some(newest) = densities.first().map(|(_, record)| record.time.as_str()) else {
        let what = "no variance density: add the buoy's raw spectral wave data from the NDBC (.data_spec)";
        return Err(files_error(&sections, what));
    };
    let beyond = densities.len().saturating_sub(list::MAX_RECORDS);
    densities.truncate(list::MAX_RECORDS);

    let (mut records, mut name, mut left_out) = (Vec::new(), String::new(), 0);
    for (section, record) in densities {
        let Some(bands) = complete_bands(section, record)? else {
            left_out += usize::from(!records.is_empty());
            continue;
        };
        match buoy.spectrum(section, record, &bands) {
            Ok(mut spectrum) => {
                if records.is_empty() {
                    name.clone_from(&section.file.name);
                    if record.time != newest {
                        let time = &record.time;
                        let what =
                            format!("the newest record ({newest}) has no complete variance density: {time} is used");
                        spectrum.notices.insert(0, section.file.file_error(what));
                    }
                }
                records.push(spectrum);
            }
            Err(what) if records.is_empty() => return Err(what),
            Err(_) => left_out += 1,
        }
    }
    if records.is_empty() {
        let what = "no record has a complete variance density with waves in it: choose other files of the buoy";
        return Err(files_error(&sections, what));
    }
    if left_out > 0 {
        notices.push(format!("{name}: older records that are left out because they are incomplete: {left_out}"));
    }
    if beyond > 0 {
        notices.push(format!("{name}: oldest records that are left out because there are too many: {beyond}"));
    }
    records.reverse();
    let default_index = records.len() - 1;
    Ok(SpectrumList { name, records, default_index, default_choice: DefaultSpectrum::Newest, notices })
}

/// If a section (header and records) does not say which quantity it holds, assumes variance density, and adds a message
/// to `notices`. It is an error if several sections do not say it, or if another section holds variance density.
fn assign_unknown_kind(sections: &mut [Section<'_>], notices: &mut Vec<String>) -> Result<(), String> {
    let has_density = sections.iter().any(|s| s.kind == Some(SectionKind::Density));
    let mut unknown = sections.iter_mut().filter(|s| s.kind.is_none());
    let Some(section) = unknown.next() else { return Ok(()) };
    if has_density || unknown.next().is_some() {
        let what = "neither the file name nor a comment says what this section holds: \
                    put a comment such as \"# alpha1\" before the header";
        return Err(section.file.line_error(section.line, what));
    }
    section.kind = Some(SectionKind::Density);
    notices.push(section.file.file_error("the file does not say what it holds: it is read as variance density"));
    Ok(())
}

/// All records of variance density, each after its section, the newest first.
fn densities_newest_first<'s, 'a>(sections: &'s [Section<'a>]) -> Vec<Place<'s, 'a>> {
    let densities = sections.iter().filter(|s| s.kind == Some(SectionKind::Density));
    let mut records: Vec<_> = densities.flat_map(|s| s.records.iter().map(move |r| (s, r))).collect();
    records.sort_by_key(|(_, record)| Reverse(&record.time));
    records
}

/// The bands of a record of variance density (frequency in Hz, variance density in m^2/Hz); None if one of them is
/// missing or all are zero.
fn complete_bands(section: &Section<'_>, record: &Record<'_>) -> Result<Option<Vec<(f64, f64)>>, String> {
    let bands: Option<Vec<_>> = section.band_values(record)?.into_iter().map(|(f, v)| Some((f, v?))).collect();
    Ok(bands.filter(|bands| bands.iter().any(|band| band.1 != 0.0)))
}

/// Makes an error message about the files of all sections together; `what` says what is wrong with them.
fn files_error(sections: &[Section<'_>], what: &str) -> String {
    let mut names: Vec<_> = sections.iter().map(|s| s.file.name.as_str()).collect();
    names.dedup();
    format!("{}: {what}", names.join(", "))
}

/// The records of a buoy by quantity and time.
struct Buoy<'s, 'a> {
    /// For each quantity and time such as `2026-11-21 06:00 UTC` the first record, and another one if there is one.
    records: HashMap<(SectionKind, &'s str), (Place<'s, 'a>, Option<Place<'s, 'a>>)>,
    /// Whether any section holds a directional parameter.
    has_directions: bool,
    /// Whether the archive sections of r1 and r2 are in hundredths. They share one scale, because the values of one
    /// record may all be small.
    hundredths: bool,
}

impl<'s, 'a> Buoy<'s, 'a> {
    fn new(sections: &'s [Section<'a>]) -> Self {
        let mut records = HashMap::new();
        for section in sections {
            let Some(kind) = section.kind else { continue };
            let mut times = HashSet::new();
            for record in &section.records {
                // If a section repeats a time, its first record counts.
                if times.insert(record.time.as_str()) {
                    let place = (section, record);
                    let entry = records.entry((kind, record.time.as_str()));
                    entry
                        .and_modify(|places: &mut (_, Option<_>)| places.1 = places.1.or(Some(place)))
                        .or_insert((place, None));
                }
            }
        }
        Self {
            records,
            has_directions: sections.iter().any(|s| s.kind != Some(SectionKind::Density)),
            hundredths: sections.iter().any(Section::is_in_hundredths),
        }
    }

    /// The record of a quantity at a time; None without one. Records of two sections are an error: they are from two
    /// buoys, or the kind of a file was guessed wrongly.
    fn record(&self, kind: SectionKind, time: &str) -> Result<Option<Place<'s, 'a>>, String> {
        let Some(&((section, record), second)) = self.records.get(&(kind, time)) else { return Ok(None) };
        if let Some((other, second)) = second {
            let (name, file, line) = (kind.name(), &section.file.name, record.line);
            let what = format!("{name} of {time} is already in {file}, line {line}: remove one of the two records");
            return Err(other.file.line_error(second.line, what));
        }
        Ok(Some((section, record)))
    }

    /// The spectrum of a record of variance density with the given bands, and the directions of the same time.
    fn spectrum(
        &self,
        section: &Section<'_>,
        record: &Record<'_>,
        bands: &[(f64, f64)],
    ) -> Result<SpectrumRecord, String> {
        self.record(SectionKind::Density, &record.time)?;
        let mut notices = Vec::new();
        let directions = self.directions(&record.time, bands, &mut notices)?;
        let spectrum = MeasuredSpectrum::new(bands, directions.as_deref());
        let spectrum = spectrum.map_err(|what| section.file.line_error(record.line, what))?;
        Ok(SpectrumRecord { label: printable_prefix(&record.time, 60), spectrum, notices })
    }

    /// Directional parameters of each of `bands` (the variance density) at a given time. Returns None if one of the four
    /// parameters has no record at this time, or too few bands have all four.
    fn directions(
        &self,
        time: &str,
        bands: &[(f64, f64)],
        notices: &mut Vec<String>,
    ) -> Result<Option<Vec<DirectionalParameters>>, String> {
        if !self.has_directions {
            return Ok(None);
        }
        let (mut parameters, mut missing) = (Vec::new(), Vec::new());
        for kind in DIRECTIONAL_KINDS {
            match self.record(kind, time)? {
                Some((section, record)) => parameters.push(section.directional_values(record, self.hundredths)?),
                None => missing.push(kind.name()),
            }
        }
        let [alpha1, alpha2, r1, r2] = &parameters[..] else {
            let missing = missing.join(", ");
            notices.push(format!("there is no {missing} of {time}: the spectrum is used without directions"));
            return Ok(None);
        };
        let in_band = |&(f, _): &(f64, f64)| {
            let value = |values: &[BandValue]| {
                nearest_entry(values, f).filter(|v| (v.0 - f).abs() <= SAME_BAND_TOLERANCE_HZ)?.1
            };
            Some(DirectionalParameters {
                alpha1_deg: value(alpha1)?,
                alpha2_deg: value(alpha2)?,
                r1: value(r1)?,
                r2: value(r2)?,
            })
        };
        let directions: Vec<_> = bands.iter().map(in_band).collect();
        Ok(fill_missing_directions(bands, &directions, notices))
    }
}
