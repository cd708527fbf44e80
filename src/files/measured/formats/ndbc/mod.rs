//! Reads NDBC files (US National Data Buoy Center): one spectrum from the newest complete variance density and the
//! directions of the same time.

mod sections;

use crate::files::measured::direction::{DirectionalParameters, fill_missing_directions, nearest_entry};
use crate::files::measured::spectrum::{MeasuredSpectrum, SpectrumFile};
use crate::files::measured::text::{TextFile, printable_prefix, trimmed_line};
use sections::{BandValue, MAX_RECORDS, Record, Section, SectionKind, column_names, read_sections};
use std::cmp::Reverse;

/// Largest difference between two frequencies that count as the same band, Hz: realtime files write .0325 as 0.033.
const SAME_BAND_TOLERANCE_HZ: f64 = 6e-4;

const DIRECTIONAL_KINDS: [SectionKind; 4] =
    [SectionKind::Alpha1, SectionKind::Alpha2, SectionKind::R1, SectionKind::R2];

/// Whether a file has a header line of the NDBC (US National Data Buoy Center).
pub(super) fn is_ndbc_file(file: &TextFile<'_>) -> bool {
    file.text.lines().any(|line| column_names(trimmed_line(line)).is_some())
}

/// Reads one spectrum from all NDBC files together: the newest complete variance density, directions of the same time.
pub(super) fn read(files: &[TextFile<'_>]) -> Result<SpectrumFile, String> {
    let (mut sections, mut notices, mut records_left) = (Vec::new(), Vec::new(), MAX_RECORDS);
    for file in files {
        sections.extend(read_sections(file, &mut records_left)?);
    }
    assign_unknown_kind(&mut sections, &mut notices)?;
    // All archive sections share one scale of r1 and r2, because the values of one record may all be small.
    let hundredths = sections.iter().any(Section::is_in_hundredths);

    let (section, record, bands) = newest_density(&sections, &mut notices)?;
    let directions = read_directions_at_time(&sections, &record.time, &bands, hundredths, &mut notices)?;
    let spectrum = MeasuredSpectrum::new(&bands, directions.as_deref());
    let spectrum = spectrum.map_err(|what| section.file.line_error(record.line, what))?;
    let title = printable_prefix(&format!("{}, {}", section.file.name, record.time), 80);
    Ok(SpectrumFile { spectrum, title, notices })
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

/// Returns the record of a quantity (`kind`) at a time such as `2026-11-21 06:00 UTC`, after its section; None without
/// one. A second such record is an error: it is from another buoy, or the kind of its file was guessed wrongly.
fn find_record_at_time<'s, 'a>(
    sections: &'s [Section<'a>],
    kind: SectionKind,
    time: &str,
) -> Result<Option<(&'s Section<'a>, &'s Record<'a>)>, String> {
    let in_section = |s: &'s Section<'a>| s.records.iter().find(|r| r.time == time).map(|r| (s, r));
    let mut found = sections.iter().filter(|s| s.kind == Some(kind)).filter_map(in_section);
    let first = found.next();
    if let (Some((section, record)), Some((other, second))) = (first, found.next()) {
        let (name, file, line) = (kind.name(), &section.file.name, record.line);
        let what = format!("{name} of {time} is already in {file}, line {line}: remove one of the two records");
        return Err(other.file.line_error(second.line, what));
    }
    Ok(first)
}

/// A section of variance density, one record of the section, and the bands of the record (frequency in Hz, variance
/// density in m^2/Hz).
type DensityRecord<'s, 'a> = (&'s Section<'a>, &'s Record<'a>, Vec<(f64, f64)>);

/// Finds the newest record whose variance densities are all present and not all zero. Adds a message to `notices` if a
/// newer record is passed over.
fn newest_density<'s, 'a>(
    sections: &'s [Section<'a>],
    notices: &mut Vec<String>,
) -> Result<DensityRecord<'s, 'a>, String> {
    let densities = sections.iter().filter(|s| s.kind == Some(SectionKind::Density));
    let mut records: Vec<_> = densities.flat_map(|s| s.records.iter().map(move |r| (s, r))).collect();
    records.sort_by_key(|(_, record)| Reverse(&record.time));
    let Some(newest) = records.first().map(|(_, record)| &record.time) else {
        let what = "no variance density: add the buoy's raw spectral wave data from the NDBC (.data_spec)";
        return Err(files_error(sections, what));
    };
    for (section, record) in records {
        let bands: Option<Vec<(f64, f64)>> =
            section.band_values(record)?.into_iter().map(|(f, v)| Some((f, v?))).collect();
        let Some(bands) = bands.filter(|b| b.iter().any(|b| b.1 != 0.0)) else { continue };
        find_record_at_time(sections, SectionKind::Density, &record.time)?;
        let time = &record.time;
        if newest != time {
            let what = format!("the newest record ({newest}) has no complete variance density: {time} is used");
            notices.push(section.file.file_error(what));
        }
        return Ok((section, record, bands));
    }
    let what = "no record has a complete variance density with waves in it: choose other files of the buoy";
    Err(files_error(sections, what))
}

/// Makes an error message about the files of all sections together; `what` says what is wrong with them.
fn files_error(sections: &[Section<'_>], what: &str) -> String {
    let mut names: Vec<_> = sections.iter().map(|s| s.file.name.as_str()).collect();
    names.dedup();
    format!("{}: {what}", names.join(", "))
}

/// Directional parameters of each of `bands` (the variance density) at a given time. Returns None if one of the four
/// parameters has no record at this time, or too few bands have all four.
fn read_directions_at_time(
    sections: &[Section<'_>],
    time: &str,
    bands: &[(f64, f64)],
    hundredths: bool,
    notices: &mut Vec<String>,
) -> Result<Option<Vec<DirectionalParameters>>, String> {
    if sections.iter().all(|s| s.kind == Some(SectionKind::Density)) {
        return Ok(None);
    }
    let (mut parameters, mut missing) = (Vec::new(), Vec::new());
    for kind in DIRECTIONAL_KINDS {
        match find_record_at_time(sections, kind, time)? {
            Some((section, record)) => parameters.push(section.directional_values(record, hundredths)?),
            None => missing.push(kind.name()),
        }
    }
    let [alpha1, alpha2, r1, r2] = &parameters[..] else {
        let missing = missing.join(", ");
        notices.push(format!("there is no {missing} of {time}: the spectrum is used without directions"));
        return Ok(None);
    };
    let in_band = |&(f, _): &(f64, f64)| {
        let value =
            |values: &[BandValue]| nearest_entry(values, f).filter(|v| (v.0 - f).abs() <= SAME_BAND_TOLERANCE_HZ)?.1;
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
