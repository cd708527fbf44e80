//! Reads densities over frequency and direction from NetCDF files: point spectra of WAVEWATCH III and of the Python
//! package wavespectra, and spectra of ERA5 and other CF-style files.
//!
//! The density is the variable `efth`, `d2fd`, or one with the CF name of a directional spectrum, over a dimension of
//! frequencies, one of directions, and any others, such as time and station, which number the spectra. What a file does
//! not say is assumed as follows.
//!
//! - `d2fd` holds the decimal logarithm of the density; missing values are 0.
//! - Densities are per radian unless their unit names degrees.
//! - Frequencies and directions that are absent or only numbered 1, 2, 3 ... are those of ECMWF: 0.03453 Hz times powers
//!   of 1.1, and even steps of which the first begins at north.
//! - Directions are those that waves travel to, unless a name of the variable says "from" or it is called `dir`.

use super::grid::{Grid, Records};
use crate::files::measured::list::SpectrumList;
use crate::files::measured::text::printable_prefix;
use crate::files::netcdf::{Attribute, Dataset, Variable};

/// First frequency of ECMWF's spectra, Hz, and ratio of two neighbouring ones.
const ECMWF_FREQUENCIES: [f64; 2] = [0.034_53, 1.1];
/// Names of the variable of densities.
const DENSITY_NAMES: [&str; 2] = ["efth", "d2fd"];
/// CF standard name of the density.
const DENSITY_STANDARD_NAME: &str = "sea_surface_wave_directional_variance_spectral_density";

/// The variable of densities, with its dimensions of frequency and direction.
struct Density<'a> {
    index: usize,
    variable: &'a Variable,
    frequency_axis: usize,
    direction_axis: usize,
}

/// Reads all spectra of the file called `name`.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<SpectrumList, String> {
    // Names in the file may hold line breaks.
    let fault = |what: String| format!("{name}: {}", printable_prefix(&what, 400));
    let file = Dataset::open(bytes).map_err(fault)?;
    let records = read_records(&file).map_err(fault)?;
    SpectrumList::new(name, records.records, records.skipped)
}

fn read_records(file: &Dataset<'_>) -> Result<Records, String> {
    let density = find_density(file)?;
    let shape = &density.variable.shape;
    let (frequency_count, direction_count) = (shape[density.frequency_axis], shape[density.direction_axis]);
    let total = density.variable.value_count()?;
    let frequencies = frequencies_hz(file, density.variable, density.frequency_axis)?;
    let grid = Grid::new(frequencies, &from_deg(file, density.variable, density.direction_axis)?)?;
    let stride = |axis: usize| shape[axis + 1..].iter().product::<usize>();
    let (frequency_stride, direction_stride) = (stride(density.frequency_axis), stride(density.direction_axis));
    let others: Vec<usize> =
        (0..shape.len()).filter(|a| *a != density.frequency_axis && *a != density.direction_axis).collect();
    let labels: Vec<Vec<String>> = others.iter().map(|axis| axis_labels(file, density.variable, *axis)).collect();
    let record_count = total / (frequency_count * direction_count).max(1);
    let mut records = Records::default();
    // The limits hold before the densities are read.
    (0..record_count).try_for_each(|_| records.announce(grid.cell_count()))?;
    let mut records = Records::default();
    let values = file.numbers(density.index)?;
    let unpack = Unpacking::new(density.variable);
    let mut densities = vec![0.0; grid.cell_count()];
    for record in 0..record_count {
        records.announce(grid.cell_count())?;
        // Index along each of the other dimensions, the last one fastest.
        let (mut rest, mut start, mut label) = (record, 0, Vec::new());
        for (axis, labels) in others.iter().zip(&labels).rev() {
            let i = rest % shape[*axis];
            rest /= shape[*axis];
            start += i * stride(*axis);
            label.extend(labels.get(i).filter(|l| !l.is_empty()).cloned());
        }
        label.reverse();
        let mut is_missing = true;
        for (i, cell) in densities.iter_mut().enumerate() {
            let (f, d) = (i / direction_count, i % direction_count);
            let value = unpack.density(values[start + f * frequency_stride + d * direction_stride]);
            is_missing &= value.is_none();
            *cell = value.unwrap_or(0.0);
        }
        records.add(&label.join(", "), if is_missing { None } else { grid.spectrum(&densities)? });
    }
    Ok(records)
}

/// Whether a dimension or variable of this name holds frequencies.
fn is_frequency(name: &str) -> bool {
    name.to_ascii_lowercase().starts_with("freq")
}

/// Whether a dimension or variable of this name holds directions.
fn is_direction(name: &str) -> bool {
    name.to_ascii_lowercase().starts_with("dir")
}

fn find_density<'a>(file: &'a Dataset<'_>) -> Result<Density<'a>, String> {
    let by_name = |v: &Variable| DENSITY_NAMES.contains(&v.name.as_str());
    let by_standard_name = |v: &Variable| v.text("standard_name") == DENSITY_STANDARD_NAME;
    let index = file.variables.iter().position(by_name).or_else(|| file.variables.iter().position(by_standard_name));
    let index = index.ok_or_else(|| {
        let names: Vec<&str> = file.variables.iter().map(|v| v.name.as_str()).take(8).collect();
        format!(
            "there is no variable efth or d2fd, or with the name of a directional spectrum, among {}",
            names.join(", ")
        )
    })?;
    let variable = &file.variables[index];
    let axis = |is: fn(&str) -> bool| variable.dimensions.iter().position(|d| is(d));
    match (axis(is_frequency), axis(is_direction)) {
        (Some(frequency_axis), Some(direction_axis)) => Ok(Density { index, variable, frequency_axis, direction_axis }),
        _ => Err(format!(
            "the variable {} has no dimensions whose names begin with freq and dir, but {}",
            variable.name,
            variable.dimensions.join(", ")
        )),
    }
}

/// Variable with the values along a dimension of the density: the one of the dimension's name, or one over it alone.
fn coordinate<'a>(
    file: &'a Dataset<'_>,
    density: &Variable,
    axis: usize,
    is: fn(&str) -> bool,
) -> Option<(usize, &'a Variable)> {
    let dimension = &density.dimensions[axis];
    let along = |v: &Variable| v.shape == [density.shape[axis]];
    let found = file.variables.iter().position(|v| v.name == *dimension && along(v)).or_else(|| {
        let names = ["frequency", "freq", "direction", "dir"];
        file.variables.iter().position(|v| names.contains(&v.name.as_str()) && is(&v.name) && along(v))
    })?;
    Some((found, &file.variables[found]))
}

/// Whether values only number the positions along a dimension: 1, 2, 3 ... or 0, 1, 2 ...
fn is_numbering(values: &[f64]) -> bool {
    let counts_from = |first: f64| values.iter().enumerate().all(|(i, v)| *v == first + i as f64);
    counts_from(1.0) || counts_from(0.0)
}

fn frequencies_hz(file: &Dataset<'_>, density: &Variable, axis: usize) -> Result<Vec<f64>, String> {
    let values = coordinate(file, density, axis, is_frequency).map(|(index, _)| unpacked(file, index)).transpose()?;
    let [first, ratio] = ECMWF_FREQUENCIES;
    match values {
        Some(values) if !is_numbering(&values) => Ok(values),
        _ => Ok((0..density.shape[axis].min(1 << 16)).map(|i| first * f64::powi(ratio, i as i32)).collect()),
    }
}

fn from_deg(file: &Dataset<'_>, density: &Variable, axis: usize) -> Result<Vec<f64>, String> {
    let found = coordinate(file, density, axis, is_direction);
    let values = found.map(|(index, _)| unpacked(file, index)).transpose()?;
    let count = density.shape[axis].min(1 << 16);
    let Some((values, variable)) = values.filter(|v| !is_numbering(v)).zip(found.map(|f| f.1)) else {
        let step = 360.0 / count as f64;
        return Ok((0..count).map(|i| (i as f64 + 0.5) * step + 180.0).collect());
    };
    let words = ["standard_name", "long_name"].map(|name| variable.text(name).to_ascii_lowercase());
    let says = |word: &str| words.iter().any(|text| text.split(|c: char| !c.is_alphabetic()).any(|w| w == word));
    let is_from = says("from") || !says("to") && variable.name == "dir";
    let in_radians = variable.text("units").to_ascii_lowercase().starts_with("rad");
    let bearing = |v: f64| (if in_radians { v.to_degrees() } else { v }) + if is_from { 0.0 } else { 180.0 };
    Ok(values.into_iter().map(bearing).collect())
}

/// Values of a variable, with its scale and offset.
fn unpacked(file: &Dataset<'_>, index: usize) -> Result<Vec<f64>, String> {
    let variable = &file.variables[index];
    let [scale, offset] = [("scale_factor", 1.0), ("add_offset", 0.0)].map(|(n, v)| variable.number(n).unwrap_or(v));
    Ok(file.numbers(index)?.into_iter().map(|v| v * scale + offset).collect())
}

/// How a stored value becomes a density.
struct Unpacking {
    missing: Vec<f64>,
    scale: f64,
    offset: f64,
    is_logarithm: bool,
    per_radian: f64,
}

impl Unpacking {
    fn new(variable: &Variable) -> Self {
        let missing = ["_FillValue", "missing_value"].iter().filter_map(|name| variable.number(name)).collect();
        let units = variable.text("units").to_ascii_lowercase();
        Self {
            missing,
            scale: variable.number("scale_factor").unwrap_or(1.0),
            offset: variable.number("add_offset").unwrap_or(0.0),
            is_logarithm: variable.name == "d2fd",
            per_radian: if units.contains("deg") { 1_f64.to_degrees() } else { 1.0 },
        }
    }

    /// Density, m^2/Hz/rad; `None` if the value is missing.
    fn density(&self, stored: f64) -> Option<f64> {
        if stored.is_nan() || self.missing.contains(&stored) {
            return None;
        }
        let value = stored * self.scale + self.offset;
        Some(self.per_radian * if self.is_logarithm { 10_f64.powf(value) } else { value })
    }
}

/// Names of the positions along a dimension: dates, names of stations, or values with their name.
fn axis_labels(file: &Dataset<'_>, density: &Variable, axis: usize) -> Vec<String> {
    let (dimension, count) = (&density.dimensions[axis], density.shape[axis]);
    if count < 2 && !dimension.contains("time") || count > crate::files::measured::list::MAX_RECORDS {
        return Vec::new();
    }
    let station_name = file.variables.iter().position(|v| v.name == "station_name" && v.shape.first() == Some(&count));
    if let Some(index) = station_name.filter(|_| dimension == "station") {
        let width = file.variables[index].shape.get(1).copied().unwrap_or(1).max(1);
        let letters = file.numbers(index).unwrap_or_default();
        let name =
            |codes: &[f64]| codes.iter().map(|c| char::from(*c as u8)).filter(|c| *c != '\0').collect::<String>();
        return letters.chunks(width).map(|codes| name(codes).trim().to_owned()).collect();
    }
    let index = file.variables.iter().position(|v| v.name == *dimension && v.shape == [count]);
    let values = index.and_then(|i| unpacked(file, i).ok());
    match (values, index) {
        (Some(values), Some(index)) => {
            let units = match file.variables[index].attribute("units") {
                Some(Attribute::Text(units)) => units.as_str(),
                _ => "",
            };
            let label = |v: &f64| date(*v, units).unwrap_or_else(|| format!("{dimension} {v}"));
            values.iter().map(label).collect()
        }
        _ => (0..count).map(|i| format!("{dimension} {i}")).collect(),
    }
}

/// Date and time such as `2024-01-31 06:00 UTC` for a number and a unit such as `hours since 1900-01-01 00:00:00`; `None`
/// for other units. The calendar is the Gregorian one.
fn date(value: f64, units: &str) -> Option<String> {
    let (unit, since) = units.split_once(" since ")?;
    let seconds = match unit.trim().trim_end_matches('s') {
        "day" => 86_400.0,
        "hour" => 3600.0,
        "minute" => 60.0,
        "second" => 1.0,
        _ => return None,
    };
    let numbers: Vec<i64> = since
        .split(|c: char| !c.is_ascii_digit())
        .filter(|w| !w.is_empty())
        .take(6)
        .map_while(|w| w.parse().ok())
        .collect();
    let [year, month, day] = numbers.get(..3)? else { return None };
    if !(0..=9999).contains(year) || !(1..=12).contains(month) || !(1..=31).contains(day) {
        return None;
    }
    let clock = |i: usize| numbers.get(i).copied().unwrap_or(0).clamp(0, 86_400);
    let since_epoch = 86_400 * days_of_date(*year, *month, *day) + 3600 * clock(3) + 60 * clock(4) + clock(5);
    let total = since_epoch as f64 + value * seconds;
    if !(-1e11..1e12).contains(&total) {
        return None;
    }
    let minutes = (total / 60.0).round() as i64;
    let (days, minute) = (minutes.div_euclid(1440), minutes.rem_euclid(1440));
    let (year, month, day) = date_of_days(days);
    Some(format!("{year:04}-{month:02}-{day:02} {:02}:{:02} UTC", minute / 60, minute % 60))
}

/// Days from 1970-01-01 to a date, by Hinnant's algorithm (chrono-compatible low-level date algorithms).
fn days_of_date(year: i64, month: i64, day: i64) -> i64 {
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let day_of_year = (153 * (month + if month > 2 { -3 } else { 9 }) + 2) / 5 + day - 1;
    let year_of_era = year.rem_euclid(400);
    era * 146_097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - 719_468
}

/// Date (year, month, day) of a number of days from 1970-01-01, the inverse of [`days_of_date`].
fn date_of_days(days: i64) -> (i64, i64, i64) {
    let days = days + 719_468;
    let (era, day_of_era) = (days.div_euclid(146_097), days.rem_euclid(146_097));
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * day_of_year + 2) / 153;
    let month = if shifted < 10 { shifted + 3 } else { shifted - 9 };
    (year_of_era + era * 400 + i64::from(month <= 2), month, day_of_year - (153 * shifted + 2) / 5 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (value, units, want) in [
            (0.0, "days since 1990-01-01 00:00:00", "1990-01-01 00:00 UTC"),
            (8766.25, "days since 1990-01-01T00:00:00Z", "2014-01-01 06:00 UTC"),
            (1_059_048.0, "hours since 1900-01-01 00:00:00.0", "2020-10-25 00:00 UTC"),
            (951_782_400.0, "seconds since 1970-01-01", "2000-02-29 00:00 UTC"),
        ] {
            assert_eq!(date(value, units).as_deref(), Some(want));
        }
        for (value, units) in [
            (1.0, "m"),
            (1.0, "fortnights since 1990-01-01"),
            (f64::NAN, "days since 1990-01-01"),
            (1.0, "days since x"),
        ] {
            assert_eq!(date(value, units), None);
        }
        for days in (-800_000..800_000).step_by(37) {
            let (year, month, day) = date_of_days(days);
            assert_eq!(days_of_date(year, month, day), days);
        }
    }
}
