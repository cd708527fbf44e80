//! Reads spectral files of the wave model SWAN (`.spc`, `.sp1`, `.sp2`; SWAN user manual, appendix "Spectrum files").
//!
//! A header names places, frequencies, directions (of 2D spectra) and quantities. Then each time has one block for each
//! place: `FACTOR` with whole numbers, `ZERO`, or `NODATA` (2D), or `LOCATION` with a table (1D).

use super::grid::{Grid, Records};
use super::lines::{Lines, number};
use crate::files::measured::direction::{DirectionalParameters, fill_missing_directions};
use crate::files::measured::directional::MAX_FILE_DIRECTIONS;
use crate::files::measured::list::{MAX_RECORDS, SpectrumList};
use crate::files::measured::spectrum::{MAX_BANDS, MeasuredSpectrum};
use crate::files::measured::text::{MAX_COLUMNS, TextFile, quoted_excerpt};

/// Energy per variance, J/m^4, with SWAN's density of water and gravity: 1025 kg/m^3 and 9.81 m/s^2.
const ENERGY_PER_VARIANCE: f64 = 1025.0 * 9.81;
/// Largest number of quantities of a 1D file.
const MAX_QUANTITIES: usize = 32;

/// A quantity of a file: its name and unit in the words of the file, and the number that stands for a missing value.
struct Quantity<'a> {
    name: &'a str,
    unit: &'a str,
    exception: f64,
}

/// The header of a SWAN spectral file: which times, places, frequencies and directions the spectra have.
#[derive(Default)]
struct Header<'a> {
    has_times: bool,
    places: Vec<String>,
    frequencies_hz: Vec<f64>,
    /// Bearings that waves come from, degrees clockwise from north; empty for 1D spectra.
    from_deg: Vec<f64>,
    quantities: Vec<Quantity<'a>>,
}

/// Whether the first line says that this is a spectral file of SWAN.
pub(super) fn is_swan_file(file: &TextFile<'_>) -> bool {
    let mut words = file.text.trim_start_matches('\u{feff}').split_whitespace();
    words.next() == Some("SWAN") && words.next().is_some_and(|version| version.parse::<u32>().is_ok())
}

/// Reads all spectra of a file.
pub(super) fn read(file: &TextFile<'_>) -> Result<SpectrumList, String> {
    let mut lines = Lines::new(file, Some('$'));
    let header = read_header(&mut lines)?;
    let mut records = Records::default();
    let is_2d = !header.from_deg.is_empty();
    let grid = is_2d.then(|| Grid::new(header.frequencies_hz.clone(), &header.from_deg)).transpose();
    let grid = grid.map_err(|what| lines.error(what))?;
    while let Some(line) = lines.next_line() {
        // A comment may follow the time after some spaces.
        let time = if header.has_times { line.split("  ").next().unwrap_or_default() } else { "" };
        if !header.has_times {
            lines.push_back(line);
        }
        for place in &header.places {
            let label = [time, place].into_iter().filter(|s| !s.is_empty()).collect::<Vec<_>>().join(", ");
            let columns = if is_2d { header.from_deg.len() } else { header.quantities.len() };
            records.announce(header.frequencies_hz.len() * columns).map_err(|what| lines.error(what))?;
            let spectrum = match &grid {
                Some(grid) => read_2d(&mut lines, grid, &header)?,
                None => read_1d(&mut lines, &header)?,
            };
            records.add(&label, spectrum);
        }
        if !header.has_times && lines.next_line().is_some() {
            return Err(lines.error("there are more spectra than the header names"));
        }
    }
    SpectrumList::new(&file.name, records.records, records.skipped)
}

fn read_header<'a>(lines: &mut Lines<'a>) -> Result<Header<'a>, String> {
    let mut header = Header::default();
    lines.expect_line("the header")?;
    loop {
        let line = lines.expect_line("the line QUANT")?;
        let keyword = line.split_whitespace().next().unwrap_or_default();
        match keyword {
            "TIME" => {
                header.has_times = true;
                lines.count("the code of the times", 99)?;
            }
            "LOCATIONS" | "LONLAT" => {
                let count = lines.count("the number of places", MAX_RECORDS)?;
                for _ in 0..count {
                    let line = lines.expect_line("a place")?;
                    let at: Vec<&str> = line.split_whitespace().take(2).collect();
                    let [x, y] = at[..] else { return Err(lines.error("a place is two numbers")) };
                    if number(x).is_none() || number(y).is_none() {
                        return Err(lines.error("a place is two numbers"));
                    }
                    header.places.push(format!("{x} {y}"));
                }
            }
            "AFREQ" | "RFREQ" => {
                let count = lines.count("the number of frequencies", MAX_BANDS)?;
                header.frequencies_hz.clear();
                lines.numbers(count, "the frequencies", &mut header.frequencies_hz)?;
            }
            "NDIR" | "CDIR" => {
                let count = lines.count("the number of directions", MAX_FILE_DIRECTIONS)?;
                header.from_deg.clear();
                lines.numbers(count, "the directions", &mut header.from_deg)?;
                if keyword == "CDIR" {
                    header.from_deg.iter_mut().for_each(|d| *d = from_cartesian_deg(*d));
                }
            }
            "QUANT" => {
                let count = lines.count("the number of quantities", MAX_QUANTITIES)?;
                for _ in 0..count {
                    header.quantities.push(read_quantity(lines)?);
                }
                break;
            }
            _ => return Err(lines.error(format!("{} is no line of a SWAN header", quoted_excerpt(keyword)))),
        }
    }
    if header.places.is_empty() || header.frequencies_hz.is_empty() {
        return Err(lines.error("the header names no place (LOCATIONS, LONLAT) or no frequencies (AFREQ, RFREQ)"));
    }
    Ok(header)
}

fn read_quantity<'a>(lines: &mut Lines<'a>) -> Result<Quantity<'a>, String> {
    let word = |line: &'a str| line.split_whitespace().next().unwrap_or_default();
    let name = word(lines.expect_line("a quantity")?);
    let unit = word(lines.expect_line("a unit")?);
    let exception = word(lines.expect_line("an exception value")?);
    let exception = number(exception)
        .ok_or_else(|| lines.error(format!("the exception value {} is not a number", quoted_excerpt(exception))))?;
    Ok(Quantity { name, unit, exception })
}

/// Factor that turns a density of this quantity into m^2/Hz; an error if it is no density.
fn density_factor(quantity: &Quantity<'_>, lines: &Lines<'_>) -> Result<f64, String> {
    let is_energy = quantity.unit.to_ascii_uppercase().starts_with('J');
    match quantity.name.to_ascii_lowercase().as_str() {
        "vadens" | "endens" => Ok(if is_energy { 1.0 / ENERGY_PER_VARIANCE } else { 1.0 }),
        _ => Err(lines.error(format!("{} is neither VaDens nor EnDens", quoted_excerpt(quantity.name)))),
    }
}

/// Reads the densities of one time and place: `FACTOR` with a table, `ZERO`, or `NODATA`.
fn read_2d(lines: &mut Lines<'_>, grid: &Grid, header: &Header<'_>) -> Result<Option<MeasuredSpectrum>, String> {
    let line = lines.expect_line("a spectrum")?;
    let keyword = line.split_whitespace().next().unwrap_or_default();
    match keyword {
        "ZERO" | "NODATA" => return Ok(None),
        "FACTOR" => {}
        _ => return Err(lines.error(format!("{} is none of FACTOR, ZERO and NODATA", quoted_excerpt(keyword)))),
    }
    // The factor stands in the next line, in some files in the same one.
    let factor = line.split_whitespace().nth(1).map_or_else(|| lines.expect_line("a factor"), Ok)?;
    let factor = number(factor.split_whitespace().next().unwrap_or_default())
        .ok_or_else(|| lines.error(format!("the factor {} is not a number", quoted_excerpt(factor))))?;
    let [quantity] = &header.quantities[..] else {
        return Err(lines.error("a file with directions holds one quantity, VaDens or EnDens"));
    };
    // Per degree in the file, per radian in the program.
    let scale = factor * density_factor(quantity, lines)?.to_degrees();
    let mut densities = Vec::with_capacity(grid.cell_count());
    lines.numbers(grid.cell_count(), "the densities", &mut densities)?;
    for density in &mut densities {
        let is_missing = *density == quantity.exception;
        *density = if is_missing { 0.0 } else { *density * scale };
    }
    grid.spectrum(&densities).map_err(|what| lines.error(what))
}

/// Reads the table of one time and place: a line for each frequency, or `NODATA`.
fn read_1d(lines: &mut Lines<'_>, header: &Header<'_>) -> Result<Option<MeasuredSpectrum>, String> {
    let line = lines.expect_line("a spectrum")?;
    match line.split_whitespace().next().unwrap_or_default() {
        "ZERO" | "NODATA" => return Ok(None),
        "LOCATION" => {}
        word => return Err(lines.error(format!("{} is none of LOCATION, ZERO and NODATA", quoted_excerpt(word)))),
    }
    let named =
        |names: &[&str]| header.quantities.iter().position(|q| names.contains(&q.name.to_ascii_lowercase().as_str()));
    let Some(density) = named(&["vadens", "endens"]) else { return Err(lines.error("there is no VaDens or EnDens")) };
    let scale = density_factor(&header.quantities[density], lines)?;
    let (direction, spread) = (named(&["ndir", "cdir"]), named(&["dsprdegr", "dsprd"]));
    let (mut bands, mut directions) = (Vec::new(), Vec::new());
    for &f in &header.frequencies_hz {
        let mut row = Vec::with_capacity(header.quantities.len().min(MAX_COLUMNS));
        lines.numbers(header.quantities.len(), "the quantities", &mut row)?;
        let value = |i: usize| Some(row[i]).filter(|v| *v != header.quantities[i].exception);
        bands.push((f, value(density).unwrap_or(0.0) * scale));
        directions.push(direction.zip(spread).and_then(|(direction, spread)| {
            let mean_deg = value(direction)?;
            let is_cartesian = header.quantities[direction].name.eq_ignore_ascii_case("cdir");
            let from_deg = if is_cartesian { from_cartesian_deg(mean_deg) } else { mean_deg };
            Some(DirectionalParameters::from_spread(from_deg, value(spread)?.clamp(0.0, 180.0)))
        }));
    }
    if bands.iter().all(|b| b.1 == 0.0) {
        return Ok(None);
    }
    let directions = fill_missing_directions(&bands, &directions, &mut Vec::new());
    MeasuredSpectrum::new(&bands, directions.as_deref()).map(Some).map_err(|what| lines.error(what))
}

/// Bearing that waves come from, degrees clockwise from north, for the direction in which they travel, degrees
/// anticlockwise from east.
fn from_cartesian_deg(travel_deg: f64) -> f64 {
    270.0 - travel_deg
}
