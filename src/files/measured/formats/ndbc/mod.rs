//! NDBC files: one spectrum from the newest complete variance density and its directions.

mod sections;

use crate::files::measured::direction::{Direction, filled};
use crate::files::measured::spectrum::MeasuredSpectrum;
use crate::files::measured::text::{TextFile, content};
use sections::{BandValue, MAX_RECORDS, Record, RecordTime, Section, SectionKind, column_names, read_sections};
use std::cmp::Reverse;

/// Largest difference between frequencies of the same band, Hz: realtime files write .0325 as 0.033.
const SAME_BAND_HZ: f64 = 6e-4;

const DIRECTIONAL: [SectionKind; 4] = [SectionKind::Alpha1, SectionKind::Alpha2, SectionKind::R1, SectionKind::R2];

/// Whether a file has a header line of the NDBC.
pub(super) fn recognises(file: &TextFile<'_>) -> bool {
    file.text.lines().any(|line| column_names(content(line)).is_some())
}

/// Reads all files as one spectrum.
pub(super) fn read(files: &[TextFile<'_>]) -> Result<(MeasuredSpectrum, Vec<String>), String> {
    let (mut sections, mut notices, mut records_left) = (Vec::new(), Vec::new(), MAX_RECORDS);
    for file in files {
        sections.extend(read_sections(file, &mut records_left)?);
    }
    settle_kinds(&mut sections, &mut notices)?;
    // One scale for all archive sections, because the moments of one record may all be small.
    let hundredths = sections.iter().any(Section::is_in_hundredths);

    let (section, record, bands) = newest_density(&sections, &mut notices)?;
    let directions = directions(&sections, record.time, &bands, hundredths, &mut notices)?;
    let spectrum = MeasuredSpectrum::new(&bands, directions.as_deref());
    let mut spectrum = spectrum.map_err(|what| section.file.message_at(record.line, what))?;
    spectrum.set_title(&format!("{}, {}", section.file.name, record.time));
    Ok((spectrum, notices))
}

/// Takes the only section of unknown kind as the variance density if no other section is.
fn settle_kinds(sections: &mut [Section<'_>], notices: &mut Vec<String>) -> Result<(), String> {
    let has_density = sections.iter().any(|s| s.kind == Some(SectionKind::Density));
    let unknown = sections.iter().filter(|s| s.kind.is_none()).count();
    let Some(section) = sections.iter_mut().find(|s| s.kind.is_none()) else { return Ok(()) };
    if unknown > 1 || has_density {
        let what = "neither the file name nor a comment says what this section holds: \
                    put a comment such as \"# alpha1\" before the header";
        return Err(section.file.message_at(section.line, what));
    }
    section.kind = Some(SectionKind::Density);
    notices.push(section.file.message("the file does not say what it holds: it is read as variance density"));
    Ok(())
}

/// The record of a kind and time. A second one is an error: two buoys, or a file whose kind was guessed wrongly.
fn record_at<'s, 'a>(
    sections: &'s [Section<'a>],
    kind: SectionKind,
    time: RecordTime,
) -> Result<Option<(&'s Section<'a>, &'s Record<'a>)>, String> {
    let in_section = |s: &'s Section<'a>| s.records.iter().find(|r| r.time == time).map(|r| (s, r));
    let mut found = sections.iter().filter(|s| s.kind == Some(kind)).filter_map(in_section);
    let first = found.next();
    if let (Some((section, record)), Some((other, second))) = (first, found.next()) {
        let (name, file, line) = (kind.name(), &section.file.name, record.line);
        let what = format!("{name} of {time} is already in {file}, line {line}: remove one of the two records");
        return Err(other.file.message_at(second.line, what));
    }
    Ok(first)
}

/// A section, a record of it, and its bands (frequency in Hz, variance density in m^2/Hz).
type DensityRecord<'s, 'a> = (&'s Section<'a>, &'s Record<'a>, Vec<(f64, f64)>);

/// The newest record whose densities are all present and not all zero.
fn newest_density<'s, 'a>(
    sections: &'s [Section<'a>],
    notices: &mut Vec<String>,
) -> Result<DensityRecord<'s, 'a>, String> {
    let densities = sections.iter().filter(|s| s.kind == Some(SectionKind::Density));
    let mut records: Vec<_> = densities.flat_map(|s| s.records.iter().map(move |r| (s, r))).collect();
    records.sort_by_key(|(_, record)| Reverse(record.time));
    let Some(newest) = records.first().map(|(_, record)| record.time) else {
        return Err("the files hold no variance density: \
                    add the buoy's raw spectral wave data from the NDBC (.data_spec)"
            .into());
    };
    for (section, record) in records {
        let bands: Option<Vec<(f64, f64)>> = section.bands(record)?.into_iter().map(|(f, v)| Some((f, v?))).collect();
        let Some(bands) = bands.filter(|b| b.iter().any(|b| b.1 != 0.0)) else { continue };
        record_at(sections, SectionKind::Density, record.time)?;
        if newest != record.time {
            let time = record.time;
            let what = format!("the newest record ({newest}) has no complete variance density: {time} is used");
            notices.push(section.file.message(what));
        }
        return Ok((section, record, bands));
    }
    Err("no record has a complete variance density with waves in it: choose other files of the buoy".into())
}

/// The directions at a time in the bands of the variance density: all four parameters in every band, or none.
fn directions(
    sections: &[Section<'_>],
    time: RecordTime,
    bands: &[(f64, f64)],
    hundredths: bool,
    notices: &mut Vec<String>,
) -> Result<Option<Vec<Direction>>, String> {
    if sections.iter().all(|s| s.kind == Some(SectionKind::Density)) {
        return Ok(None);
    }
    let (mut parameters, mut missing) = (Vec::new(), Vec::new());
    for kind in DIRECTIONAL {
        match record_at(sections, kind, time)? {
            Some((section, record)) => parameters.push(section.directional(record, hundredths)?),
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
            let nearest = values.iter().min_by(|a, b| (a.0 - f).abs().total_cmp(&(b.0 - f).abs()))?;
            nearest.1.filter(|_| (nearest.0 - f).abs() <= SAME_BAND_HZ)
        };
        Some(Direction { alpha1_deg: value(alpha1)?, alpha2_deg: value(alpha2)?, r1: value(r1)?, r2: value(r2)? })
    };
    let directions: Vec<_> = bands.iter().map(in_band).collect();
    Ok(filled(bands, &directions, notices))
}
