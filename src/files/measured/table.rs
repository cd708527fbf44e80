//! Plain tables: f, S and, if known, direction and spread.

use super::read::{File, MAX_COLUMNS, content, quoted};
use super::{Direction, MAX_BANDS, Measured, density, frequency, number, shown};

/// Reads a table as a sea.
pub(super) fn read(file: &File<'_>) -> Result<(Measured, Vec<String>), String> {
    let mut bands: Vec<(f64, f64)> = Vec::new();
    let mut directions = Vec::new();
    // Separator and number of columns, from the first line and the first line of numbers.
    let mut format: Option<(char, Option<usize>)> = None;
    for (i, raw) in file.text.lines().enumerate() {
        let fail = |what: String| file.fault(i + 1, what);
        // A tab at the end of a line is an empty field, not space.
        let line = raw.trim_start_matches('\u{feff}').trim_matches([' ', '\r']);
        if content(line).is_empty() || line.starts_with('#') {
            continue;
        }
        let (separator, columns) = match format {
            Some(f) => f,
            None => match ['\t', ';', ','].into_iter().find(|&c| line.contains(c)) {
                Some(c) => (c, None),
                None => return Err(fail("no columns: they are separated by comma, semicolon or tab".into())),
            },
        };
        let fields: Vec<&str> =
            line.split(separator).take(MAX_COLUMNS + 1).map(|f| f.trim().trim_matches('"').trim()).collect();
        if fields.len() > MAX_COLUMNS {
            return Err(fail(format!("more than {MAX_COLUMNS} columns")));
        }
        let value = |field: &str| {
            if separator == ',' { number(field) } else { number(&field.replace(',', ".")) }
        };
        if format.is_none() && fields.iter().all(|f| value(f).is_none()) {
            format = Some((separator, None));
            continue;
        }
        let n = fields.len();
        match columns {
            Some(c) if c != n => return Err(fail(format!("{n} columns, where the lines before have {c}"))),
            None if n != 2 && n != 4 => {
                return Err(fail(format!("{n} columns, where 2 (f, S) or 4 (f, S, direction, spread) are needed")));
            }
            _ => format = Some((separator, Some(n))),
        }
        let known = |name: &str, field: &str| {
            value(field).ok_or_else(|| fail(format!("the {name} {} is not a number", quoted(field))))
        };
        let f = frequency(known("frequency", fields[0])?, bands.last().map(|b| b.0)).map_err(fail)?;
        let s = density(known("spectral density", fields[1])?).map_err(fail)?;
        if bands.len() == MAX_BANDS {
            return Err(fail(format!("more than {MAX_BANDS} bands of frequency")));
        }
        bands.push((f, s));
        if let [_, _, from, spread] = fields[..] {
            let (from, spread) = (optional(from, "direction", known)?, optional(spread, "spread", known)?);
            if let Some(a) = from.filter(|a| !(-360.0..=360.0).contains(a)) {
                return Err(fail(format!("the direction {} is not within -360 to 360 degrees", shown(a))));
            }
            if let Some(a) = spread.filter(|a| !(0.0..=180.0).contains(a)) {
                return Err(fail(format!("the spread {} is not within 0 to 180 degrees", shown(a))));
            }
            directions.push(from.zip(spread).map(|(a, w)| Direction::from_spread(a, w)));
        }
    }
    let mut notices = Vec::new();
    let directions = if directions.is_empty() { None } else { filled(&bands, &directions, &mut notices) };
    let mut sea = Measured::new(&bands, directions.as_deref()).map_err(|what| file.whole(what))?;
    sea.set_title(&file.name);
    Ok((sea, notices))
}

/// A direction or spread, which may be missing: empty, a word for nothing, or nines.
fn optional(field: &str, name: &str, known: impl Fn(&str, &str) -> Result<f64, String>) -> Result<Option<f64>, String> {
    if ["", "-", "MM", "NaN", "NA"].iter().any(|w| field.eq_ignore_ascii_case(w)) {
        return Ok(None);
    }
    known(name, field).map(|v| Some(v).filter(|v| ![999.0, 9999.0, -999.0, -9999.0].contains(v)))
}

/// Bands without a direction take that of the nearest band with one. Where less than a third has one there are none.
pub(super) fn filled(
    bands: &[(f64, f64)],
    directions: &[Option<Direction>],
    notices: &mut Vec<String>,
) -> Option<Vec<Direction>> {
    let known: Vec<(f64, Direction)> = bands.iter().zip(directions).filter_map(|(b, d)| d.map(|d| (b.0, d))).collect();
    if known.is_empty() || 3 * known.len() < bands.len() {
        notices.push(format!(
            "only {} of {} bands have a direction: the sea is taken without directions",
            known.len(),
            bands.len()
        ));
        return None;
    }
    let nearest = |f: f64| known.iter().min_by(|a, b| (a.0 - f).abs().total_cmp(&(b.0 - f).abs())).map(|k| k.1);
    bands.iter().zip(directions).map(|(b, d)| d.or_else(|| nearest(b.0))).collect()
}
