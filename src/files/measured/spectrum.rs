//! A measured wave spectrum: its variance density, wave height, peak frequency and directional moments.

use super::direction::DirectionalParameters;
use super::directional::{DirectionalTable, TabulatedDistribution};
use super::text::display_number;
use std::f64::consts::TAU;

/// Largest number of frequency bands of a measured spectrum.
pub const MAX_BANDS: usize = 256;
/// Smallest number of frequency bands of a measured spectrum.
pub const MIN_BANDS: usize = 3;
/// Highest frequency that a band of a measured spectrum may have, Hz.
const MAX_FREQUENCY_HZ: f64 = 2.0;
/// Every variance density of a measured spectrum must be below this value, m^2/Hz.
const MAX_DENSITY_M2_PER_HZ: f64 = 1e5;
/// Band frequencies (Hz) and variance densities (m^2/Hz) of a smaller magnitude are rounded to 0.
const MIN_NONZERO_MAGNITUDE: f64 = 1e-9;

/// A measured spectrum: one-sided variance densities in frequency bands, with or without directions. All numbers are
/// rounded to the digits that [`Self::to_state`] writes, so a spectrum survives a link unchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredSpectrum {
    bands: Vec<(f64, f64)>,
    directions: Option<Vec<DirectionalParameters>>,
    table: Option<DirectionalTable>,
}

/// A measured spectrum that was read from files, with its title and messages to the user.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumFile {
    /// The variance densities and, if the files hold them, the directions of all frequency bands.
    pub spectrum: MeasuredSpectrum,
    /// Title for the user: name of the file and time of the record, printable and short.
    pub title: String,
    /// Messages to the user about missing data, and about data in the files that were not used.
    pub notices: Vec<String>,
}

impl MeasuredSpectrum {
    /// Makes a spectrum from bands (frequency in Hz, ascending; one-sided variance density in m^2/Hz), and either
    /// `directions` with one entry for each band, or None for a spectrum without directions.
    ///
    /// # Errors
    /// One sentence, if the number of bands is not within [`MIN_BANDS`] to [`MAX_BANDS`] or a value is out of range.
    pub fn new(bands: &[(f64, f64)], directions: Option<&[DirectionalParameters]>) -> Result<Self, String> {
        let n = bands.len();
        if !(MIN_BANDS..=MAX_BANDS).contains(&n) {
            return Err(format!("{n} frequency bands, but {MIN_BANDS} to {MAX_BANDS} are needed"));
        }
        let mut kept: Vec<(f64, f64)> = Vec::with_capacity(n);
        for &(f, s) in bands {
            kept.push((checked_frequency(f, kept.last().map(|b| b.0))?, checked_density(s)?));
        }
        if let Some(d) = directions.filter(|d| d.len() != n) {
            return Err(format!("{} directions for {n} frequency bands", d.len()));
        }
        let directions = directions.map(|d| d.iter().map(DirectionalParameters::rounded).collect()).transpose()?;
        if kept.iter().all(|b| b.1 == 0.0) {
            return Err("the variance density is zero in every band: there are no waves".into());
        }
        Ok(Self { bands: kept, directions, table: None })
    }

    /// Makes a spectrum from bands as [`Self::new`] does, and from a table with the shares of the directions in each
    /// band: the density over frequency and direction is the product of both.
    ///
    /// # Errors
    /// One sentence, if [`Self::new`] refuses the bands, or if the table has another number of bands.
    pub fn with_table(bands: &[(f64, f64)], table: DirectionalTable) -> Result<Self, String> {
        let spectrum = Self::new(bands, None)?;
        if table.band_count() != bands.len() {
            return Err(format!("directions of {} bands for {} frequency bands", table.band_count(), bands.len()));
        }
        Ok(Self { table: Some(table), ..spectrum })
    }

    /// Frequency (Hz, ascending) and one-sided variance density S(f) (m^2/Hz) of each band.
    pub fn bands(&self) -> &[(f64, f64)] {
        &self.bands
    }

    /// Directional parameters of each band in the order of the bands; `None` if the spectrum has no directions.
    pub fn directions(&self) -> Option<&[DirectionalParameters]> {
        self.directions.as_deref()
    }

    /// Shares of the directions in each band; `None` unless the file held densities over frequency and direction.
    pub fn directional_table(&self) -> Option<&DirectionalTable> {
        self.table.as_ref()
    }

    /// Whether the spectrum has directions, as parameters of each band or as densities.
    pub fn has_directions(&self) -> bool {
        self.directions.is_some() || self.table.is_some()
    }

    /// Variance density S(omega) = S(f) / (2 pi), m^2 s, at omega in rad/s. It is linear in f between bands. Below the
    /// first band it falls linearly to 0 over as many Hz as separate the first two bands, or at f = 0. Above the last
    /// band it falls as f^-5 (Phillips' equilibrium range), for the waves that are too short for the buoy.
    pub fn density(&self, omega: f64) -> f64 {
        let f = omega / TAU;
        let (first, last) = (self.bands[0], self.bands[self.bands.len() - 1]);
        let s = if f >= last.0 {
            last.1 * (last.0 / f).powi(5)
        } else if f >= first.0 {
            let (i, t) = self.band_and_fraction(f);
            self.bands[i].1 + t * (self.bands[i + 1].1 - self.bands[i].1)
        } else {
            let low = self.zero_density_frequency_hz();
            first.1 * ((f - low) / (first.0 - low)).max(0.0)
        };
        s / TAU
    }

    /// Angular frequency below the first band at which [`Self::density`] reaches 0, rad/s; at least a thousandth of the
    /// first band's angular frequency, so that the result has a logarithm.
    pub fn lowest_omega(&self) -> f64 {
        TAU * self.zero_density_frequency_hz().max(1e-3 * self.bands[0].0)
    }

    /// Angular frequencies at which the variance density has a kink, rad/s, ascending: the bands and, if above 0, the
    /// frequency below them at which the density reaches 0.
    pub fn density_kinks_rad_s(&self) -> Vec<f64> {
        let low = (self.zero_density_frequency_hz() > 0.0).then(|| self.zero_density_frequency_hz());
        low.into_iter().chain(self.bands.iter().map(|b| b.0)).map(|f| TAU * f).collect()
    }

    /// Variance of the surface elevation in the measured bands, m^2: the exact integral of
    /// [`MeasuredSpectrum::density`] over frequency up to the last band.
    pub fn variance_m2(&self) -> f64 {
        let foot = 0.5 * (self.bands[0].0 - self.zero_density_frequency_hz()) * self.bands[0].1;
        foot + self.bands.windows(2).map(|w| 0.5 * (w[1].0 - w[0].0) * (w[0].1 + w[1].1)).sum::<f64>()
    }

    /// Significant wave height of the measured bands, m: 4 sqrt(m0), with the variance m0 of the elevation, m^2.
    pub fn hs_m(&self) -> f64 {
        4.0 * self.variance_m2().sqrt()
    }

    /// Peak angular frequency, rad/s: the band of the largest variance density, refined by a parabola through this band
    /// and its neighbours.
    pub fn omega_p(&self) -> f64 {
        let n = self.bands.len();
        let peak = (1..n).fold(0, |best, i| if self.bands[i].1 > self.bands[best].1 { i } else { best });
        let (f, s) = self.bands[peak];
        if peak == 0 || peak + 1 == n {
            return TAU * f;
        }
        let (below, above) = (self.bands[peak - 1], self.bands[peak + 1]);
        let (left, right, rise, fall) = (f - below.0, above.0 - f, s - below.1, s - above.1);
        let shift = 0.5 * (right * right * rise - left * left * fall) / (right * rise + left * fall);
        let shift = if shift.is_finite() { shift.clamp(-0.5 * left, 0.5 * right) } else { 0.0 };
        TAU * (f + shift)
    }

    /// Moments [re c1, im c1, re c2, im c2] of the directional distribution D at omega in rad/s: c_n = integral of D
    /// e^{i n theta}, with the direction theta = atan2(z, x) that waves travel TO (x east, z south). They are linear in
    /// frequency between bands, and constant below and above the bands. None without directions.
    pub fn directional_moments(&self, omega: f64) -> Option<[f64; 4]> {
        let directions = self.directions.as_ref()?;
        let (i, t) = self.band_and_fraction(omega / TAU);
        let (a, b) = (directions[i].directional_moments(), directions[i + 1].directional_moments());
        Some(std::array::from_fn(|n| a[n] + t * (b[n] - a[n])))
    }

    /// Distribution over directions at omega in rad/s from the table of densities, so that S(omega) D is linear in
    /// frequency between bands. Below and above the bands it is that of the nearest one. None without such a table.
    pub fn tabulated_distribution(&self, omega: f64) -> Option<TabulatedDistribution<'_>> {
        let table = self.table.as_ref()?;
        let (i, t) = self.band_and_fraction(omega / TAU);
        let energy = [(1.0 - t) * self.bands[i].1, t * self.bands[i + 1].1];
        let sum = energy[0] + energy[1];
        let upper = if sum > 0.0 { energy[1] / sum } else { t };
        Some(table.between([(i, 1.0 - upper), (i + 1, upper)]))
    }

    /// Frequency below the first band at which the variance density reaches 0, Hz: lower than the first band by the
    /// distance of the first two bands, but at least 0.
    fn zero_density_frequency_hz(&self) -> f64 {
        (2.0 * self.bands[0].0 - self.bands[1].0).max(0.0)
    }

    /// Returns (i, t): the frequency `f` in Hz lies between the bands i and i + 1, at the fraction t, 0 to 1, of the
    /// way. Below the first band it is (0, 0); from the last band on, t is 1.
    fn band_and_fraction(&self, f: f64) -> (usize, f64) {
        let i = self.bands.partition_point(|b| b.0 <= f).clamp(1, self.bands.len() - 1) - 1;
        let (low, high) = (self.bands[i].0, self.bands[i + 1].0);
        (i, ((f - low) / (high - low)).clamp(0.0, 1.0))
    }
}

/// Returns the frequency of a band, Hz, rounded to four significant digits. An error unless it is above 0, at most
/// [`MAX_FREQUENCY_HZ`] and above `before`, the rounded frequency of the previous band (None for the first).
pub(super) fn checked_frequency(f: f64, before: Option<f64>) -> Result<f64, String> {
    let kept = round_to_four_digits(f);
    if !(kept > 0.0 && kept <= MAX_FREQUENCY_HZ) {
        return Err(format!(
            "the frequency {} Hz must be above 0 and at most {MAX_FREQUENCY_HZ} Hz",
            display_number(f)
        ));
    }
    match before.filter(|b| kept <= *b) {
        Some(b) => Err(format!(
            "the frequency {} Hz follows {} Hz: frequencies must ascend",
            display_number(f),
            display_number(b)
        )),
        None => Ok(kept),
    }
}

/// Rounds a variance density, m^2/Hz, to four significant digits; an error unless it is >= 0 and <
/// [`MAX_DENSITY_M2_PER_HZ`].
pub(super) fn checked_density(s: f64) -> Result<f64, String> {
    let kept = round_to_four_digits(s);
    if s >= 0.0 && kept < MAX_DENSITY_M2_PER_HZ {
        Ok(kept)
    } else {
        Err(format!(
            "the variance density {} m^2/Hz must be at least 0 and below {MAX_DENSITY_M2_PER_HZ} m^2/Hz",
            display_number(s)
        ))
    }
}

/// Rounds a number to four significant decimal digits; a magnitude below [`MIN_NONZERO_MAGNITUDE`] becomes 0.
fn round_to_four_digits(v: f64) -> f64 {
    if v.abs() < MIN_NONZERO_MAGNITUDE { 0.0 } else { format!("{v:.3e}").parse().unwrap_or(f64::NAN) }
}
