//! From the sections of NDBC files to one sea: the newest complete density and its directions.

use super::read::File;
use super::sections::{Band, Kind, MAX_RECORDS, Record, Section, Time, sections_of};
use super::table::filled;
use super::{Direction, Measured};
use std::cmp::Reverse;

/// Largest difference between frequencies that mean the same band, Hz: realtime files write .0325 as 0.033.
const SAME_BAND_HZ: f64 = 6e-4;

const DIRECTIONAL: [Kind; 4] = [Kind::Alpha1, Kind::Alpha2, Kind::R1, Kind::R2];

/// Reads the files as one sea.
pub(super) fn read(files: &[File<'_>]) -> Result<(Measured, Vec<String>), String> {
    let mut notices = Vec::new();
    let mut sections = Vec::new();
    let mut records = 0;
    for file in files {
        let (found, count) = sections_of(file, MAX_RECORDS - records)?;
        sections.extend(found);
        records += count;
    }
    settle_kinds(&mut sections, &mut notices)?;
    // The scale is that of all archive sections: one record's moments may all be small.
    let archive = |s: &&Section<'_>| s.frequencies.is_some();
    let hundredths = sections.iter().filter(archive).any(|s| s.large && matches!(s.kind, Some(Kind::R1 | Kind::R2)));

    let (section, record, bands) = newest_density(&sections, &mut notices)?;
    let directions = directions(&sections, record.time, &bands, hundredths, &mut notices)?;
    let mut sea = Measured::new(&bands, directions.as_deref()).map_err(|what| section.file.fault(record.line, what))?;
    sea.set_title(&format!("{}, {}", section.file.name, record.time));
    Ok((sea, notices))
}

/// An archive section that neither comment nor name explains is the density where nothing else can be.
fn settle_kinds(sections: &mut [Section<'_>], notices: &mut Vec<String>) -> Result<(), String> {
    let densities = sections.iter().filter(|s| s.kind == Some(Kind::Density)).count();
    let unknown = sections.iter().filter(|s| s.kind.is_none()).count();
    for section in sections.iter_mut().filter(|s| s.kind.is_none()) {
        if unknown > 1 || densities > 0 {
            let what = "neither the file's name nor a comment (such as \"# alpha1\") says what follows this header";
            return Err(section.file.fault(section.line, what));
        }
        section.kind = Some(Kind::Density);
        notices.push(section.file.whole("taken as spectral density, which nothing in it says"));
    }
    Ok(())
}

/// The record of a time, and where else the time occurs is an error: two buoys, or two guesses at a file's kind.
fn record_at<'s, 'a>(
    sections: &'s [Section<'a>],
    kind: Kind,
    time: Time,
) -> Result<Option<(&'s Section<'a>, &'s Record<'a>)>, String> {
    let mut found: Option<(&Section<'_>, &Record<'_>)> = None;
    for section in sections.iter().filter(|s| s.kind == Some(kind)) {
        let Some(record) = section.records.iter().find(|r| r.time == time) else { continue };
        if let Some((first, r)) = found {
            let (name, place, line) = (kind.name(), &first.file.name, r.line);
            let what = format!("a second {name} of {time}: the first is in {place}, line {line}");
            return Err(section.file.fault(record.line, what));
        }
        found = Some((section, record));
    }
    Ok(found)
}

/// A section, a record of it and its densities.
type Chosen<'s, 'a> = (&'s Section<'a>, &'s Record<'a>, Vec<(f64, f64)>);

/// The newest record whose densities are all there and not all zero.
fn newest_density<'s, 'a>(sections: &'s [Section<'a>], notices: &mut Vec<String>) -> Result<Chosen<'s, 'a>, String> {
    let mut records: Vec<_> = sections
        .iter()
        .filter(|s| s.kind == Some(Kind::Density))
        .flat_map(|s| s.records.iter().map(move |r| (s, r)))
        .collect();
    records.sort_by_key(|r| Reverse(r.1.time));
    let newest = records.first().map(|r| r.1.time);
    for (section, record) in records {
        let bands = section.bands(record)?;
        let bands: Option<Vec<(f64, f64)>> = bands.into_iter().map(|(f, v)| v.map(|v| (f, v))).collect();
        let Some(bands) = bands.filter(|b| b.iter().any(|b| b.1 != 0.0)) else { continue };
        record_at(sections, Kind::Density, record.time)?;
        if let Some(newest) = newest.filter(|&n| n != record.time) {
            let what =
                format!("the newest record, of {newest}, has no complete density: that of {} is taken", record.time);
            notices.push(section.file.whole(what));
        }
        return Ok((section, record, bands));
    }
    match newest {
        Some(_) => Err("no record has a complete spectral density with waves in it".into()),
        None => {
            Err("the files hold no spectrum: of a buoy at NDBC, the raw spectral wave data is wanted (data_spec)"
                .into())
        }
    }
}

/// The directions of a time in the density's bands: all four moments of all bands, or none.
fn directions(
    sections: &[Section<'_>],
    time: Time,
    bands: &[(f64, f64)],
    hundredths: bool,
    notices: &mut Vec<String>,
) -> Result<Option<Vec<Direction>>, String> {
    if sections.iter().all(|s| s.kind == Some(Kind::Density)) {
        return Ok(None);
    }
    let mut moments: Vec<Vec<Band>> = Vec::new();
    let mut missing = Vec::new();
    for kind in DIRECTIONAL {
        match record_at(sections, kind, time)? {
            Some((section, record)) => moments.push(section.moments(record, hundredths)?),
            None => missing.push(kind.name()),
        }
    }
    if !missing.is_empty() {
        let missing = missing.join(", ");
        notices.push(format!("there is no {missing} of {time}: the sea is taken without directions"));
        return Ok(None);
    }
    let of_band = |&(f, _): &(f64, f64)| {
        let value = |values: &Vec<Band>| {
            let nearest = values.iter().min_by(|a, b| (a.0 - f).abs().total_cmp(&(b.0 - f).abs()))?;
            nearest.1.filter(|_| (nearest.0 - f).abs() <= SAME_BAND_HZ)
        };
        let [alpha1, alpha2, r1, r2] = &moments[..] else { return None };
        Some(Direction { alpha1_deg: value(alpha1)?, alpha2_deg: value(alpha2)?, r1: value(r1)?, r2: value(r2)? })
    };
    let directions: Vec<_> = bands.iter().map(of_band).collect();
    Ok(filled(bands, &directions, notices))
}
