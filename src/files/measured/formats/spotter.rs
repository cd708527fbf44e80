//! Reads the spectra of Sofar's Spotter buoys as JSON, as their service delivers them.
//!
//! Every object in the file with the arrays `frequency` (Hz) and `varianceDensity` (m^2/Hz) is a spectrum. Directions come
//! from `a1`, `b1`, `a2`, `b2`, the moments of the direction of travel with east as x and north as y; without these from
//! `direction` (bearing that waves come from) and `directionalSpread`, both in degrees.

use super::grid::Records;
use crate::files::measured::direction::{DirectionalParameters, fill_missing_directions};
use crate::files::measured::list::SpectrumList;
use crate::files::measured::spectrum::{MAX_BANDS, MeasuredSpectrum};
use crate::files::measured::text::printable_prefix;
use serde_json::{Map, Value};

/// Largest JSON file that is read, bytes: its values take some ten times as much memory.
const MAX_JSON_BYTES: usize = 4 << 20;

/// Whether a file is JSON: its first letter is a brace or a bracket.
pub(super) fn is_json(bytes: &[u8]) -> bool {
    matches!(bytes.trim_ascii_start().first(), Some(b'{' | b'['))
}

/// Reads all spectra of the file called `name`.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<SpectrumList, String> {
    // Times in the file may hold line breaks.
    let fault = |what: String| format!("{name}: {}", printable_prefix(&what, 400));
    if bytes.len() > MAX_JSON_BYTES {
        return Err(fault(format!("JSON larger than {} MiB: keep fewer times in it", MAX_JSON_BYTES >> 20)));
    }
    let value: Value = serde_json::from_slice(bytes).map_err(|e| fault(format!("it is not right JSON: {e}")))?;
    let (mut found, mut records) = (Vec::new(), Records::default());
    collect_spectra(&value, &mut found);
    if found.is_empty() {
        let what = "no object in it has the arrays \"frequency\" and \"varianceDensity\": ask the service for spectra";
        return Err(fault(what.into()));
    }
    for spectrum in found {
        let time = spectrum.get("timestamp").and_then(Value::as_str).unwrap_or_default();
        let of_time = |what: String| fault(if time.is_empty() { what } else { format!("{time}: {what}") });
        records.announce(MAX_BANDS).map_err(fault)?;
        records.add(time, read_spectrum(spectrum).map_err(of_time)?);
    }
    SpectrumList::new(name, records.records, records.skipped)
}

/// Adds the objects in `value`, at any depth, that hold a spectrum. The parser has limited the depth.
fn collect_spectra<'a>(value: &'a Value, found: &mut Vec<&'a Map<String, Value>>) {
    match value {
        Value::Object(map)
            if ["frequency", "varianceDensity"].iter().all(|k| map.get(*k).is_some_and(Value::is_array)) =>
        {
            found.push(map);
        }
        Value::Object(map) => map.values().for_each(|v| collect_spectra(v, found)),
        Value::Array(list) => list.iter().for_each(|v| collect_spectra(v, found)),
        _ => {}
    }
}

fn read_spectrum(map: &Map<String, Value>) -> Result<Option<MeasuredSpectrum>, String> {
    let frequencies = numbers(map, "frequency")?.unwrap_or_default();
    let count = frequencies.len();
    if count > MAX_BANDS {
        return Err(format!("more than {MAX_BANDS} frequencies"));
    }
    let column = |key: &str| match numbers(map, key)? {
        Some(list) if list.len() != count => Err(format!("{} numbers in {key} for {count} frequencies", list.len())),
        column => Ok(column),
    };
    let required = |list: Vec<Option<f64>>, key: &str| -> Result<Vec<f64>, String> {
        list.into_iter().collect::<Option<_>>().ok_or_else(|| format!("a number is missing in {key}"))
    };
    let frequencies = required(frequencies, "frequency")?;
    let densities = required(column("varianceDensity")?.unwrap_or_default(), "varianceDensity")?;
    let bands: Vec<(f64, f64)> = frequencies.into_iter().zip(densities).collect();
    let moments = [column("a1")?, column("b1")?, column("a2")?, column("b2")?];
    let directions: Option<Vec<Option<DirectionalParameters>>> = match &moments {
        [Some(a1), Some(b1), Some(a2), Some(b2)] => {
            Some((0..count).map(|i| Some(from_moments([a1[i]?, b1[i]?, a2[i]?, b2[i]?]))).collect())
        }
        _ => column("direction")?.zip(column("directionalSpread")?).map(|(from, spread)| {
            let parameters = |(from, spread): (&Option<f64>, &Option<f64>)| {
                Some(DirectionalParameters::from_spread((*from)?, (*spread)?.clamp(0.0, 180.0)))
            };
            from.iter().zip(&spread).map(parameters).collect()
        }),
    };
    if bands.iter().all(|b| b.1 == 0.0) && !bands.is_empty() {
        return Ok(None);
    }
    let directions = directions.and_then(|d| fill_missing_directions(&bands, &d, &mut Vec::new()));
    MeasuredSpectrum::new(&bands, directions.as_deref()).map(Some)
}

/// Numbers of an array; `None` for an entry that is `null`. An error if an entry is something else.
fn numbers(map: &Map<String, Value>, key: &str) -> Result<Option<Vec<Option<f64>>>, String> {
    let Some(Value::Array(list)) = map.get(key) else { return Ok(None) };
    let number = |value: &Value| match value {
        Value::Null => Ok(None),
        Value::Number(n) => Ok(n.as_f64()),
        _ => Err(format!("an entry of {key} is not a number")),
    };
    list.iter().map(number).collect::<Result<_, _>>().map(Some)
}

/// Directional parameters for the moments a1, b1, a2, b2 of the direction of travel, anticlockwise from east.
fn from_moments([a1, b1, a2, b2]: [f64; 4]) -> DirectionalParameters {
    DirectionalParameters {
        alpha1_deg: 270.0 - b1.atan2(a1).to_degrees(),
        alpha2_deg: 270.0 - 0.5 * b2.atan2(a2).to_degrees(),
        r1: a1.hypot(b1),
        r2: a2.hypot(b2),
    }
}
