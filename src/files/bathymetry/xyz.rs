//! Text with a point in each line: x, y and the value z, separated by white space, comma, semicolon or tab.
//!
//! Points that lie on a regular grid, in any order and with gaps, become that grid. Other points, such as soundings, are
//! put onto a grid by linear interpolation in triangles between neighbouring points ([`super::scattered`]).

use super::grid::{Axis, RawGrid};
use super::{MAX_POINTS, ReadAs};
use crate::files::measured::text::{parse_number, quoted_excerpt, trimmed_line};

/// Largest number of points of a text file.
const MAX_TEXT_POINTS: usize = 2 << 20;
/// Smallest share of a regular grid that has points: with less, the points are scattered.
const MIN_GRID_SHARE: f64 = 0.2;
/// Greatest distance of a point from its place on a regular grid, as a fraction of the step: files round coordinates.
const MAX_UNEVENNESS: f64 = 0.2;
/// Largest number of lines of words at the beginning.
const MAX_HEAD_LINES: usize = 20;

/// Reads points.
///
/// # Errors
/// One sentence with the line and the reason, without the file's name.
pub(super) fn read(text: &str, read_as: ReadAs) -> Result<RawGrid, String> {
    let (points, words) = parse(text)?;
    if points.len() < 4 {
        return Err(format!("{} lines of x, y and z, but a bathymetry has at least four", points.len()));
    }
    let mut grid = match regular_grid(&points) {
        Some(grid) => grid,
        None => scattered_grid(&points, &words, read_as)?,
    };
    grid.words = words;
    Ok(grid)
}

/// The points of a text, and the words of its first lines.
fn parse(text: &str) -> Result<(Vec<[f64; 3]>, String), String> {
    let (mut points, mut words): (Vec<[f64; 3]>, String) = (Vec::new(), String::new());
    let mut head_lines = 0;
    for (i, line) in text.lines().map(trimmed_line).enumerate() {
        if line.is_empty() {
            continue;
        }
        let is_comment = line.starts_with(['#', '%', '!']) || line.starts_with("//");
        let separators: &[char] = if line.contains(';') { &[';', ' ', '\t'] } else { &[',', ' ', '\t'] };
        let mut fields = line.split(separators).filter(|f| !f.is_empty());
        let first = fields.next().unwrap_or_default();
        if is_comment || points.is_empty() && parse_number(first).is_none() {
            head_lines += 1;
            if points.is_empty() && head_lines > MAX_HEAD_LINES && !is_comment {
                return Err(format!("the first {MAX_HEAD_LINES} lines hold no numbers: it is no text of x, y and z"));
            }
            if head_lines <= MAX_HEAD_LINES {
                words.extend(line.chars().take(200).chain([' ']));
            }
            continue;
        }
        let mut point = [0.0; 3];
        for (value, field) in point.iter_mut().zip([Some(first), fields.next(), fields.next()]) {
            let Some(field) = field else { return Err(format!("line {}: a point is x, y and z", i + 1)) };
            let number = parse_number(field).or_else(|| field.eq_ignore_ascii_case("nan").then_some(f64::NAN));
            *value = number.ok_or_else(|| format!("line {}: {} is not a number", i + 1, quoted_excerpt(field)))?;
        }
        if point[..2].iter().any(|v| v.is_nan() || v.abs() > 1e9) {
            return Err(format!("line {}: {} is no place", i + 1, quoted_excerpt(line)));
        }
        // NaN and -9999 are points without data, as in an ESRI ASCII grid.
        if point[2] == -9999.0 || point[2] == -99_999.0 {
            point[2] = f64::NAN;
        }
        if points.len() == MAX_TEXT_POINTS {
            return Err(format!(
                "more than {MAX_TEXT_POINTS} points: cut out the coast, or save it as GeoTIFF or NetCDF"
            ));
        }
        points.push(point);
    }
    Ok((points, words))
}

/// The evenly spaced positions among coordinates; `None` if they are not even.
fn lattice(coordinates: impl Iterator<Item = f64>) -> Option<Axis> {
    let mut sorted: Vec<f64> = coordinates.collect();
    sorted.sort_by(f64::total_cmp);
    let (first, last) = (*sorted.first()?, *sorted.last()?);
    let range = last - first;
    // Positions that differ by less than a millionth of the range are one.
    let mut gaps: Vec<f64> = sorted.windows(2).map(|w| w[1] - w[0]).filter(|gap| *gap > 1e-6 * range).collect();
    if gaps.is_empty() {
        return None;
    }
    gaps.sort_by(f64::total_cmp);
    let typical = gaps[gaps.len() / 2];
    let count = (range / typical).round();
    if !(1.0..MAX_POINTS as f64).contains(&count) {
        return None;
    }
    let step = range / count;
    let is_on = |v: &f64| {
        let place = (v - first) / step;
        (place - place.round()).abs() < MAX_UNEVENNESS
    };
    sorted.iter().all(is_on).then_some(Axis { first, step, count: count as usize + 1 })
}

/// The grid on which the points lie; `None` if there is none.
fn regular_grid(points: &[[f64; 3]]) -> Option<RawGrid> {
    let (x, y) = (lattice(points.iter().map(|p| p[0]))?, lattice(points.iter().map(|p| p[1]))?);
    let count = x.count.checked_mul(y.count).filter(|count| *count <= MAX_POINTS)?;
    if x.count < 2 || y.count < 2 || (points.len() as f64) < MIN_GRID_SHARE * count as f64 {
        return None;
    }
    let mut values = vec![f32::NAN; count];
    let place = |v: f64, axis: &Axis| ((v - axis.first) / axis.step).round() as usize;
    for [px, py, z] in points {
        values[place(*py, &y) * x.count + place(*px, &x)] = *z as f32;
    }
    Some(RawGrid::new(x, y, values))
}

#[cfg(feature = "files")]
fn scattered_grid(points: &[[f64; 3]], words: &str, read_as: ReadAs) -> Result<RawGrid, String> {
    super::scattered::grid(points, words, read_as)
}

#[cfg(not(feature = "files"))]
fn scattered_grid(_: &[[f64; 3]], _: &str, _: ReadAs) -> Result<RawGrid, String> {
    Err("its points lie on no regular grid, and this program was built without triangulation: save it as a grid".into())
}
