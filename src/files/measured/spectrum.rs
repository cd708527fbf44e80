//! The measured spectrum: variance densities, heights, and directional moments.

use super::direction::Direction;
use super::text::{printable, shown};
use std::f64::consts::TAU;

/// Most frequency bands of a measured spectrum.
pub const MAX_BANDS: usize = 256;
/// Fewest frequency bands of a measured spectrum.
pub const MIN_BANDS: usize = 3;
/// Highest frequency of a band, Hz.
const MAX_HZ: f64 = 2.0;
/// Upper bound of a variance density, exclusive, m^2/Hz.
const MAX_DENSITY: f64 = 1e5;
/// Frequencies (Hz) and densities (m^2/Hz) below this count as 0.
const TINY: f64 = 1e-9;
/// Longest title, characters.
const MAX_TITLE: usize = 80;

/// A measured spectrum: one-sided variance densities in frequency bands, with or without directions. All numbers are
/// rounded to the precision of a link, so a spectrum and its copy from a link are equal. Comparison ignores the title.
#[derive(Clone, Debug)]
pub struct MeasuredSpectrum {
    f_hz: Vec<f64>,
    density_m2_hz: Vec<f64>,
    directions: Option<Vec<Direction>>,
    title: String,
}

impl PartialEq for MeasuredSpectrum {
    fn eq(&self, other: &Self) -> bool {
        self.f_hz == other.f_hz && self.density_m2_hz == other.density_m2_hz && self.directions == other.directions
    }
}

impl MeasuredSpectrum {
    /// A spectrum of bands (frequency in Hz, ascending; one-sided variance density in m^2/Hz), with one direction for
    /// each band or none at all.
    ///
    /// # Errors
    /// One sentence, if the number of bands is not within [`MIN_BANDS`] to [`MAX_BANDS`] or a value is out of range.
    pub fn new(bands: &[(f64, f64)], directions: Option<&[Direction]>) -> Result<Self, String> {
        let n = bands.len();
        if !(MIN_BANDS..=MAX_BANDS).contains(&n) {
            return Err(format!("{n} frequency bands, but {MIN_BANDS} to {MAX_BANDS} are needed"));
        }
        let (mut f_hz, mut density_m2_hz) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for &(f, s) in bands {
            f_hz.push(checked_frequency(f, f_hz.last().copied())?);
            density_m2_hz.push(checked_density(s)?);
        }
        if let Some(d) = directions.filter(|d| d.len() != n) {
            return Err(format!("{} directions for {n} frequency bands", d.len()));
        }
        let directions = directions.map(|d| d.iter().map(Direction::rounded).collect()).transpose()?;
        if density_m2_hz.iter().all(|&s| s == 0.0) {
            return Err("the variance density is zero in every band: there are no waves".into());
        }
        Ok(Self { f_hz, density_m2_hz, directions, title: String::new() })
    }

    /// Frequencies of the bands, Hz, ascending.
    pub fn f_hz(&self) -> &[f64] {
        &self.f_hz
    }

    /// One-sided variance densities S(f) of the bands, m^2/Hz.
    pub fn density_m2_hz(&self) -> &[f64] {
        &self.density_m2_hz
    }

    /// Directional parameters of the bands, if the spectrum has directions.
    pub fn directions(&self) -> Option<&[Direction]> {
        self.directions.as_deref()
    }

    /// File and time of the spectrum, printable and short; empty after [`MeasuredSpectrum::from_state`].
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Sets the title without its unprintable characters, cut to 80 characters.
    pub(super) fn set_title(&mut self, title: &str) {
        self.title = printable(title, MAX_TITLE);
    }

    /// Variance density S(omega) = S(f) / (2 pi), m^2 s, at omega in rad/s. It is linear in f between bands. Below the
    /// first band it falls to 0 over the width of the first interval. Above the last band it falls as f^-5 (Phillips'
    /// equilibrium range), for the waves that are too short for the buoy.
    pub fn density(&self, omega: f64) -> f64 {
        let f = omega / TAU;
        let (first, last) = (self.f_hz[0], self.f_hz[self.f_hz.len() - 1]);
        let s = if f >= last {
            self.density_m2_hz[self.f_hz.len() - 1] * (last / f).powi(5)
        } else if f >= first {
            let (i, t) = self.interval(f);
            self.density_m2_hz[i] + t * (self.density_m2_hz[i + 1] - self.density_m2_hz[i])
        } else {
            let low = self.low_hz();
            self.density_m2_hz[0] * ((f - low) / (first - low)).max(0.0)
        };
        s / TAU
    }

    /// Lowest omega with variance, rad/s; above 0, so that it has a logarithm.
    pub fn lowest_omega(&self) -> f64 {
        TAU * self.low_hz().max(1e-3 * self.f_hz[0])
    }

    /// Values of omega at which S has a kink, rad/s, ascending: the bands and the foot of the slope below them.
    pub fn breakpoints(&self) -> Vec<f64> {
        let low = (self.low_hz() > 0.0).then(|| self.low_hz());
        low.iter().chain(&self.f_hz).map(|f| TAU * f).collect()
    }

    /// Variance of the measured bands, m^2: the exact integral of [`MeasuredSpectrum::density`] up to the last band.
    pub fn m0_m2(&self) -> f64 {
        let foot = 0.5 * (self.f_hz[0] - self.low_hz()) * self.density_m2_hz[0];
        let pairs = self.f_hz.windows(2).zip(self.density_m2_hz.windows(2));
        foot + pairs.map(|(f, s)| 0.5 * (f[1] - f[0]) * (s[0] + s[1])).sum::<f64>()
    }

    /// Significant wave height of the measured bands, m: 4 sqrt(m0).
    pub fn hs_m(&self) -> f64 {
        4.0 * self.m0_m2().sqrt()
    }

    /// Peak frequency, rad/s: the band of the largest density, refined by the parabola through its neighbours.
    pub fn omega_p(&self) -> f64 {
        let (f, s) = (&self.f_hz, &self.density_m2_hz);
        let peak = (1..s.len()).fold(0, |best, i| if s[i] > s[best] { i } else { best });
        if peak == 0 || peak + 1 == s.len() {
            return TAU * f[peak];
        }
        let (left, right) = (f[peak] - f[peak - 1], f[peak + 1] - f[peak]);
        let (rise, fall) = (s[peak] - s[peak - 1], s[peak] - s[peak + 1]);
        let shift = 0.5 * (right * right * rise - left * left * fall) / (right * rise + left * fall);
        let shift = if shift.is_finite() { shift.clamp(-0.5 * left, 0.5 * right) } else { 0.0 };
        TAU * (f[peak] + shift)
    }

    /// The moments (re c1, im c1, re c2, im c2), c_n = integral of D e^{i n theta}, of the direction theta = atan2(z, x)
    /// that waves travel TO (x east, z south), at omega in rad/s. None without directions. The moments, not the angles,
    /// are linear in f between bands; they are constant below and above.
    pub fn moments(&self, omega: f64) -> Option<[f64; 4]> {
        let directions = self.directions.as_ref()?;
        let (i, t) = self.interval(omega / TAU);
        let (a, b) = (directions[i].moments(), directions[i + 1].moments());
        Some(std::array::from_fn(|n| a[n] + t * (b[n] - a[n])))
    }

    /// Frequency at which the slope below the first band reaches 0, Hz.
    fn low_hz(&self) -> f64 {
        (2.0 * self.f_hz[0] - self.f_hz[1]).max(0.0)
    }

    /// Index of the interval between two bands that holds a frequency in Hz, and the position in it, 0 to 1.
    fn interval(&self, f: f64) -> (usize, f64) {
        let i = self.f_hz.partition_point(|&b| b <= f).clamp(1, self.f_hz.len() - 1) - 1;
        (i, ((f - self.f_hz[i]) / (self.f_hz[i + 1] - self.f_hz[i])).clamp(0.0, 1.0))
    }
}

/// The frequency of a band in Hz, rounded; `before` is the rounded frequency of the band before it.
pub(super) fn checked_frequency(f: f64, before: Option<f64>) -> Result<f64, String> {
    let kept = four_digits(f);
    if !(kept > 0.0 && kept <= MAX_HZ) {
        return Err(format!("the frequency {} Hz must be above 0 and at most {MAX_HZ} Hz", shown(f)));
    }
    match before.filter(|b| kept <= *b) {
        Some(b) => Err(format!("the frequency {} Hz follows {} Hz: frequencies must ascend", shown(f), shown(b))),
        None => Ok(kept),
    }
}

/// The variance density of a band in m^2/Hz, rounded.
pub(super) fn checked_density(s: f64) -> Result<f64, String> {
    let kept = four_digits(s);
    if s >= 0.0 && kept < MAX_DENSITY {
        Ok(kept)
    } else {
        Err(format!("the variance density {} m^2/Hz must be at least 0 and below {MAX_DENSITY} m^2/Hz", shown(s)))
    }
}

/// A number rounded to four significant decimal digits; below [`TINY`] it becomes 0.
fn four_digits(v: f64) -> f64 {
    if v.abs() < TINY { 0.0 } else { format!("{v:.3e}").parse().unwrap_or(f64::NAN) }
}
