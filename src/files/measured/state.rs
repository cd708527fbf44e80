//! A measured sea as text for a link: bands separated by `_`, their fields by `*`, in characters that need no escape.

use super::{Direction, MAX_BANDS, Measured, number, printable};
use std::fmt::Write as _;

/// Longest text that [`Measured::from_state`] reads.
pub const MAX_STATE_BYTES: usize = 16 * 1024;

impl Measured {
    /// The sea as `f*S_f*S_...` or `f*S*alpha1*alpha2*r1*r2_...`, about 1.6 kB for 47 directional bands.
    pub fn to_state(&self) -> String {
        let mut out = String::new();
        for (i, (f, s)) in self.f_hz.iter().zip(&self.density_m2_hz).enumerate() {
            let separator = if i == 0 { "" } else { "_" };
            // Writing to a string cannot fail.
            let _ = write!(out, "{separator}{}*{}", shortest(*f), shortest(*s));
            if let Some(d) = self.directions.as_ref().map(|d| d[i]) {
                for v in [d.alpha1_deg, d.alpha2_deg, d.r1, d.r2] {
                    let _ = write!(out, "*{}", shortest(v));
                }
            }
        }
        out
    }

    /// Reads what [`Measured::to_state`] wrote.
    ///
    /// # Errors
    /// One sentence that says what is wrong and in which band.
    pub fn from_state(text: &str) -> Result<Self, String> {
        if text.len() > MAX_STATE_BYTES {
            return Err(format!("the measured sea is longer than {MAX_STATE_BYTES} bytes"));
        }
        let (mut bands, mut directions) = (Vec::new(), Vec::new());
        for (i, band) in text.split('_').take(MAX_BANDS + 1).enumerate() {
            let fail = |what: String| Err(format!("band {} of the measured sea: {what}", i + 1));
            let mut fields = [0.0; 6];
            let mut count = 0;
            for field in band.split('*') {
                let Some(slot) = fields.get_mut(count) else { break };
                match number(field) {
                    Some(v) => *slot = v,
                    None => return fail(format!("\"{}\" is not a number", printable(field, 20))),
                }
                count += 1;
            }
            if band.split('*').count() != count || (count != 2 && count != 6) {
                return fail("it has neither 2 nor 6 numbers".into());
            }
            let [f, s, alpha1_deg, alpha2_deg, r1, r2] = fields;
            if count == 6 {
                if [alpha1_deg, alpha2_deg].iter().any(|a| !(0.0..=360.0).contains(a)) {
                    return fail("a direction is not within 0 to 360 degrees".into());
                }
                if [r1, r2].iter().any(|r| !(0.0..=1.0).contains(r)) {
                    return fail("a directional moment is not within 0 to 1".into());
                }
                directions.push(Direction { alpha1_deg, alpha2_deg, r1, r2 });
            }
            bands.push((f, s));
            if !directions.is_empty() && directions.len() != bands.len() {
                return fail("some bands have directions and some have none".into());
            }
        }
        let directions = (!directions.is_empty()).then_some(directions.as_slice());
        Self::new(&bands, directions).map_err(|what| format!("the measured sea: {what}"))
    }
}

/// The shortest decimal text of a number that is not negative: `.05`, `12.3`, `4e-7`.
fn shortest(v: f64) -> String {
    let plain = v.to_string();
    let plain = plain.strip_prefix('0').filter(|p| !p.is_empty()).unwrap_or(&plain);
    let power = format!("{v:e}");
    if v < 1.0 && power.len() < plain.len() { power } else { plain.into() }
}
