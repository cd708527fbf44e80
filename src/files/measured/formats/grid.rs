//! The grid of a file's densities over frequency and direction, and how it becomes a spectrum.

use crate::files::measured::directional::{DirectionalTable, MAX_FILE_DIRECTIONS, MIN_DIRECTIONS};
use crate::files::measured::list::{MAX_FILE_DENSITIES, MAX_RECORDS, SpectrumRecord};
use crate::files::measured::spectrum::{MAX_BANDS, MIN_BANDS, MeasuredSpectrum, checked_density, checked_frequency};
use crate::files::measured::text::printable_prefix;

/// Largest deviation of directions from even spacing, as a fraction of a step: some files round them to two digits.
const MAX_UNEVENNESS: f64 = 0.2;

/// Frequencies and directions of a file's densities.
#[derive(Debug)]
pub(super) struct Grid {
    frequencies_hz: Vec<f64>,
    directions: Directions,
}

/// Directions of a file, evenly spaced over the circle or over a sector.
#[derive(Debug)]
struct Directions {
    /// For each direction of the whole circle, clockwise from `first_from_deg`: index of the file's direction, and the
    /// fraction of the way to the next one; `None` outside the sector of the file.
    source: Vec<Option<(usize, f64)>>,
    /// Indices of the file's directions in clockwise order.
    order: Vec<usize>,
    first_from_deg: f64,
    /// Angle for which each density of the file stands, rad.
    width_rad: f64,
}

impl Grid {
    /// Makes the grid of frequencies (Hz, ascending) and of the bearings that waves come from (degrees clockwise from
    /// north, in any order).
    ///
    /// # Errors
    /// One sentence, if there are too few or too many, or the directions are not evenly spaced.
    pub fn new(frequencies_hz: Vec<f64>, from_deg: &[f64]) -> Result<Self, String> {
        let count = frequencies_hz.len();
        if !(MIN_BANDS..=MAX_BANDS).contains(&count) {
            return Err(format!("{count} frequencies, but {MIN_BANDS} to {MAX_BANDS} are needed"));
        }
        let mut before = None;
        for &f in &frequencies_hz {
            before = Some(checked_frequency(f, before)?);
        }
        Ok(Self { frequencies_hz, directions: Directions::new(from_deg)? })
    }

    /// Number of densities of one spectrum.
    pub fn cell_count(&self) -> usize {
        self.frequencies_hz.len() * self.directions.order.len()
    }

    /// Makes a spectrum from densities E, m^2/Hz/rad: for each frequency one for each direction, in the order of the
    /// file. `None` if there are no waves.
    ///
    /// # Errors
    /// One sentence, if a density is negative, too large or not a number.
    pub fn spectrum(&self, densities: &[f64]) -> Result<Option<MeasuredSpectrum>, String> {
        let n = self.directions.order.len();
        let (mut bands, mut table) = (Vec::new(), Vec::new());
        for (f, row) in self.frequencies_hz.iter().zip(densities.chunks(n)) {
            for &density in row {
                checked_density(density)?;
            }
            bands.push((*f, checked_density(row.iter().sum::<f64>() * self.directions.width_rad)?));
            table.extend(self.directions.whole_circle(row));
        }
        if bands.iter().all(|b| b.1 == 0.0) {
            return Ok(None);
        }
        let table = DirectionalTable::new(self.directions.first_from_deg, self.directions.source.len(), &table)?;
        MeasuredSpectrum::with_table(&bands, table).map(Some)
    }
}

impl Directions {
    fn new(from_deg: &[f64]) -> Result<Self, String> {
        let n = from_deg.len();
        if !(MIN_DIRECTIONS..=MAX_FILE_DIRECTIONS).contains(&n) {
            return Err(format!("{n} directions, but {MIN_DIRECTIONS} to {MAX_FILE_DIRECTIONS} are needed"));
        }
        if from_deg.iter().any(|d| !d.is_finite() || d.abs() > 1e4) {
            return Err("a direction is not an angle in degrees".into());
        }
        let wrapped: Vec<f64> = from_deg.iter().map(|d| d.rem_euclid(360.0)).collect();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| wrapped[a].total_cmp(&wrapped[b]));
        // The widest gap ends where the sector begins.
        let gap = |i: usize| (wrapped[order[(i + 1) % n]] - wrapped[order[i]]).rem_euclid(360.0);
        let widest = (0..n).fold(n - 1, |best, i| if gap(i) > gap(best) + 1e-6 { i } else { best });
        let open_deg = gap(widest);
        order.rotate_left((widest + 1) % n);
        let first = wrapped[order[0]];
        let offset = |i: usize| (wrapped[order[i]] - first).rem_euclid(360.0);
        let inner_step = (360.0 - open_deg) / (n - 1) as f64;
        let is_circle = open_deg < 1.5 * inner_step;
        let step = if is_circle { 360.0 / n as f64 } else { inner_step };
        // The first direction is rounded, too: the mean deviation belongs to it.
        let shift = (0..n).map(|i| offset(i) - i as f64 * step).sum::<f64>() / n as f64;
        let is_even = (0..n).all(|i| (offset(i) - i as f64 * step - shift).abs() <= MAX_UNEVENNESS * step);
        if !is_even || step < 1e-3 {
            return Err("the directions are not evenly spaced: interpolate them to even steps".into());
        }
        let count = (360.0 / step).round().max(MIN_DIRECTIONS as f64);
        if count > MAX_FILE_DIRECTIONS as f64 {
            return Err(format!("directions {step} degrees apart: steps of a quarter of a degree or more are needed"));
        }
        let source = (0..count as usize).map(|i| {
            let at = i as f64 * 360.0 / count / step;
            let whole = (at + 1e-9).floor();
            let t = if is_circle { 0.0 } else { (at - whole).max(0.0) };
            (whole < n as f64).then_some((whole as usize, if t < 1e-6 { 0.0 } else { t }))
        });
        Ok(Self { source: source.collect(), order, first_from_deg: first + shift, width_rad: step.to_radians() })
    }

    /// Densities of one frequency, in the order of the file, for the directions of the whole circle.
    fn whole_circle(&self, row: &[f64]) -> impl Iterator<Item = f64> {
        let at = |i: usize| self.order.get(i).map_or(0.0, |&file| row[file]);
        self.source.iter().map(move |s| s.map_or(0.0, |(i, t)| (1.0 - t) * at(i) + t * at(i + 1)))
    }
}

/// Spectra that were read from a file so far, within the limits of a file.
#[derive(Default)]
pub(super) struct Records {
    /// The spectra with waves.
    pub records: Vec<SpectrumRecord>,
    /// Number of spectra without data or waves.
    pub skipped: usize,
    densities: usize,
}

impl Records {
    /// Counts a spectrum of `densities` numbers before it is read. An error if it would exceed the limits of a file.
    pub fn announce(&mut self, densities: usize) -> Result<(), String> {
        self.densities = self.densities.saturating_add(densities);
        if self.records.len() + self.skipped >= MAX_RECORDS || self.densities > MAX_FILE_DENSITIES {
            return Err(format!(
                "more than {MAX_RECORDS} spectra or {MAX_FILE_DENSITIES} densities: keep fewer times and places in it"
            ));
        }
        Ok(())
    }

    /// Keeps a spectrum with its label; `None` counts as one without waves.
    pub fn add(&mut self, label: &str, spectrum: Option<MeasuredSpectrum>) {
        match spectrum {
            Some(spectrum) => {
                let label = printable_prefix(label, 60);
                self.records.push(SpectrumRecord { label, spectrum, notices: Vec::new() });
            }
            None => self.skipped += 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment_from_deg(grid: &Grid, densities: &[f64]) -> (f64, f64) {
        let sea = grid.spectrum(densities).expect("right densities").expect("waves");
        let [x, z] = sea.tabulated_distribution(1.0).expect("directions").first_moment();
        ((-x).atan2(z).to_degrees().rem_euclid(360.0), sea.bands()[1].1)
    }

    #[test]
    fn circles_and_sectors_in_any_order_keep_direction_and_energy() {
        let frequencies = || vec![0.1, 0.2, 0.3];
        // A peak at the sixth direction.
        let row = |n: usize| -> Vec<f64> { (0..3 * n).map(|i| [0.0, 1.0, 2.0, 1.0][(i % n).min(8) / 2 % 4]).collect() };
        let peak = |n: usize| -> Vec<f64> { (0..3 * n).map(|i| f64::from(u8::from(i % n == 5))).collect() };
        for (from, n, step) in
            [(5.0, 36, 10.0), (350.0, 24, -15.0), (100.0, 10, 10.0), (300.0, 20, 7.0), (-170.0, 18, 3.3)]
        {
            let directions: Vec<f64> = (0..n).map(|i| from + f64::from(i) * step).collect();
            let grid = Grid::new(frequencies(), &directions).expect("a grid");
            let (found, density) = moment_from_deg(&grid, &peak(n as usize));
            let want = (from + 5.0 * step).rem_euclid(360.0);
            assert!((found - want).abs() < 0.5, "{from} {n} {step}: {found}, not {want}");
            assert!((density - f64::abs(step).to_radians()).abs() < 1e-4, "{density}");
            assert!(grid.spectrum(&row(n as usize)).is_ok());
        }
        // Radians with three digits.
        let rounded: Vec<f64> = (0..36)
            .map(|i| ((f64::from(i) * 10.0).to_radians() * 100.0).round().to_radians().to_degrees() / 100.0)
            .collect();
        assert!(Grid::new(frequencies(), &rounded.iter().map(|d| d.to_degrees()).collect::<Vec<_>>()).is_ok());
    }

    #[test]
    fn what_is_no_grid_is_refused() {
        let even: Vec<f64> = (0..36).map(|i| 10.0 * f64::from(i)).collect();
        for (frequencies, directions, says) in [
            (vec![0.1, 0.2], even.clone(), "2 frequencies"),
            (vec![0.1, 0.3, 0.2], even.clone(), "ascend"),
            (vec![0.1, f64::NAN, 0.2], even.clone(), "above 0"),
            (vec![0.1, 0.2, 0.3], vec![0.0, 90.0, 180.0], "3 directions"),
            (vec![0.1, 0.2, 0.3], vec![0.0, 10.0, 50.0, 60.0], "not evenly spaced"),
            (vec![0.1, 0.2, 0.3], vec![5.0; 8], "not evenly spaced"),
            (vec![0.1, 0.2, 0.3], vec![0.0, 0.1, 0.2, 0.3], "quarter"),
            (vec![0.1, 0.2, 0.3], vec![0.0, f64::INFINITY, 0.2, 0.3], "not an angle"),
        ] {
            let reason = Grid::new(frequencies, &directions).expect_err(says);
            assert!(reason.contains(says), "{reason}");
        }
        let grid = Grid::new(vec![0.1, 0.2, 0.3], &even).expect("a grid");
        for wrong in [-1.0, f64::NAN, f64::INFINITY, 1e7] {
            let mut densities = vec![1.0; 108];
            densities[50] = wrong;
            grid.spectrum(&densities).expect_err("refused");
        }
        assert_eq!(grid.spectrum(&[0.0; 108]), Ok(None));
    }
}
