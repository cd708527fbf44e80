//! Measured seas: a wave buoy's spectral file as a directional spectrum.
//!
//! [`Measured::read`] takes the files, [`Measured::to_state`] and [`Measured::from_state`] carry the whole sea in a
//! link, and the rest is physics: densities, heights, and the directional moments that [`Mem`] makes a distribution of.

mod mem;
mod ndbc;
mod read;
#[cfg(test)]
mod samples;
mod sections;
mod state;
mod table;
#[cfg(test)]
mod tests;

pub use mem::Mem;
pub use read::{MAX_FILE_BYTES, MAX_FILES};
pub use state::MAX_STATE_BYTES;

use std::f64::consts::{PI, TAU};

/// Most bands of a measured sea.
pub const MAX_BANDS: usize = 256;
/// Fewest bands of a measured sea.
pub const MIN_BANDS: usize = 3;
/// Highest frequency of a band, Hz.
const MAX_HZ: f64 = 2.0;
/// Densities stay below this, m^2/Hz.
const MAX_DENSITY: f64 = 1e5;
/// What is smaller counts as 0 (frequencies and densities).
const TINY: f64 = 1e-9;
/// Longest title, characters.
const MAX_TITLE: usize = 80;

/// A measured sea: variance densities in ascending bands of frequency, with or without directions. Every number is
/// rounded to what a link carries, so that a sea and its copy from a link are equal. The title takes no part in that.
#[derive(Clone, Debug)]
pub struct Measured {
    f_hz: Vec<f64>,
    density_m2_hz: Vec<f64>,
    directions: Option<Vec<Direction>>,
    title: String,
}

/// The directional moments of one band, as the NDBC gives them: D(A) = 1/pi (1/2 + r1 cos(A - alpha1) +
/// r2 cos(2 (A - alpha2))), A the direction waves come FROM, degrees clockwise from true north.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Direction {
    /// Mean direction, degrees in [0, 360).
    pub alpha1_deg: f64,
    /// Principal direction, degrees in [0, 360); alpha2 and alpha2 + 180 mean the same.
    pub alpha2_deg: f64,
    /// First moment, 0 to 1.
    pub r1: f64,
    /// Second moment, 0 to 1.
    pub r2: f64,
}

impl PartialEq for Measured {
    fn eq(&self, other: &Self) -> bool {
        self.f_hz == other.f_hz && self.density_m2_hz == other.density_m2_hz && self.directions == other.directions
    }
}

impl Measured {
    /// A sea from its bands (frequency in Hz, one-sided density in m^2/Hz) and one direction a band, or none.
    ///
    /// # Errors
    /// One sentence, when the bands are not a sea: see [`MIN_BANDS`], [`MAX_BANDS`] and the source.
    pub fn new(bands: &[(f64, f64)], directions: Option<&[Direction]>) -> Result<Self, String> {
        if bands.len() < MIN_BANDS || bands.len() > MAX_BANDS {
            let n = bands.len();
            return Err(format!("{n} bands of frequency, where {MIN_BANDS} to {MAX_BANDS} are needed"));
        }
        let (mut f_hz, mut density_m2_hz) = (Vec::with_capacity(bands.len()), Vec::with_capacity(bands.len()));
        for &(f, s) in bands {
            f_hz.push(frequency(f, f_hz.last().copied())?);
            density_m2_hz.push(density(s)?);
        }
        let directions = match directions {
            Some(d) if d.len() != bands.len() => {
                return Err(format!("{} directions for {} bands", d.len(), bands.len()));
            }
            Some(d) => Some(d.iter().map(Direction::rounded).collect::<Result<Vec<_>, _>>()?),
            None => None,
        };
        if density_m2_hz.iter().all(|&s| s == 0.0) {
            return Err("the spectral density is zero everywhere: there are no waves".into());
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

    /// Directional moments of the bands, if the sea has directions.
    pub fn directions(&self) -> Option<&[Direction]> {
        self.directions.as_deref()
    }

    /// Where the sea comes from (file and time), printable and short; empty after [`Measured::from_state`].
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Names the sea: what cannot be printed and what is too long is dropped.
    pub fn set_title(&mut self, title: &str) {
        self.title = printable(title, MAX_TITLE);
    }

    /// S(omega) = S(f) / (2 pi), m^2 s, at omega in rad/s: linear in f between bands; below the first it falls to 0
    /// over the width of the first interval; above the last it goes on as f^-5 (Phillips' equilibrium tail), the
    /// waves that are too short for the buoy.
    pub fn density(&self, omega: f64) -> f64 {
        let f = omega / TAU;
        let (first, last) = (self.f_hz[0], self.f_hz[self.f_hz.len() - 1]);
        let s = if f >= last {
            self.density_m2_hz[self.f_hz.len() - 1] * (last / f).powi(5)
        } else if f >= first {
            let (i, t) = self.place(f);
            self.density_m2_hz[i] + t * (self.density_m2_hz[i + 1] - self.density_m2_hz[i])
        } else {
            let low = self.low_hz();
            self.density_m2_hz[0] * ((f - low) / (first - low)).max(0.0)
        };
        s / TAU
    }

    /// Range of omega, rad/s, outside which S is nothing at the low end and 1e-8 of the tail's variance at the high.
    pub fn support(&self) -> (f64, f64) {
        // A low end of exactly 0 would have no logarithm.
        let low = self.low_hz().max(1e-3 * self.f_hz[0]);
        (TAU * low, TAU * 100.0 * self.f_hz[self.f_hz.len() - 1])
    }

    /// Frequencies at which S has a kink, rad/s, ascending: the bands' and the foot of the fall below them.
    pub fn breakpoints(&self) -> Vec<f64> {
        let low = (self.low_hz() > 0.0).then(|| self.low_hz());
        low.iter().chain(&self.f_hz).map(|f| TAU * f).collect()
    }

    /// Variance of the measured bands, m^2: the exact integral of [`Measured::density`] up to the last band.
    pub fn m0_m2(&self) -> f64 {
        let fall = 0.5 * (self.f_hz[0] - self.low_hz()) * self.density_m2_hz[0];
        let pairs = self.f_hz.windows(2).zip(self.density_m2_hz.windows(2));
        fall + pairs.map(|(f, s)| 0.5 * (f[1] - f[0]) * (s[0] + s[1])).sum::<f64>()
    }

    /// Significant height of the measured bands, m: 4 sqrt(m0).
    pub fn hs_m(&self) -> f64 {
        4.0 * self.m0_m2().sqrt()
    }

    /// Variance of the tail above the last band, m^2: S f / 4.
    pub fn tail_m2(&self) -> f64 {
        let last = self.f_hz.len() - 1;
        0.25 * self.density_m2_hz[last] * self.f_hz[last]
    }

    /// Frequency of the peak, rad/s: the band of the largest density, refined by the parabola through its neighbours.
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

    /// The first two Fourier coefficients (re c1, im c1, re c2, im c2), c_n = integral of D e^{i n theta}, of the
    /// direction theta = atan2(z, x) waves travel TO (x east, z south), at omega in rad/s; none without directions.
    /// The coefficients, not the angles, are linear in f between bands; they are constant outside.
    pub fn moments(&self, omega: f64) -> Option<[f64; 4]> {
        let directions = self.directions.as_ref()?;
        let (i, t) = self.place(omega / TAU);
        let (a, b) = (directions[i].moments(), directions[i + 1].moments());
        Some(std::array::from_fn(|n| a[n] + t * (b[n] - a[n])))
    }

    /// Where the fall below the first band reaches 0, Hz.
    fn low_hz(&self) -> f64 {
        (2.0 * self.f_hz[0] - self.f_hz[1]).max(0.0)
    }

    /// The interval of a frequency in Hz and the place in it, 0 to 1.
    fn place(&self, f: f64) -> (usize, f64) {
        let i = self.f_hz.partition_point(|&b| b <= f).clamp(1, self.f_hz.len() - 1) - 1;
        (i, ((f - self.f_hz[i]) / (self.f_hz[i + 1] - self.f_hz[i])).clamp(0.0, 1.0))
    }
}

impl Direction {
    /// The moments of the cos^{2s}(theta/2) lobe about a direction that has the circular spread sqrt(2 (1 - r1)), both
    /// in degrees. With s = r1/(1 - r1), r2 = s (s - 1)/((s + 1)(s + 2)) = r1 (2 r1 - 1)/(2 - r1) (Longuet-Higgins,
    /// Cartwright and Smith 1963); it is negative below s = 1, where the principal direction is across the mean one.
    pub fn from_spread(from_deg: f64, spread_deg: f64) -> Self {
        let r1 = (1.0 - 0.5 * spread_deg.to_radians().powi(2)).clamp(0.0, 1.0);
        let r2 = r1 * (2.0 * r1 - 1.0) / (2.0 - r1);
        let alpha2_deg = if r2 < 0.0 { from_deg + 90.0 } else { from_deg };
        Self { alpha1_deg: from_deg, alpha2_deg, r1, r2: r2.abs() }
    }

    /// [`Measured::moments`] of one band: waves from A travel along (-sin A, cos A), which is theta = A + pi/2.
    fn moments(&self) -> [f64; 4] {
        let theta1 = self.alpha1_deg.to_radians() + 0.5 * PI;
        let theta2 = 2.0 * self.alpha2_deg.to_radians() + PI;
        [self.r1 * theta1.cos(), self.r1 * theta1.sin(), self.r2 * theta2.cos(), self.r2 * theta2.sin()]
    }

    /// As a link carries it: angles to 0.1 degree in [0, 360), moments to 0.001 in [0, 1].
    fn rounded(&self) -> Result<Self, String> {
        let parts = [self.alpha1_deg, self.alpha2_deg, self.r1, self.r2];
        if !parts.iter().all(|v| v.is_finite()) {
            return Err("a directional moment is not a number".into());
        }
        let angle = |v: f64| ((10.0 * v.rem_euclid(360.0)).round() / 10.0) % 360.0 + 0.0;
        let moment = |v: f64| (1000.0 * v.clamp(0.0, 1.0)).round() / 1000.0 + 0.0;
        let Self { alpha1_deg, alpha2_deg, r1, r2 } = *self;
        Ok(Self { alpha1_deg: angle(alpha1_deg), alpha2_deg: angle(alpha2_deg), r1: moment(r1), r2: moment(r2) })
    }
}

/// A band's frequency in Hz as it is kept, or what is wrong with it after the one before.
fn frequency(f: f64, before: Option<f64>) -> Result<f64, String> {
    let kept = four_digits(f);
    if !(kept > 0.0 && kept <= MAX_HZ) {
        return Err(format!("the frequency {} is not above 0 and at most {MAX_HZ} Hz", shown(f)));
    }
    match before {
        Some(b) if kept <= b => {
            Err(format!("the frequency {} comes after {}: frequencies must ascend", shown(f), shown(b)))
        }
        _ => Ok(kept),
    }
}

/// A band's density in m^2/Hz as it is kept, or what is wrong with it.
fn density(s: f64) -> Result<f64, String> {
    let kept = four_digits(s);
    if s >= 0.0 && kept < MAX_DENSITY {
        Ok(kept)
    } else {
        Err(format!("the spectral density {} is not at least 0 and below {MAX_DENSITY} m^2/Hz", shown(s)))
    }
}

/// Rounded to four significant digits of decimal text; what is tiny becomes 0.
fn four_digits(v: f64) -> f64 {
    if v.abs() < TINY { 0.0 } else { format!("{v:.3e}").parse().unwrap_or(f64::NAN) }
}

/// A number in a message, short at any size.
fn shown(v: f64) -> String {
    if v == 0.0 || (1e-6..1e9).contains(&v.abs()) { v.to_string() } else { format!("{v:e}") }
}

/// A finite decimal number; "inf", "nan" and the like are none.
fn number(text: &str) -> Option<f64> {
    let plain = |b: u8| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+' | b'e' | b'E');
    text.bytes().all(plain).then(|| text.parse().ok()).flatten().filter(|v: &f64| v.is_finite())
}

/// The printable characters of a text, at most `limit` of them, cut short with an ellipsis.
fn printable(text: &str, limit: usize) -> String {
    // Controls, and what changes or hides the text around it.
    let hidden = |c: char| {
        let format =
            ['\u{200b}'..='\u{200f}', '\u{2028}'..='\u{202e}', '\u{2060}'..='\u{206f}', '\u{feff}'..='\u{feff}'];
        c.is_control() || format.iter().any(|range| range.contains(&c))
    };
    let mut rest = text.trim().chars().filter(|&c| !hidden(c));
    let mut out: String = rest.by_ref().take(limit).collect();
    if rest.next().is_some() {
        out.pop();
        out.push('…');
    }
    out
}
