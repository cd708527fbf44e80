//! Measured spectra as text for links: bands are separated by `_`, the numbers of a band by `*`. No character needs
//! percent-encoding.

use super::direction::DirectionalParameters;
use super::spectrum::{MAX_BANDS, MeasuredSpectrum};
use super::text::{parse_number, quoted_excerpt};

/// Longest text of a measured spectrum that [`MeasuredSpectrum::from_state`] reads, bytes.
pub const MAX_TEXT_BYTES: usize = 16 * 1024;

impl MeasuredSpectrum {
    /// Writes the spectrum as text for a link, band by band: `f*S_f*S_...`, or with directions
    /// `f*S*alpha1*alpha2*r1*r2_...`, f in Hz, S in m^2/Hz, angles in degrees; about 1.6 kB for 47 directional bands.
    pub fn to_state(&self) -> String {
        let band = |(i, (f, s)): (usize, &(f64, f64))| {
            let mut fields = vec![*f, *s];
            if let Some(d) = self.directions().map(|d| d[i]) {
                fields.extend([d.alpha1_deg, d.alpha2_deg, d.r1, d.r2]);
            }
            fields.into_iter().map(shortest_decimal).collect::<Vec<_>>().join("*")
        };
        self.bands().iter().enumerate().map(band).collect::<Vec<_>>().join("_")
    }

    /// Reads a measured spectrum from the text that [`MeasuredSpectrum::to_state`] writes, such as `.05*1_.06*2_.07*1`.
    ///
    /// # Errors
    /// One sentence that says what is wrong and in which band.
    pub fn from_state(text: &str) -> Result<Self, String> {
        if text.len() > MAX_TEXT_BYTES {
            return Err(format!("the measured spectrum is longer than {MAX_TEXT_BYTES} bytes"));
        }
        let (mut bands, mut directions) = (Vec::new(), Vec::new());
        for (i, band) in text.split('_').take(MAX_BANDS + 1).enumerate() {
            let fault = |what: &str| format!("band {} of the measured spectrum: {what}", i + 1);
            let value =
                |field| parse_number(field).ok_or_else(|| fault(&format!("{} is not a number", quoted_excerpt(field))));
            let fields = band.split('*').take(7).map(value).collect::<Result<Vec<_>, _>>()?;
            match fields[..] {
                [f, s] => bands.push((f, s)),
                [f, s, alpha1_deg, alpha2_deg, r1, r2] => {
                    if ![alpha1_deg, alpha2_deg].iter().all(|a| (0.0..=360.0).contains(a)) {
                        return Err(fault("a direction is not within 0 to 360 degrees"));
                    }
                    if ![r1, r2].iter().all(|r| (0.0..=1.0).contains(r)) {
                        return Err(fault("r1 or r2 is not within 0 to 1"));
                    }
                    bands.push((f, s));
                    directions.push(DirectionalParameters { alpha1_deg, alpha2_deg, r1, r2 });
                }
                _ => return Err(fault("it has neither 2 nor 6 numbers")),
            }
            if !directions.is_empty() && directions.len() != bands.len() {
                return Err(fault("some bands have directions and some have none"));
            }
        }
        let directions = (!directions.is_empty()).then_some(directions.as_slice());
        Self::new(&bands, directions).map_err(|what| format!("the measured spectrum: {what}"))
    }
}

/// Formats a number that is not negative as the shortest decimal text, such as `.05`, `12.3` or `4e-7`.
fn shortest_decimal(v: f64) -> String {
    let plain = v.to_string();
    let plain = plain.strip_prefix('0').filter(|p| !p.is_empty()).unwrap_or(&plain);
    let power = format!("{v:e}");
    if v < 1.0 && power.len() < plain.len() { power } else { plain.into() }
}
