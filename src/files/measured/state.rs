//! Measured spectra as text for links: bands are separated by `_`, the numbers of a band by `*`. No character needs
//! percent-encoding.

use super::direction::DirectionalParameters;
use super::directional::DirectionalTable;
use super::spectrum::{MAX_BANDS, MeasuredSpectrum};
use super::text::{parse_number, quoted_excerpt};

/// Longest text of a measured spectrum that [`MeasuredSpectrum::from_state`] reads, bytes.
pub const MAX_TEXT_BYTES: usize = 16 * 1024;

/// First field of the text of a spectrum with densities over frequency and direction.
const TABLE_WORD: &str = "d";
/// The 64 letters in which levels are written, each for six bits. `_` and `*` separate bands and numbers.
const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-.";

impl MeasuredSpectrum {
    /// Writes the spectrum as text for a link, band by band: `f*S_f*S_...`, or with directions
    /// `f*S*alpha1*alpha2*r1*r2_...`, f in Hz, S in m^2/Hz, angles in degrees; about 1.6 kB for 47 directional bands.
    ///
    /// A spectrum with densities over frequency and direction is `d*n*first_f*S*levels_f*S*levels_...`: n directions
    /// clockwise from the bearing `first` that waves come from, in degrees; a level is two letters with six bits each.
    /// The text has about 3 kB for 36 bands and 36 directions.
    pub fn to_state(&self) -> String {
        let band = |(i, (f, s)): (usize, &(f64, f64))| {
            let mut fields = vec![*f, *s];
            if let Some(d) = self.directions().map(|d| d[i]) {
                fields.extend([d.alpha1_deg, d.alpha2_deg, d.r1, d.r2]);
            }
            let mut fields: Vec<String> = fields.into_iter().map(shortest_decimal).collect();
            fields.extend(self.directional_table().map(|table| level_letters(table.levels(i))));
            fields.join("*")
        };
        let head = self.directional_table().map(|table| {
            format!("{TABLE_WORD}*{}*{}", table.direction_count(), shortest_decimal(table.first_from_deg()))
        });
        head.into_iter().chain(self.bands().iter().enumerate().map(band)).collect::<Vec<_>>().join("_")
    }

    /// Reads a measured spectrum from the text that [`MeasuredSpectrum::to_state`] writes, such as `.05*1_.06*2_.07*1`.
    ///
    /// # Errors
    /// One sentence that says what is wrong and in which band.
    pub fn from_state(text: &str) -> Result<Self, String> {
        if text.len() > MAX_TEXT_BYTES {
            return Err(format!("the measured spectrum is longer than {MAX_TEXT_BYTES} bytes"));
        }
        if let Some((head, bands)) = text.strip_prefix("d*").and_then(|rest| rest.split_once('_')) {
            return read_table(head, bands);
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

/// Reads a spectrum with densities over frequency and direction: the fields `head` of the beginning, and its bands.
fn read_table(head: &str, text: &str) -> Result<MeasuredSpectrum, String> {
    let whole = |what: String| format!("the measured spectrum: {what}");
    let numbers: Vec<Option<f64>> = head.split('*').take(3).map(parse_number).collect();
    let [Some(count), Some(first_from_deg)] = numbers[..] else {
        return Err(whole("it begins with neither a band nor a number of directions and the first of them".into()));
    };
    let direction_count = count as usize;
    let (mut bands, mut levels) = (Vec::new(), Vec::new());
    for (i, band) in text.split('_').take(MAX_BANDS + 1).enumerate() {
        let fault = |what: &str| format!("band {} of the measured spectrum: {what}", i + 1);
        let fields: Vec<&str> = band.split('*').take(4).collect();
        let [f, s, letters] = fields[..] else { return Err(fault("it has not two numbers and levels")) };
        let value =
            |field| parse_number(field).ok_or_else(|| fault(&format!("{} is not a number", quoted_excerpt(field))));
        bands.push((value(f)?, value(s)?));
        let read = levels_of_letters(letters).ok_or_else(|| fault("its levels have other letters than a link has"))?;
        if read.len() != direction_count {
            return Err(fault(&format!("{} levels for {direction_count} directions", read.len())));
        }
        levels.extend(read);
    }
    let table = DirectionalTable::from_levels(first_from_deg, direction_count, levels).map_err(whole)?;
    MeasuredSpectrum::with_table(&bands, table).map_err(whole)
}

/// Writes levels, each with 12 bits, as two letters each.
fn level_letters(levels: &[u16]) -> String {
    let letter = |bits: u16| char::from(LETTERS[usize::from(bits & 63)]);
    levels.iter().flat_map(|level| [letter(level >> 6), letter(*level)]).collect()
}

/// Reads the levels that [`level_letters`] writes; `None` if a letter is not one of [`LETTERS`] or is left over.
fn levels_of_letters(text: &str) -> Option<Vec<u16>> {
    let bits = |letter: u8| LETTERS.iter().position(|l| *l == letter).map(|at| at as u16);
    let pairs = text.as_bytes().chunks(2);
    pairs.map(|pair| if let [high, low] = *pair { Some(bits(high)? << 6 | bits(low)?) } else { None }).collect()
}

/// Formats a number that is not negative as the shortest decimal text, such as `.05`, `12.3` or `4e-7`.
fn shortest_decimal(v: f64) -> String {
    let plain = v.to_string();
    let plain = plain.strip_prefix('0').filter(|p| !p.is_empty()).unwrap_or(&plain);
    let power = format!("{v:e}");
    if v < 1.0 && power.len() < plain.len() { power } else { plain.into() }
}
