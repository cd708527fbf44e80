//! Reads point spectra of the wave model WAVEWATCH III as text (`ww3_outp`, spectra as a transfer file).
//!
//! A line `'WAVEWATCH III SPECTRA' NF ND NP 'name'` gives the numbers of frequencies, directions and points. Frequencies
//! (Hz) and directions follow: bearings, in radians clockwise from north, towards which waves travel. Each time is a line
//! with date and hour, followed for each point by a line with its name, place, depth, wind and current, and by the
//! densities (m^2/Hz/rad): all frequencies of the first direction, then those of the next one.

use super::grid::{Grid, Records};
use super::lines::Lines;
use crate::files::measured::directional::MAX_FILE_DIRECTIONS;
use crate::files::measured::list::{MAX_RECORDS, SpectrumList};
use crate::files::measured::spectrum::MAX_BANDS;
use crate::files::measured::text::{TextFile, quoted_excerpt};

const TITLE: &str = "WAVEWATCH III SPECTRA";

/// Whether the first line says that this is a file of point spectra.
pub(super) fn is_ww3_file(file: &TextFile<'_>) -> bool {
    let start = file.text.trim_start_matches('\u{feff}').trim_start();
    start.strip_prefix('\'').is_some_and(|rest| rest.starts_with(TITLE))
}

/// Reads all spectra of a file.
pub(super) fn read(file: &TextFile<'_>) -> Result<SpectrumList, String> {
    let mut lines = Lines::new(file, None);
    let first = lines.expect_line("the first line")?;
    let sizes = first.splitn(3, '\'').nth(2).unwrap_or_default();
    let numbers: Vec<usize> = sizes.split_whitespace().take(3).map_while(|word| word.parse().ok()).collect();
    let [frequency_count, direction_count, point_count] = numbers[..] else {
        return Err(lines.error("the numbers of frequencies, directions and points are missing"));
    };
    for (count, most, what) in [
        (frequency_count, MAX_BANDS, "frequencies"),
        (direction_count, MAX_FILE_DIRECTIONS, "directions"),
        (point_count, MAX_RECORDS, "points"),
    ] {
        if !(1..=most).contains(&count) {
            return Err(lines.error(format!("{count} {what}, but 1 to {most} can be read")));
        }
    }
    let (mut frequencies_hz, mut travel_rad) = (Vec::new(), Vec::new());
    lines.numbers(frequency_count, "the frequencies", &mut frequencies_hz)?;
    lines.numbers(direction_count, "the directions", &mut travel_rad)?;
    let from_deg: Vec<f64> = travel_rad.iter().map(|rad| rad.to_degrees() + 180.0).collect();
    let grid = Grid::new(frequencies_hz, &from_deg).map_err(|what| lines.error(what))?;
    let (mut records, mut transposed) = (Records::default(), vec![0.0; grid.cell_count()]);
    while let Some(time) = lines.next_line() {
        if !time.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(lines.error(format!("{} is no date", quoted_excerpt(time))));
        }
        for _ in 0..point_count {
            records.announce(grid.cell_count()).map_err(|what| lines.error(what))?;
            let point = lines.expect_line("a point")?;
            let mut parts = point.splitn(3, '\'');
            let (Some(""), Some(name), Some(_)) = (parts.next(), parts.next(), parts.next()) else {
                return Err(lines.error(format!("{} is no name of a point in quotation marks", quoted_excerpt(point))));
            };
            let mut densities = Vec::with_capacity(grid.cell_count());
            lines.numbers(grid.cell_count(), "the densities", &mut densities)?;
            for (i, cell) in transposed.iter_mut().enumerate() {
                *cell = densities[i % direction_count * frequency_count + i / direction_count];
            }
            let spectrum = grid.spectrum(&transposed).map_err(|what| lines.error(what))?;
            records.add(&format!("{time}, {}", name.trim()), spectrum);
        }
    }
    SpectrumList::new(&file.name, records.records, records.skipped)
}
