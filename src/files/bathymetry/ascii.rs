//! The ESRI ASCII grid: a header of `ncols`, `nrows`, the lower left corner, `cellsize` and `nodata_value`, then rows of
//! values from north to south.

use super::checked_count;
use super::grid::{Axis, RawGrid};
use crate::files::measured::text::{parse_number, quoted_excerpt, trimmed_line};

/// Value of points without data unless the header gives another one.
const DEFAULT_NO_DATA: f64 = -9999.0;

/// Whether a text begins as an ESRI ASCII grid: with a line of the keyword `ncols` or `nrows`.
pub(super) fn is_ascii_grid(text: &str) -> bool {
    let first = text.lines().map(trimmed_line).find(|line| !line.is_empty()).unwrap_or_default();
    let word = first.split_whitespace().next().unwrap_or_default().to_ascii_lowercase();
    word == "ncols" || word == "nrows"
}

/// Numbers of the header; `None` for those that it lacks.
#[derive(Default)]
struct Header {
    columns: Option<f64>,
    rows: Option<f64>,
    /// Distance of two points along x and along y, in the unit of the coordinates.
    cell: [Option<f64>; 2],
    /// Coordinates x, y of the corner or of the middle of the south-western cell, and whether it is the middle.
    origin: [Option<(f64, bool)>; 2],
    no_data: Option<f64>,
}

/// Reads a grid.
///
/// # Errors
/// One sentence with the line and the reason, without the file's name.
pub(super) fn read(text: &str) -> Result<RawGrid, String> {
    let mut header = Header::default();
    let mut lines = text.lines().map(trimmed_line).enumerate().peekable();
    while let Some((i, line)) = lines.peek().copied() {
        let mut words = line.split_whitespace();
        let (keyword, value) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
        if keyword.is_empty() {
            lines.next();
            continue;
        }
        if !keyword.starts_with(|c: char| c.is_ascii_alphabetic()) || keyword.eq_ignore_ascii_case("nan") {
            break;
        }
        header.set(keyword, value).map_err(|what| format!("line {}: {what}", i + 1))?;
        lines.next();
    }
    let size = |value: Option<f64>, name: &str| {
        let whole = value.filter(|v| (1.0..1e9).contains(v) && v.fract() == 0.0);
        whole.map(|v| v as usize).ok_or_else(|| format!("the header has no usable {name}"))
    };
    let (columns, rows) = (size(header.columns, "ncols")?, size(header.rows, "nrows")?);
    let count = checked_count(columns, rows)?;
    let step = header.cell.map(|c| c.filter(|c| c.is_finite() && *c > 0.0));
    let [Some(dx), Some(dy)] = step else { return Err("the header has no usable cellsize".into()) };
    // Each value takes at least a digit and a separator.
    if text.len() < 2 * count - 1 {
        return Err(format!("the header promises {columns} x {rows} values, but the file is too short: copy it again"));
    }
    let mut values = Vec::with_capacity(count);
    let no_data = header.no_data.unwrap_or(DEFAULT_NO_DATA);
    for (i, line) in lines {
        for word in line.split_whitespace() {
            let value = match parse_number(word) {
                Some(value) if value == no_data => f32::NAN,
                Some(value) => value as f32,
                None if word.eq_ignore_ascii_case("nan") => f32::NAN,
                None => return Err(format!("line {}: {} is not a number", i + 1, quoted_excerpt(word))),
            };
            if values.len() == count {
                return Err(format!("line {}: there are more than {columns} x {rows} values", i + 1));
            }
            values.push(value);
        }
    }
    if values.len() < count {
        return Err(format!("{} values instead of {columns} x {rows}: copy the file again", values.len()));
    }
    let axis = |origin: Option<(f64, bool)>, step: f64, count: usize| {
        let (at, is_middle) = origin.unwrap_or((0.0, true));
        Axis { first: if is_middle { at } else { at + 0.5 * step }, step, count }
    };
    let mut grid = RawGrid::new(axis(header.origin[0], dx, columns), axis(header.origin[1], dy, rows), values);
    grid.turn_upside_down();
    Ok(grid)
}

impl Header {
    fn set(&mut self, keyword: &str, value: &str) -> Result<(), String> {
        let keyword = keyword.to_ascii_lowercase();
        if keyword == "nodata_value" && value.eq_ignore_ascii_case("nan") {
            return Ok(());
        }
        let number = parse_number(value).ok_or_else(|| format!("{} is not a number", quoted_excerpt(value)))?;
        match keyword.as_str() {
            "ncols" => self.columns = Some(number),
            "nrows" => self.rows = Some(number),
            "xllcorner" => self.origin[0] = Some((number, false)),
            "yllcorner" => self.origin[1] = Some((number, false)),
            "xllcenter" => self.origin[0] = Some((number, true)),
            "yllcenter" => self.origin[1] = Some((number, true)),
            "cellsize" => self.cell = [Some(number); 2],
            "dx" => self.cell[0] = Some(number),
            "dy" => self.cell[1] = Some(number),
            "nodata_value" => self.no_data = Some(number),
            _ => return Err(format!("{} is no keyword of an ESRI ASCII grid", quoted_excerpt(&keyword))),
        }
        Ok(())
    }
}
